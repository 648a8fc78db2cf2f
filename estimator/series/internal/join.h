// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "series/series.h"

namespace plotscan::series {

// For each of a later result's plots the index of the known one that it is; absent where it is a
// new one. No two are the same.
using Matches = std::vector<std::optional<std::size_t>>;

// Those with the same id.
Matches matches_by_id(const std::vector<PlotSeries>& known,
                      const std::vector<estimate::PlotEstimate>& plots);

// Those whose centre lies in the box of the known one: within half a plot of its centre along both
// of its sides. Of several the nearest.
Matches matches_by_place(const std::vector<PlotSeries>& known,
                         const std::vector<estimate::PlotEstimate>& plots);

}  // namespace plotscan::series
