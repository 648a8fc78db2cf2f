// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "core/angle.h"
#include "crop/plant_builder.h"

namespace plotscan::crop {

inline constexpr double kUpright = kPi / 2;  // elevation

// The blade of a grass leaf from its collar on: it leaves the stem upward, bends over under its
// weight, twists, and waves at its margins.
struct GrassBlade {
  Eigen::Vector3d collar;
  double azimuth_rad = 0;
  double elevation_rad = 0;     // of the midrib at the collar
  double bend_rad = 0;          // by which the tip points lower than the collar
  double bend_exponent = 1;     // 1: an arc; more: straight first, then bending
  double twist_rad = 0;         // by which the tip is turned about the midrib
  double undulation_rad = 0;    // by which the margins rise and fall about the midrib
  double undulation_waves = 0;  // along the blade
  double undulation_phase = 0;  // radians
  double length_m = 0;          // of the whole blade
  double width_m = 0;           // where it is widest
  double base_width_share = 1;  // width at the collar over the greatest
  double widest_at = 0.4;       // share of the length
  double visible = 1;           // share of the length, from the tip, that has left the whorl
  double fold_rad = 0;          // of each half, upward
  int points = 10;              // of the midrib
  int light_points = 4;         // in light detail
};

// Half the width at a share of a grass blade's length, over the greatest half width: a quarter sine
// from the base's share up to the widest place, then a root of a cosine down to the pointed tip.
// The area is then about 0.75 of length x width, Montgomery's factor for maize and wheat
// (Montgomery 1911; Stewart & Dwyer 1999).
double grass_width_share(double share, double base_width_share, double widest_at);

// The leaf as a sheet. Where the blade would go below the ground (z = 0) it lies on the ground.
Blade grass_blade(const GrassBlade& blade);

// A quantity along a stem's ranks (1, 2, ... from the base): `first` at rank 1, 1 at the peak rank,
// `last` at the last rank, rising with a power of a sine and falling with a sine: the bell shape of
// leaf and internode lengths (Dwyer & Stewart 1986; Fournier & Andrieu 2000). Ranks before the
// first count as the first.
struct RankProfile {
  double first_rank;
  double peak_rank;
  double last_rank;
  double first;
  double last;
  double rise_exponent = 1;

  double at(double rank) const;
};

}  // namespace plotscan::crop
