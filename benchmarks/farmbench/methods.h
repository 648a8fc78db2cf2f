// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "cloud/cloud_map.h"
#include "estimate/estimate.h"
#include "farmbench/found_fields.h"
#include "score/score.h"
#include "terrain/terrain.h"

namespace plotscan::farmbench {

// Ends the names of methods that measure in the true boxes.
inline constexpr std::string_view kTrueBoxes = " true-boxes";

// One scanned field as the methods get it. Each method uses only a part of it; its name or
// docs/benchmark.md says which.
struct Field {
  const std::filesystem::path& cloud;  // the whole scan, cloud.pcd
  const std::filesystem::path& poses;  // as the drone reported them, poses.csv of the scan
  const cloud::CloudMap& map;          // its points in the rectangle of the plots and a margin
  const std::vector<score::TruePlot>& plots;
  const terrain::Terrain& terrain;
  FoundFields& found;  // of this cloud
  std::uint64_t seed = 1;
  int threads = 1;
};

// A height that a method gives, and the name of its rows in the tables.
struct MethodHeight {
  std::string height;  // key of PlotEstimate::heights_m
  std::string row;     // "dhami2020/raw-p99"
};

struct Method {
  std::string name;  // in results; a suite's {lattice: {calibrated: false}} as one text
  std::vector<MethodHeight> heights;
  std::function<estimate::Estimate(const Field&)> estimate;
};

// Every method that a suite can name.
const std::vector<Method>& known_methods();

// The method of this name: one of known_methods, or an estimator's method with settings after its
// name, "lattice calibrated=false". Throws InputError on another name, and on a setting that the
// method lacks or cannot have.
Method method_named(const std::string& name);

// Every truth that a plot has: "height_hand3_m", and those that heights are named after.
const std::vector<std::string>& known_truths();

// The name of a method as results have it: its words, one blank between two of them.
std::string method_name(const std::string& written);

}  // namespace plotscan::farmbench
