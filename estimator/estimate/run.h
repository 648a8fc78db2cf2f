// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/cloud_files.h"
#include "core/progress.h"
#include "estimate/dhami2020/dhami2020.h"
#include "estimate/lattice/lattice.h"

namespace plotscan::estimate {

// One run of a method, from files to an estimate folder.
struct RunOptions {
  CloudFiles cloud;  // files and folders, as cloud_files_of takes them
  std::filesystem::path output;
  std::string method = "lattice";                   // one of method_names()
  std::optional<std::filesystem::path> boxes = {};  // plots.geojson: heights only, in its boxes
  bool replace = false;                             // an estimate folder that exists
  // Use only the points in here. In the cloud's own coordinates, as are the given boxes and
  // dhami2020's learn box; metres of UTM where the cloud is in degrees.
  std::optional<Area> crop_box = {};
  LatticeOptions lattice = {};      // crop box, boxes, threads are taken from here
  Dhami2020Options dhami2020 = {};  // as above, and the seed
  std::uint64_t seed = 1;
  int threads = 1;
};

// The methods that `run` knows, the default first.
const std::vector<std::string>& method_names();

// Runs the method and writes the estimate folder (docs/estimate-format.md). Methods count in
// metres: the cloud's own coordinates become metres here and at reading, and become its own again
// in write_estimate. With given boxes, plots keep the file's numbers, rows and columns. Throws
// InputError on bad input; nothing is left behind then.
Estimate run(const RunOptions& options, const ProgressReport& progress = {});

// How many plots have each height, and its median, least and greatest value, metres.
nlohmann::json height_summary(const Estimate& estimate);

}  // namespace plotscan::estimate
