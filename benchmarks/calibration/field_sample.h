// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "calibration/farm_plan.h"
#include "core/plot_box.h"
#include "ground/surface.h"

namespace plotscan::calibration {

// A plot as it was scanned, and its true heights by name ("mean", ..., "canopy_p99"), metres.
struct PlotSample {
  PlotBox box;
  std::map<std::string, double> truth;
  std::vector<Eigen::Vector3f> points = {};   // x, y, height above the ground
  std::vector<Eigen::Vector3f> perfect = {};  // the same of rays straight down without any error
};

// A field that was flown over.
struct FieldSample {
  std::string library;
  std::uint64_t seed = 0;
  ground::Surface surface = {};
  std::vector<PlotSample> plots = {};
};

// Where the heights above ground are counted from.
enum class GroundSource { truth, fitted };

// Makes the farm, flies over it and measures its points' heights above the ground. `work` is a
// folder for intermediate files, removed afterwards.
FieldSample sample_field(const FarmPlan& plan, const std::filesystem::path& base_farm,
                         GroundSource source, const std::filesystem::path& work, int threads);

// One file a field, so that a fit can be repeated without flying.
void write_sample(const std::filesystem::path& file, const FieldSample& sample);
// Throws InputError on a file that is no sample, or ends too early.
FieldSample read_sample(const std::filesystem::path& file);

}  // namespace plotscan::calibration
