// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "cloud/cloud_map.h"
#include "core/plot_box.h"
#include "core/progress.h"
#include "estimate/estimate.h"

namespace plotscan::methods::dhami2020 {

// Settings of the paper's pipeline (Dhami et al., IROS 2020, section IV), with the authors' values
// where the paper or their tool gives them (docs/dhami2020.md).
struct Options {
  int plots = 0;  // k of the k-means: how many plots lie in the crop box (or in learn_box)
  std::optional<cloud::Area> crop_box = {};  // else the scanned field is found (cloud::read_map)
  std::optional<cloud::Area> learn_box =
      {};                           // learn box size and grid here, carry them over the crop box
  std::vector<PlotBox> boxes = {};  // given boxes: no detection, heights only
  bool level = true;                // false: z = 0 is the ground already
  double voxel_m = 0.05;            // edge of the voxel filter's cells
  double min_height_m = 0.15;       // points above this z are crop
  double orientation_bin_rad = 0.3;
  double width_bin_m = 0.3;
  double length_bin_m = 0.5;
  double extend_m = 0.5;            // each end of the box, to show ground
  double plane_tolerance_m = 0.05;  // RANSAC inlier distance
  std::uint64_t seed = 1;
  int threads = 1;
};

// Throws InputError when an option is out of its range.
void require_sound(const Options& options);

// Heights "voxel-max", "raw-max" and "raw-p99" for every plot of a map: of the plots it finds, or
// of the given boxes, with the plane of its ground. One map serves several calls; crop_box limits
// the search for plots. `clusters` are the boxes before the vote; `diagnostics` says how each step
// went: cluster and vote counts, grid, ground level. Throws InputError on options out of range,
// NothingToMeasure when no plot can be found.
estimate::Estimate estimate_plots(const cloud::CloudMap& map, const Options& options,
                                  const ProgressReport& progress = {});

// The same from a cloud. Reads only the points in crop_box; without it, those around the given
// boxes; without boxes, those in the field that it finds. Throws InputError on a broken cloud, and
// as above.
estimate::Estimate estimate_plots(const CloudFiles& cloud, const Options& options,
                                  const ProgressReport& progress = {});

}  // namespace plotscan::methods::dhami2020
