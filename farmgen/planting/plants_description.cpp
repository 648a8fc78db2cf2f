// SPDX-License-Identifier: Apache-2.0
#include "planting/plants_description.h"

#include <algorithm>

namespace plotscan::planting {

std::uint64_t most_seeds(const PlotGridDescription& grid, const PlantsDescription& plants) {
  std::uint64_t most = 0;
  for (const CultivarDescription& cultivar : plants.cultivars)
    most = std::max<std::uint64_t>(most, cultivar.count);
  return plots_of(grid) * most;
}

}  // namespace plotscan::planting
