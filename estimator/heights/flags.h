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

struct FlagOptions {
  double least_returns_m2 = 60;           // fewer and the plot's top is chance
  std::size_t least_returns = 100;        // in a plot
  double least_scanned_share = 0.9;       // less and the survey's edge cuts the plot
  double least_ground_share = 0.95;       // less of the plot has a ground
  double largest_ground_error_m = 0.025;  // standard error of any place in the plot
  double least_top_m = 0.05;              // lower and there is no crop to measure
  double least_top_sigmas = 3;            // of the heights' noise
  double largest_error_m = 0.025;         // standard error of a height: +-5 cm at 95 %
};

// The flag of a height of this name ("p50") whose 95 % interval is wide, and whether it is raised.
std::string unsure_flag(const std::string& name);
bool is_unsure(const Height& height, const FlagOptions& options = {});

// The height that this flag alone speaks of; none: it speaks of all heights of the plot.
std::optional<std::string> height_of_flag(const std::string& flag);

// Whether returns show that there is no crop to measure.
bool is_bare(const PlotEvidence& evidence, const FlagOptions& options = {});

// Why the plot's heights, or one of them, should not be trusted; empty when they may be.
std::vector<std::string> flags_of(const PlotEvidence& evidence,
                                  const std::map<std::string, Height>& heights,
                                  const FlagOptions& options = {});

}  // namespace plotscan::heights
