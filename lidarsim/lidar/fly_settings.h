// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <variant>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/setting.h"
#include "lidar/fly.h"

namespace plotscan::lidar {

// What is not set of an optional one is the sensor's or the flight's own.
using NumberSetting = plotscan::NumberSetting<FlyOptions>;
using OptionalSetting = plotscan::OptionalSetting<FlyOptions>;
using WholeSetting = plotscan::WholeSetting<FlyOptions>;
using VectorSetting = plotscan::VectorSetting<FlyOptions>;
using TextSetting = plotscan::TextSetting<FlyOptions>;

// One option of a flight: the command line, suites and manifests all know it from here.
struct FlySetting {
  std::string key;   // in suites and manifests, "altitude_m"
  std::string flag;  // on the command line, "--altitude"
  std::string help;  // unit, range, meaning
  std::variant<NumberSetting, OptionalSetting, WholeSetting, VectorSetting, TextSetting> value;
  bool plans_flight = false;                // means nothing when a trajectory is given
  bool plans_strips = false;                // means nothing when waypoints are given
  std::string group = "Flight and sensor";  // heading in --help
};

const std::vector<FlySetting>& fly_settings();

// Whether the setting means something beside the trajectory or waypoints that the options name.
bool counts(const FlySetting& setting, const FlyOptions& options);

// The value of every setting that counts, by its key.
nlohmann::json settings_json(const FlyOptions& options);

// Throws InputError, naming the flag, when a value is outside its setting's range or choices.
void require_valid(const FlyOptions& options);

}  // namespace plotscan::lidar
