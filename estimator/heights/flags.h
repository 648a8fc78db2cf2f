// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "heights/measure_heights.h"
#include "heights/plot_ground.h"

namespace plotscan::heights {

// What flags are raised on.
struct PlotEvidence {
  std::size_t returns = 0;
  double area_m2 = 0;
  double scanned_share = 0;  // of the box, in cells of half a metre
  double top_m = 0;
  double noise_m = 0;
  PlotGround ground;
  bool reached = false;  // by plants of a taller plot beside it
  double novelty = 0;    // over 1: the canopy is unlike all that the calibration knows
};

// The flag of a height of this name ("p50") whose 95 % interval is wide, and whether it is raised.
std::string unsure_flag(const std::string& name);
bool is_unsure(const Height& height);

// The height that this flag alone speaks of; none: it speaks of all heights of the plot.
std::optional<std::string> height_of_flag(const std::string& flag);

// Whether returns show that there is no crop to measure.
bool is_bare(const PlotEvidence& evidence);

// Why the plot's heights, or one of them, should not be trusted; empty when they may be. The limits
// are in docs/plot-heights.md, "Flags".
std::vector<std::string> flags_of(const PlotEvidence& evidence,
                                  const std::map<std::string, Height>& heights);

}  // namespace plotscan::heights
