// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "estimate/cloud_map.h"
#include "estimate/estimate.h"
#include "farm/terrain.h"
#include "score/score.h"

namespace plotscan::farmbench {

// One scanned field as the methods get it. What a method takes of it is its own affair, and its
// name or docs/benchmark.md says so.
struct Field {
  const std::filesystem::path& cloud;  // the whole scan, cloud.pcd
  const std::filesystem::path& poses;  // as the drone reported them, poses.csv of the scan
  const estimate::CloudMap& map;       // its points in the rectangle of the plots and a margin
  const std::vector<score::TruePlot>& plots;
  const farm::Terrain& terrain;
  std::uint64_t seed = 1;
  int threads = 1;
};

// A height that a method gives, and the name of its rows in the tables.
struct MethodHeight {
  std::string height;  // key of PlotEstimate::heights_m
  std::string row;     // "dhami2020/raw-p99"
};

struct Method {
  std::string name;  // in a suite's `methods`
  std::vector<MethodHeight> heights;
  std::function<estimate::Estimate(const Field&)> estimate;
};

// Every method that a suite can name.
const std::vector<Method>& known_methods();

// The method of this name, which must be known.
const Method& method_named(const std::string& name);

// Throws InputError on a name that is not one of them, or stands there twice.
void require_known_methods(const std::vector<std::string>& names);

}  // namespace plotscan::farmbench
