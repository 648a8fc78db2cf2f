// SPDX-License-Identifier: Apache-2.0
#pragma once

// Plots side by side without a gap, as in breeding trials whose rows run on at one spacing from
// plot to plot.

#include <optional>
#include <span>
#include <vector>

#include "plots/canopy/canopy_profile.h"

namespace plotscan::plots {

// Plots of one side that touch; lengths in cells.
struct TouchingPlots {
  double side = 0;
  std::vector<std::vector<double>> begins = {};  // profile by profile
};

// The canopy does not show where one plot ends and the next begins, but where the first begins and
// the last ends: at the field's border and at alleys. What stands between two such ends is cut
// into the number of plots that comes nearest to its length, about its middle. The side is the
// user's, or follows from the number of plots on a profile. Nothing where neither is told, or where
// the stretches do not make that number.
std::optional<TouchingPlots> touching_plots(std::span<const ProfileSums> profiles, double cell_m,
                                            std::optional<double> side_m, std::optional<int> count);

}  // namespace plotscan::plots
