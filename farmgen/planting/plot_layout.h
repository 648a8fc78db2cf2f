// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

#include "core/trial_layout.h"
#include "farm/farm.h"
#include "planting/farm_description.h"

namespace plotscan::planting {

// The grid's places in the order of their numbers, missing plots included.
TrialLayout layout_of(const PlotGridDescription& grid);

// All plots of a grid in the order of their numbers, without plants; missing plots are included.
// Each box's length axis is the axis from row to row. `trial`: farm::Plot::trial.
std::vector<farm::Plot> grid_plots(const PlotGridDescription& grid, int trial = 0);

// farm::Plot::trial of the plots of the trial at `place` (from 0) among `trials`.
int trial_number(std::size_t place, std::size_t trials);

// The grid of the trial at `place` (from 0). Where its heading is to be random, it gets one that
// the seed draws, uniform in [0, 360) degrees.
PlotGridDescription turned(PlotGridDescription grid, std::uint64_t seed, std::size_t place = 0);

// The numbers of two plots that overlap by more than `share` of the smaller one, the lower number
// first; absent where no plots do.
std::optional<std::pair<std::uint32_t, std::uint32_t>> overlapping_plots(
    const std::vector<farm::Plot>& plots, double share = 1e-6);

// Whether the plot of that number is missing: named by the description, or drawn.
bool is_missing(const PlotGridDescription& grid, std::uint32_t number, std::uint64_t seed);

// Throws InputError (naming `source`, where the plots come from) when a corner of a plot lies off
// the terrain, saying which, how far, and what would fit.
void require_on_terrain(const std::vector<farm::Plot>& plots, const terrain::Terrain& terrain,
                        const std::filesystem::path& source);

// Finds the plot that holds a point.
class PlotFinder {
 public:
  // Keeps a reference to `plots`.
  explicit PlotFinder(const std::vector<farm::Plot>& plots);
  // The id of the first plot whose box contains the point, 0 for none. Constant expected time.
  std::uint32_t plot_at(const Eigen::Vector2d& point) const;

 private:
  const std::vector<farm::Plot>& plots_;
  std::optional<terrain::TriangleGrid> grid_;  // triangles 2 i and 2 i + 1 are the box of plot i
};

}  // namespace plotscan::planting
