// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "record/recording/format.h"

namespace plotscan::record {

// Every format, one entry each: reading, writing, messages and help know them from here.
const std::vector<Format>& formats();

// The format of a file by its extension, whatever its case; nothing when there is none.
const Format* find_format(const std::filesystem::path& file);

}  // namespace plotscan::record
