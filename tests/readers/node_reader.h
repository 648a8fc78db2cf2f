// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include <nlohmann/json.hpp>

namespace plotscan::testing {

// What a script of tests/readers prints about a file, as JSON; nothing where node or the scripts'
// packages are not installed (scripts/setup does). A script that fails gives a null document.
inline std::optional<nlohmann::json> read_with_node(const std::string& script,
                                                    const std::filesystem::path& file) {
  const std::filesystem::path readers = PLOTSCAN_SOURCE_DIR "/tests/readers";
  const bool has_node = std::system("node --version > /dev/null 2>&1") == 0;
  if (!has_node || !std::filesystem::exists(readers / "node_modules")) return std::nullopt;
  const std::string command = "node '" + (readers / script).string() + "' '" + file.string() + "'";
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  std::string text;
  for (int c = std::fgetc(pipe.get()); c != EOF; c = std::fgetc(pipe.get()))
    text += static_cast<char>(c);
  return nlohmann::json::parse(text, nullptr, false).is_discarded() ? nlohmann::json()
                                                                    : nlohmann::json::parse(text);
}

}  // namespace plotscan::testing
