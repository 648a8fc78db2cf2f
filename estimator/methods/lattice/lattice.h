// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "cloud/area.h"
#include "cloud/field_cloud.h"
#include "core/plot_box.h"
#include "core/progress.h"
#include "estimate/estimate.h"
#include "ground/surface.h"
#include "methods/lattice/work_estimate.h"

namespace plotscan::methods::lattice {

inline constexpr double kMostNoise_m = 0.3;  // sigma of heights: no sensor's is larger

// Options of the lattice method, all optional. Their ranges are in settings.cpp.
struct Options {
  std::optional<cloud::Area> crop_box = {};  // use only the points in here
  std::optional<double> heading_deg = {};    // of the plots' length, counter-clockwise from x
  std::optional<double> plot_width_m = {};   // of every plot
  std::optional<double> plot_length_m = {};  // of every plot
  std::optional<int> rows = {};              // of plots; they follow each other along the length
  std::optional<int> columns = {};           // of plots; along the width
  std::optional<int> plots = {};             // how many there are
  std::vector<PlotBox> boxes = {};           // given boxes: no detection, heights only
  std::vector<int> trials = {};  // of the given boxes, each with a crop of its own; none: one trial
  std::optional<double> noise_m = {};    // sigma of the points' heights, else estimated
  bool calibrated = true;                // plants' heights from the canopy's (docs/methods.md)
  std::vector<int> ground_classes = {};  // ASPRS classes that may carry the ground; none: all may
  std::optional<std::string> crop = {};  // one of heights::crop_names(), else from the canopy
  int threads = 1;
  // Called with the work ahead, once the field is read.
  std::function<void(const WorkEstimate&)> on_work = {};
};

// Throws InputError when an option is out of its range.
void require_sound(const Options& options);

// Finds the plots of a field and measures each one's heights "mean", "max", "p50", "p90", "p95" and
// "p99" of its plants, and "canopy_p95" and "canopy_p99" of its canopy, with standard errors, 95 %
// intervals and flags, over one ground surface for the whole field (docs/methods.md). A field
// without a lattice of plots has an estimate without plots; diagnostics.why_no_plots says why.
// Throws InputError on options out of range and on ground classes that the cloud lacks,
// NothingToMeasure on a cloud without ground.
estimate::Estimate estimate_plots(cloud::FieldCloud cloud, const Options& options,
                                  const ProgressReport& progress = {});

// A field on the way: its plots are found, or given, and nothing of them is measured yet.
struct FoundField {
  std::vector<Eigen::Vector3f> heights;  // of all points, metres: x, y, height above the ground
  ground::Surface surface;               // in the frame of `heights`
  Eigen::Vector3d origin;                // of that frame, in the cloud's
  estimate::Estimate estimate;           // without heights; in the frame of `heights`
};

// The two halves of estimate_plots. The settings that `measures` marks are of the second alone, so
// that a field found once is measured with several of them.
FoundField find_field(const CloudFiles& cloud, const Options& options,
                      const ProgressReport& progress = {});
estimate::Estimate measure_field(const FoundField& field, const Options& options,
                                 const ProgressReport& progress = {});

// How the method reads a cloud: its crop box; else the given boxes and the ground around them; else
// the whole scanned field.
cloud::FieldOptions field_options(const Options& options);

// The same from a cloud, read so. Throws InputError on a broken cloud, and as above.
estimate::Estimate estimate_plots(const CloudFiles& cloud, const Options& options,
                                  const ProgressReport& progress = {});

}  // namespace plotscan::methods::lattice
