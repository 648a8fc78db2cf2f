// SPDX-License-Identifier: Apache-2.0
#pragma once

// The two directions along which a field's alleys run.

#include <optional>
#include <vector>

#include "plots/canopy/canopy_raster.h"

namespace plotscan::plots {

struct FieldAxes {
  double first_rad = 0;   // direction of one family of lines
  double second_rad = 0;  // of the other, 75 to 105 degrees further
};

// The pair of directions along which the canopy's lines are sharpest: the squared steps, from line
// to line, of the mean canopy along lines through the whole field; the next best one too where it
// is hardly less sharp. The perpendicular pairs of either family where the two disagree, and none
// without canopy. With a hint, the first direction is sought near it, and no other pair.
std::vector<FieldAxes> find_axes(const CanopyRaster& raster, std::optional<double> hint_rad,
                                 int threads);

}  // namespace plotscan::plots
