// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/plot_box.h"
#include "farmbench/entry/problems.h"

namespace plotscan::farmbench {

// One plot of a file, as it stands there: numbers, texts and lists by their names.
struct EnteredRow {
  std::string place;  // for messages
  nlohmann::json properties = nlohmann::json::object();
  bool box_stated = false;                    // sound or not
  std::optional<PlotBox> box = std::nullopt;  // where it is sound
};

// The rows of a file of plots. What cannot be read goes to `problems`.
std::vector<EnteredRow> read_entered_table(const std::filesystem::path& file, Problems& problems);
std::vector<EnteredRow> read_entered_features(const std::filesystem::path& file,
                                              Problems& problems);

}  // namespace plotscan::farmbench
