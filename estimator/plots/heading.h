// SPDX-License-Identifier: Apache-2.0
#pragma once

// Private to the library: the two directions along which a field's alleys run.

#include <optional>

#include "plots/canopy_raster.h"

namespace plotscan::plots {

struct FieldAxes {
  double first_rad = 0;   // direction of one family of lines
  double second_rad = 0;  // of the other, 60 to 120 degrees further
  double sharpness = 0;   // of both families' edges, over what a random direction shows
};

// The directions along which the cover's lines are sharpest: means of cover along lines in blocks
// of some metres, whose steps across the lines are squared and summed. Blocks, so that rows of
// other offsets do not blur each other. With a hint, the first direction is sought near it.
FieldAxes find_axes(const CanopyRaster& raster, std::optional<double> hint_rad, int threads);

}  // namespace plotscan::plots
