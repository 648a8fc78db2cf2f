// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include <nlohmann/json.hpp>

#include "core/progress.h"
#include "estimate/dhami2020/dhami2020.h"

namespace plotscan::estimate {

// One run of a method, from files to an estimate folder.
struct RunOptions {
  std::filesystem::path cloud;  // PCD or PLY, or a scan folder with its cloud.pcd
  std::filesystem::path output;
  std::string method = "dhami2020";
  std::optional<std::filesystem::path> boxes = {};  // plots.geojson: heights only, in its boxes
  bool replace = false;                             // an estimate folder that exists
  Dhami2020Options dhami2020 = {};                  // its `boxes` are taken from the file
};

// Runs the method and writes the estimate folder (docs/estimate-format.md). With given boxes, plots
// keep the file's numbers, rows and columns. Throws InputError on bad input; nothing is left behind
// then.
Estimate run(const RunOptions& options, const ProgressReport& progress = {});

// How many plots have each height, and its median, least and greatest value, metres.
nlohmann::json height_summary(const Estimate& estimate);

}  // namespace plotscan::estimate
