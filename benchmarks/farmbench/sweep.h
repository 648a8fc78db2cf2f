// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

// Suites that find which flight a field needs: one kind of farm, flown with every combination of
// some options' values (docs/sweep.md).
namespace plotscan::farmbench {

// An option of the flight that varies, and its values: numbers or texts.
struct SweepAxis {
  std::string key;  // lidar::FlySetting::key, "altitude_m"
  std::vector<nlohmann::json> values;
};

// The accuracy that is good enough; the sweep's answer is the shortest flight that reaches it.
struct SweepGoal {
  double rmse_m = 0;  // at most, by the upper end of its 95 % interval
  double found = 0;   // of the true plots, at least this share
};

struct Sweep {
  std::vector<SweepAxis> axes;  // case i is their combination i, the last axis varying fastest
  std::string height;           // of the suite's first method, "mean"
  std::string truth;            // that it is held against, "height_mean_m"
  std::optional<SweepGoal> goal = std::nullopt;
};

// The axes' values of combination i.
std::vector<nlohmann::json> combination(const Sweep& sweep, std::size_t i);

// "20" of 20.0, "vlp16": as tables have it.
std::string text_of(const nlohmann::json& value);

void to_json(nlohmann::json& document, const Sweep& sweep);
// Throws nlohmann::json::exception on anything that to_json does not write.
void from_json(const nlohmann::json& document, Sweep& sweep);

}  // namespace plotscan::farmbench
