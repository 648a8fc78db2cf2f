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

// Options of make_farm.
struct MakeFarmOptions {
  std::vector<std::string> overrides = {};  // as description::load_description takes them
  std::optional<std::uint64_t> seed = {};   // absent: the description's, else 1
  int threads = 1;
  bool replace = false;                      // replaces an existing farm
  std::string command = "farmgen generate";  // the command that the manifest names
};

// Reads the description, generates the farm, measures its canopies and writes its folder
// (docs/farm-format.md). It belongs to lidarsim because canopies are measured by rays. Throws
// InputError as load_description, generate and write_farm do, and then leaves nothing behind.
farm::Farm make_farm(const std::filesystem::path& description, const std::filesystem::path& folder,
                     const MakeFarmOptions& options, const ProgressReport& progress = {});

}  // namespace plotscan::lidar
