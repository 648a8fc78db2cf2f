// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>

namespace plotscan {

// A JSON file's text, not yet parsed. Throws InputError when it cannot be read, and where it is
// nested deeper than 100 levels: code that walks through it recurses once per level.
std::string read_json_text(const std::filesystem::path& path);

// The document as files and --json hold it: a line for each value. Bytes that are no UTF-8 are
// replaced.
template <class Json>
std::string json_lines(const Json& document) {
  return document.dump(1, ' ', false, Json::error_handler_t::replace) + '\n';
}

// What the library says is wrong, without the name of its exception.
std::string json_reason(const nlohmann::json::exception& error);

// The parsed document of a JSON file. Throws InputError as above, and when it is not JSON.
nlohmann::json read_json(const std::filesystem::path& path);

}  // namespace plotscan
