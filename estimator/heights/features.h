// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/plot_box.h"
#include "heights/height_profile.h"

namespace plotscan::heights {

// What the heights of a plot's plants are predicted from (docs/plot-heights.md): shares of `top_m`
// and of the area, which stay the same if the crop is twice as high; and, for the crop's size, the
// logarithms of `top_m`, of the returns and of the peaks per square metre, and how its tops differ
// over 10, 20 and 40 cm.
struct CanopyFeatures {
  double top_m = 0;        // height that 1 % of the area exceeds, without noise
  Eigen::VectorXd values;  // by feature_names()
};

const std::vector<std::string>& feature_names();

// The profile with the heights' noise taken out of it.
HeightProfile without_noise(HeightProfile profile, double noise_m);

// A plot's canopy, measured from its returns (x, y, height above the ground), metres.
struct SeenCanopy {
  HeightProfile profile;  // without the heights' noise
  CanopyFeatures features;
};

// `noise_m` is the sigma of the heights, `slope` the ground's, rise over run.
SeenCanopy see_canopy(const PlotBox& box, std::span<const Eigen::Vector3f> points, double noise_m,
                      double slope);

}  // namespace plotscan::heights
