// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <variant>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/setting.h"
#include "lidar/fly.h"

namespace plotscan::lidar {

// An OptionalSetting that is not set keeps the default of the sensor or the flight.
using NumberSetting = plotscan::NumberSetting<FlyOptions>;
using OptionalSetting = plotscan::OptionalSetting<FlyOptions>;
using WholeSetting = plotscan::WholeSetting<FlyOptions>;
using VectorSetting = plotscan::VectorSetting<FlyOptions>;
using TextSetting = plotscan::TextSetting<FlyOptions>;

// What of a flight a setting plans. No plan has an effect when a trajectory is given; one of strips
// has none when waypoints are given.
enum class Plan { none, flight, strips };

// One option of a flight. The command line, suites and manifests all take it from this one table.
struct FlySetting {
  std::string key;   // in suites and manifests, "altitude_m"
  std::string flag;  // on the command line, "--altitude"
  std::string help;  // unit, range, meaning
  std::variant<NumberSetting, OptionalSetting, WholeSetting, VectorSetting, TextSetting> value;
  Plan plans = Plan::none;
  std::string group = "Flight and sensor";  // heading in --help
};

const std::vector<FlySetting>& fly_settings();

// Whether the setting has an effect, given the trajectory or waypoints in the options.
bool counts(const FlySetting& setting, const FlyOptions& options);

// The value of every setting that counts, by its key.
nlohmann::json settings_json(const FlyOptions& options);

// Throws InputError, naming the flag, when a value is outside its setting's range or choices.
void require_valid(const FlyOptions& options);

}  // namespace plotscan::lidar
