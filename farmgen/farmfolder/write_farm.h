// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "core/manifest.h"
#include "core/progress.h"
#include "farm/farm.h"

namespace plotscan::farmfolder {

struct WriteOptions {
  bool replace = false;  // an earlier farm at the same place
  int threads = 1;
  std::filesystem::path description = {};  // the YAML that it was made of, kept; "" for none
};

// Writes the farm folder of docs/farm-format.md: world.sdf, models/, truth/, description/,
// manifest.json. The folder appears whole or not at all. `origin` names the command, options and
// inputs; seed and results are the farm's. Throws InputError when the folder cannot be written or
// exists.
void write_farm(const farm::Farm& farm, const std::filesystem::path& folder, Manifest origin,
                const WriteOptions& options = {}, const ProgressReport& progress = {});

}  // namespace plotscan::farmfolder
