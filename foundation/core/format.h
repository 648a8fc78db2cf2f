// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>

namespace plotscan {

// Format of what this version writes, and the newest that it reads: a member "format" of
// manifest.json (for all that its folder holds), of plots.geojson, results.json and scores.json, a
// key "format" of YAML files. What has none is of format 0, as version 0.1.0 wrote it.
inline constexpr int kFormat = 1;

// "is of format 2; this plotscan, 0.1.0, reads formats up to 1"; "" where it reads the format.
// Anything but a whole number from 0 on is none.
std::string format_error(const nlohmann::json& format);

// Throws InputError naming the file when the document's member "format" is newer, or none.
void require_known_format(const nlohmann::json& document, const std::filesystem::path& file);

}  // namespace plotscan
