// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "core/manifest.h"
#include "core/progress.h"
#include "farm/farm.h"

namespace plotscan::farmfolder {

// Writes the farm folder of docs/farm-format.md: world.sdf, models/, truth/, manifest.json. The
// folder appears whole or not at all. `origin` names the command, options and inputs; seed and
// results are the farm's. With `replace`, an earlier farm at the same place is replaced. Throws
// InputError when the folder cannot be written or exists. Tables and world are written on `threads`
// threads.
void write_farm(const farm::Farm& farm, const std::filesystem::path& folder, bool replace,
                Manifest origin, const ProgressReport& progress = {}, int threads = 1);

}  // namespace plotscan::farmfolder
