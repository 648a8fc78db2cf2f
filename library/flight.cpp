// SPDX-License-Identifier: Apache-2.0
#include "plotscan/flight.h"

#include <algorithm>
#include <cmath>

#include "boundary/guarded.h"
#include "boundary/values.h"

#include "core/data_folder.h"
#include "core/error.h"
#include "core/text.h"
#include "lidar/fly_place.h"
#include "lidar/fly_settings.h"

namespace plotscan {
namespace {

// Reads the usual value of a setting, of whatever kind, from the options.
struct UsualValue {
  lidar::FlyOptions& options;

  std::optional<FlightValue> operator()(const lidar::OptionalSetting& setting) const {
    const std::optional<double>& number = setting.of(options);
    return number ? std::optional<FlightValue>(*number) : std::nullopt;
  }
  std::optional<FlightValue> operator()(const lidar::WholeSetting& setting) const {
    return FlightValue(static_cast<double>(setting.of(options)));
  }
  std::optional<FlightValue> operator()(const lidar::VectorSetting& setting) const {
    const Eigen::Vector3d& numbers = setting.of(options);
    return FlightValue(std::array{numbers.x(), numbers.y(), numbers.z()});
  }
  template <class Setting>
  std::optional<FlightValue> operator()(const Setting& setting) const {
    return FlightValue(setting.of(options));
  }
};

template <class Kind>
const Kind& value_as(const FlightValue& value, const std::string& key, const std::string& kind) {
  if (const Kind* held = std::get_if<Kind>(&value)) return *held;
  throw InputError("the flight's " + key + " is " + kind);
}

// Sets the value of a setting in the options; ranges are checked when the flight begins.
struct SetValue {
  lidar::FlyOptions& options;
  const std::string& key;
  const FlightValue& value;

  void operator()(const lidar::WholeSetting& setting) const {
    const auto number = value_as<double>(value, key, "a whole number");
    if (number != std::round(number) || std::abs(number) > 1e6)
      throw InputError("the flight's " + key + " is a whole number");
    setting.of(options) = static_cast<int>(number);
  }
  void operator()(const lidar::VectorSetting& setting) const {
    const auto numbers = value_as<std::array<double, 3>>(value, key, "three numbers");
    setting.of(options) = Eigen::Vector3d(numbers.data());
  }
  void operator()(const lidar::TextSetting& setting) const {
    setting.of(options) = value_as<std::string>(value, key, "a text");
  }
  template <class Setting>
  void operator()(const Setting& setting) const {
    setting.of(options) = value_as<double>(value, key, "a number");
  }
};

const lidar::FlySetting& setting_of(const std::string& key) {
  const auto& settings = lidar::fly_settings();
  const auto found = std::ranges::find(settings, key, &lidar::FlySetting::key);
  if (found != settings.end()) return *found;
  std::vector<std::string> keys;
  keys.reserve(settings.size());
  for (const lidar::FlySetting& setting : settings) keys.push_back(setting.key);
  throw InputError("a flight has no \"" + key + "\"; it has " + joined(keys, ", "));
}

lidar::FlyPlaceOptions inner(const FlightOptions& options) {
  lidar::FlyPlaceOptions made{.resource_paths = options.resource_paths, .replace = options.replace};
  for (const auto& [key, value] : options.settings)
    std::visit(SetValue{made.flight, key, value}, setting_of(key).value);
  made.flight.flight = options.trajectory;
  made.flight.waypoints = options.waypoints;
  made.flight.formats = options.formats;
  made.flight.seed = options.seed;
  made.flight.threads = boundary::threads_of(options.threads);
  return made;
}

}  // namespace

std::vector<FlightSetting> flight_settings() {
  lidar::FlyOptions usual;
  std::vector<FlightSetting> settings;
  for (const lidar::FlySetting& setting : lidar::fly_settings()) {
    const auto* text = std::get_if<lidar::TextSetting>(&setting.value);
    settings.push_back({.key = setting.key,
                        .help = setting.help,
                        .usual = std::visit(UsualValue{usual}, setting.value),
                        .choices = text != nullptr ? text->choices : std::vector<std::string>{}});
  }
  return settings;
}

FlightSummary fly(const std::filesystem::path& place, const std::filesystem::path& folder,
                  const FlightOptions& options, const Progress& progress) {
  return boundary::guarded([&]() -> FlightSummary {
    lidar::PlaceScan scanned =
        lidar::fly_place(found_file(place, "worlds"), folder, inner(options), progress);
    return {.shots = scanned.summary.shots,
            .points = scanned.summary.points,
            .duration_s = scanned.summary.duration_s,
            .notes = std::move(scanned.notes)};
  });
}

}  // namespace plotscan
