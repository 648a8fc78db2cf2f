// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "farm/farm.h"

namespace plotscan::farmfolder {

// Reads a farm folder (docs/farm-format.md) from its truth/ and models/. Throws InputError when a
// file is missing, broken or not as the manifest hashed it, a number is not finite, or a path
// leaves the folder.
farm::Farm read_farm(const std::filesystem::path& folder);

}  // namespace plotscan::farmfolder
