// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>

namespace plotscan {

// The format that this version writes, and the newest that it reads. Files state theirs as
// "format": a member of manifest.json (for its whole folder), plots.geojson, results.json and
// scores.json, a key of YAML files. A file that states none has format 0, that of version 0.1.0.
inline constexpr int kFormat = 1;

// "is of format 2, which is newer; this plotscan, 0.1.0, reads formats up to 1"; "" if this version
// reads the format. A format must be a whole number from 0 on.
std::string format_error(const nlohmann::json& format);

// Throws InputError naming the file when the document's member "format" is newer or invalid.
void require_known_format(const nlohmann::json& document, const std::filesystem::path& file);

}  // namespace plotscan
