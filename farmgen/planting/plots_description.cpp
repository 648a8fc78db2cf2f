// SPDX-License-Identifier: Apache-2.0
#include "planting/plots_description.h"

#include <algorithm>

namespace plotscan::planting {

std::uint64_t plots_of(const PlotGridDescription& grid) {
  std::uint64_t plots = 0;
  for (const PlotRowDescription& row : grid.rows) plots += row.plots;
  return plots;
}

std::uint32_t last_number(const PlotGridDescription& grid) {
  return grid.first_number + static_cast<std::uint32_t>(plots_of(grid)) - 1;
}

std::uint32_t columns_of(const PlotGridDescription& grid) {
  return grid.rows.empty() ? 0 : std::ranges::max(grid.rows, {}, &PlotRowDescription::plots).plots;
}

}  // namespace plotscan::planting
