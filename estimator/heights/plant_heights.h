// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "heights/calibration.h"
#include "heights/measure_heights.h"

namespace plotscan::heights {

// What a plot's returns show.
struct PlotCanopy {
  double top_m = 0;          // height that 1 % of the area exceeds, without noise
  Eigen::VectorXd features;  // by feature_names()
  std::map<std::string, double> quantiles_m = {};  // what stands for a height without calibration
  double ground_error_m = 0;                       // standard error of the ground under it
};

// The names of the heights, and what stands for each without calibration.
struct CanopyQuantile {
  double area_share = 0;   // of the area that lies below
  double relative_sd = 0;  // of the height's error, over crops (docs/plot-heights.md)
};
const std::map<std::string, CanopyQuantile>& canopy_quantiles();

// A plot's heights by name.
struct PlantHeights {
  std::map<std::string, Height> heights = {};
  double unlike = 0;  // over 1: the canopy is unlike all that the calibration knows
};

// The heights of a field's plots by its canopies' own quantiles, whatever the crop.
std::vector<PlantHeights> quantile_heights(std::span<const PlotCanopy> field);

// The same by what the calibration's farms teach of canopies like the field's, in their order: no
// percentile over a higher one, none over the tallest.
std::vector<PlantHeights> calibrated_heights(std::span<const PlotCanopy> field,
                                             const Calibration& calibration);

}  // namespace plotscan::heights
