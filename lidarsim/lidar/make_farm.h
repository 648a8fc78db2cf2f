// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/progress.h"
#include "farm/farm.h"

namespace plotscan::lidar {

// How a farm is made from its description.
struct MakeFarmOptions {
  std::vector<std::string> overrides = {};  // as description::load_description takes them
  std::optional<std::uint64_t> seed = {};   // else the description's, else 1
  int threads = 1;
  bool replace = false;                      // a farm that is there
  std::string command = "farmgen generate";  // the one that the manifest names
};

// Reads the description, generates the farm, measures its canopies and writes its folder
// (docs/farm-format.md). It is here because rays find the canopies' truth. Throws InputError as
// load_description, generate and write_farm do; nothing is left behind then.
farm::Farm make_farm(const std::filesystem::path& description, const std::filesystem::path& folder,
                     const MakeFarmOptions& options, const ProgressReport& progress = {});

}  // namespace plotscan::lidar
