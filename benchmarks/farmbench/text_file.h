// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>

namespace plotscan::farmbench {

// Writes the text beside the path and renames it, so that the file is whole or not there. Throws
// WriteError when it cannot be written.
void write_text(const std::filesystem::path& path, const std::string& text);

// The same of a document, indented, with a line end.
void write_json(const std::filesystem::path& path, const nlohmann::json& document);

}  // namespace plotscan::farmbench
