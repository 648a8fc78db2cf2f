// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "core/plot_box.h"
#include "core/progress.h"
#include "estimate/estimate.h"

namespace plotscan::estimate {

// Settings of the paper's pipeline (Dhami et al., IROS 2020, section IV), with the authors' values.
struct Dhami2020Options {
  int plots = 0;  // k of the k-means: how many plots lie in the crop box (or in learn_box)
  std::optional<std::array<double, 4>>
      crop_box;  // x0, y0, x1, y1 in metres; else the cloud's core is found
  std::optional<std::array<double, 4>>
      learn_box;               // x0, y0, x1, y1: learn box size and grid here, carry them on
  std::vector<PlotBox> boxes;  // given boxes: no detection, heights only
  double voxel_m = 0.05;       // edge of the voxel filter's cells
  double min_height_m = 0.15;  // points above this z are crop
  double orientation_bin_rad = 0.3;
  double width_bin_m = 0.3;
  double length_bin_m = 0.5;
  double extend_m = 0.5;            // each end of the box, to show ground
  double plane_tolerance_m = 0.05;  // RANSAC inlier distance
  std::uint64_t seed = 1;
  int threads = 1;
};

// Heights "voxel-max", "raw-max" and "raw-p99" for every plot of a cloud (PCD or PLY).
// Throws InputError on a broken cloud, options out of range, or a cloud in which no plot can be
// found.
Estimate dhami2020(const std::filesystem::path& cloud, const Dhami2020Options& options,
                   const ProgressReport& progress = {});

}  // namespace plotscan::estimate
