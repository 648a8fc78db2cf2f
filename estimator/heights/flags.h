// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
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
  double novelty = 0;  // over 1: the canopy is unlike all that the calibration knows
};

struct FlagOptions {
  double least_returns_m2 = 60;           // fewer and the plot's top is chance
  std::size_t least_returns = 100;        // in a plot
  double least_scanned_share = 0.9;       // less and the survey's edge cuts the plot
  double least_ground_share = 0.95;       // less of the plot has a ground
  double largest_ground_error_m = 0.025;  // standard error of any place in the plot
  double least_top_m = 0.05;              // lower and there is no crop to measure
  double least_top_sigmas = 3;            // of the heights' noise
  double largest_error_m = 0.025;         // standard error of the mean: +-5 cm at 95 %
};

inline constexpr const char* kUnsureMean = "mean height is unsure by centimetres";

// Whether that flag is raised on a plot of this mean height.
bool is_unsure(const Height& mean, const FlagOptions& options = {});

// Whether returns show that there is no crop to measure.
bool is_bare(const PlotEvidence& evidence, const FlagOptions& options = {});

// Why the plot's heights should not be trusted; empty when they may be.
std::vector<std::string> flags_of(const PlotEvidence& evidence,
                                  const std::map<std::string, Height>& heights,
                                  const FlagOptions& options = {});

}  // namespace plotscan::heights
