// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "core/random.h"
#include "crop/internal/axis.h"
#include "crop/plant_builder.h"

namespace plotscan::crop {

// An ear about the upper end of a shoot's axis.
struct WheatEar {
  double foot_m = 0;        // length along the axis at which it begins
  double length_m = 0;      // without awns; the axis goes on for as long
  double shown_from_m = 0;  // length along the axis below which the flag leaf's sheath hides it
  double side_rad = 0;      // azimuth of the spikelets of one row; the other row is opposite
  int spikelets = 0;        // one at the tip, the others in turn to both sides
  double spikelet_m = 0;
  double spikelet_radius_m = 0;
  double awn_m = 0;
  std::string material;
};

// In light detail a spindle with the awns of its tip.
void grow_wheat_ear(const WheatEar& ear, const Axis& axis, RandomStream& random,
                    PlantBuilder& plant);

}  // namespace plotscan::crop
