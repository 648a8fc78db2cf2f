// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "planting/farm_description.h"

namespace plotscan::description {

// Reads a farm description. `overrides` are "key=value" with a dotted key ("terrain.relief_m=1",
// "plots.rows.0.plots=5") and replace what the file says. Throws InputError on an unknown key, a
// wrong type, an impossible value or a file that does not exist, naming file and line (or the
// override), key and what is allowed.
planting::FarmDescription load_description(const std::filesystem::path& file,
                                           const std::vector<std::string>& overrides = {});

}  // namespace plotscan::description
