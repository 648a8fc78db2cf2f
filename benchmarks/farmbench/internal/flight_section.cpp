// SPDX-License-Identifier: Apache-2.0
#include "farmbench/internal/flight_section.h"

#include <variant>
#include <vector>

#include "core/error.h"
#include "core/utc_time.h"
#include "sensor/sensor.h"

namespace plotscan::farmbench {
namespace {

// A number, or an optional one.
template <class Value>
void read_into(const YamlSection& section, const std::string& key,
               const RangedSetting<lidar::FlyOptions, Value>& setting, lidar::FlyOptions& flight) {
  setting.of(flight) = section.number(key, setting.range);
}

void read_into(const YamlSection& section, const std::string& key,
               const lidar::WholeSetting& setting, lidar::FlyOptions& flight) {
  setting.of(flight) = static_cast<int>(section.integer(key, static_cast<int>(setting.range.low),
                                                        static_cast<int>(setting.range.high)));
}

void read_into(const YamlSection& section, const std::string& key,
               const lidar::VectorSetting& setting, lidar::FlyOptions& flight) {
  const std::vector<double> numbers = section.numbers(key, 3, setting.range);
  setting.of(flight) = Eigen::Vector3d(numbers[0], numbers[1], numbers[2]);
}

void read_into(const YamlSection& section, const std::string& key,
               const lidar::TextSetting& setting, lidar::FlyOptions& flight) {
  setting.of(flight) = setting.choices.empty()
                           ? section.text(key)
                           : setting.choices[section.choice(key, setting.choices)];
}

// The names that no table of choices holds: of a sensor or its file, and of an instant.
void require_known(const YamlSection& section, const std::string& key,
                   const lidar::FlyOptions& flight) {
  try {
    if (key == "sensor") sensor::load_sensor(flight.sensor);
  } catch (const InputError& error) {
    section.fail(key, std::string("does not hold: ") + error.what());
  }
  if (key == "start_utc" && !parse_utc(flight.start_utc))
    section.fail(key, "\"{}\" is not like 2026-06-01T10:00:00Z, from 1980 to 2099",
                 flight.start_utc);
}

}  // namespace

void read_fly_setting(const YamlSection& section, const lidar::FlySetting& setting,
                      lidar::FlyOptions& flight) {
  std::visit([&](const auto& value) { read_into(section, setting.key, value, flight); },
             setting.value);
  require_known(section, setting.key, flight);
}

lidar::FlyOptions read_flight(const YamlSection& parent, lidar::FlyOptions flight) {
  if (!parent.has("flight")) return flight;
  const YamlSection section = parent.section("flight");
  for (const lidar::FlySetting& setting : lidar::fly_settings())
    if (section.has(setting.key)) read_fly_setting(section, setting, flight);
  return flight;
}

}  // namespace plotscan::farmbench
