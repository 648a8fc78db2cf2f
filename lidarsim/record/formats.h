// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "record/recording/format.h"

namespace plotscan::record {

// Every format, one entry each: reading, writing, messages and help know them from here.
const std::vector<Format>& formats();

// The extensions of those that are `wanted`, in the table's order: ".pcd", ...
std::vector<std::string> extensions_of(bool (*wanted)(const Format&));

// The clouds that are read, as help lists them: ".pcd, .ply, .las, text".
std::string readable_clouds();

// The format of a file by its extension, whatever its case; nothing when there is none.
const Format* find_format(const std::filesystem::path& file);

}  // namespace plotscan::record
