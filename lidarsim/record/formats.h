// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "record/recording/format.h"

namespace plotscan::record {

// Every format, one entry each. Reading, writing, messages and help all take them from this table.
const std::vector<Format>& formats();

// The extensions of those that are `wanted`, in the table's order: ".pcd", ...
std::vector<std::string> extensions_of(bool (*wanted)(const Format&));

// The cloud formats that can be read, as help lists them: ".pcd, .ply, .las, text".
std::string readable_clouds();

// The format of a file by its extension in upper or lower case; nullptr if it has none of them.
const Format* find_format(const std::filesystem::path& file);

}  // namespace plotscan::record
