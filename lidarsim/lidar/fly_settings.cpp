// SPDX-License-Identifier: Apache-2.0
#include "lidar/fly_settings.h"

#include <algorithm>

#include "core/csv.h"
#include "core/error.h"
#include "core/text.h"

namespace plotscan::lidar {
namespace {

template <class... Cases>
struct Overloaded : Cases... {
  using Cases::operator()...;
};

// The settings hand out references into what they are given; nothing is written through these.
template <class Setting>
const auto& value_of(const Setting& setting, const FlyOptions& options) {
  return setting.of(const_cast<FlyOptions&>(options));  // NOLINT(*-const-cast)
}

void require_in_range(const std::string& flag, double value, const Range& range) {
  if (range.contains(value)) return;
  throw InputError(flag + " " + format_number(value) + " must be in " + range.text());
}

}  // namespace

const std::vector<FlySetting>& fly_settings() {
  static const std::vector<FlySetting> settings = {
      {.key = "sensor",
       .flag = "--sensor",
       .help = "a shipped sensor's name, or the file of your own (docs/sensors.md)",
       .value = TextSetting{{}, [](FlyOptions& o) -> std::string& { return o.sensor; }}},
      {.key = "altitude_m",
       .flag = "--altitude",
       .help = "metres over the mean ground under the plots, 0.5 to 120",
       .value = NumberSetting{{0.5, 120}, [](FlyOptions& o) -> double& { return o.altitude_m; }},
       .plans_flight = true},
      {.key = "speed_m_s",
       .flag = "--speed",
       .help = "metres a second, up to 6",
       .value = NumberSetting{{0.01, 6}, [](FlyOptions& o) -> double& { return o.speed_m_s; }},
       .plans_flight = true},
      {.key = "spacing_m",
       .flag = "--spacing",
       .help = "metres between neighbouring strips",
       .value = NumberSetting{{0.1, 1000}, [](FlyOptions& o) -> double& { return o.spacing_m; }},
       .plans_flight = true},
      {.key = "spin_hz",
       .flag = "--spin",
       .help = "turns of the sensor a second, 5 to 20 for the VLP-16",
       .value = NumberSetting{{0.01, 1000}, [](FlyOptions& o) -> double& { return o.spin_hz; }}},
      {.key = "range_noise_m",
       .flag = "--noise",
       .help = "standard deviation of the range noise, metres, 0 to 1",
       .value = NumberSetting{{0, 1}, [](FlyOptions& o) -> double& { return o.range_noise_m; }}},
      {.key = "wind_m_s",
       .flag = "--wind",
       .help =
           "mean wind, metres a second, 0 to 30; a trajectory given by --flight is flown as it is",
       .value = NumberSetting{{0, 30}, [](FlyOptions& o) -> double& { return o.wind.mean_m_s; }}},
      {.key = "wind_from_deg",
       .flag = "--wind-from",
       .help = "where the wind blows from, degrees clockwise from north: 270 is a west wind",
       .value = NumberSetting{{0, 360}, [](FlyOptions& o) -> double& { return o.wind.from_deg; }}},
      {.key = "wind_turbulence",
       .flag = "--wind-turbulence",
       .help = "standard deviation of the gusts as a share of the mean wind, 0 to 1",
       .value = NumberSetting{{0, 1}, [](FlyOptions& o) -> double& { return o.wind.turbulence; }}},
      {.key = "wind_acts_on",
       .flag = "--wind-acts-on",
       .help = "what the wind moves: both, drone, plants",
       .value = TextSetting{{"both", "drone", "plants"},
                            [](FlyOptions& o) -> std::string& { return o.wind_acts_on; }}},
      {.key = "start_utc",
       .flag = "--start",
       .help = "when the flight starts, UTC: for GPS times and ROS stamps",
       .value = TextSetting{{}, [](FlyOptions& o) -> std::string& { return o.start_utc; }}},
  };
  return settings;
}

nlohmann::json settings_json(const FlyOptions& options) {
  nlohmann::json document = nlohmann::json::object();
  for (const FlySetting& setting : fly_settings()) {
    if (options.flight && setting.plans_flight) continue;
    std::visit([&](const auto& value) { document[setting.key] = value_of(value, options); },
               setting.value);
  }
  return document;
}

void require_valid(const FlyOptions& options) {
  for (const FlySetting& setting : fly_settings()) {
    if (options.flight && setting.plans_flight) continue;
    std::visit(Overloaded{[&](const TextSetting& text) {
                            const std::string& value = value_of(text, options);
                            if (text.choices.empty() || std::ranges::count(text.choices, value) > 0)
                              return;
                            throw InputError(setting.flag + " \"" + value + "\" must be one of " +
                                             joined(text.choices, ", "));
                          },
                          [&](const auto& number) {
                            require_in_range(setting.flag, value_of(number, options), number.range);
                          }},
               setting.value);
  }
}

}  // namespace plotscan::lidar
