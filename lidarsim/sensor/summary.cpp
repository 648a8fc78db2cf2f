// SPDX-License-Identifier: Apache-2.0
#include "sensor/summary.h"

#include <algorithm>
#include <array>

#include <fmt/core.h>

#include "core/angle.h"
#include "sensor/risley.h"

namespace plotscan::sensor {
namespace {

std::size_t channels(const Sensor& sensor) { return sensor.wedges ? 1 : sensor.lasers.size(); }

double shots_per_s(const Sensor& sensor) {
  return static_cast<double>(sensor.lasers.size()) /
         sequence_time_s(sensor, sensor.default_spin_hz);
}

double cone_deg(const Sensor& sensor) { return 2 * deflections_rad(*sensor.wedges)[0] / kDegrees; }

// The lowest and the highest laser's.
std::array<double, 2> elevations_deg(const Sensor& sensor) {
  const auto [least, most] = std::ranges::minmax(sensor.lasers, {}, &Laser::elevation_rad);
  return {least.elevation_rad / kDegrees, most.elevation_rad / kDegrees};
}

std::string field_of_view(const Sensor& sensor) {
  if (sensor.wedges) return fmt::format("cone of {:.1f} deg", cone_deg(sensor));
  const auto [least, most] = elevations_deg(sensor);
  return fmt::format("360 x {:.4g}..{:.4g} deg", least, most);
}

std::string spin(const Sensor& sensor) {
  if (sensor.max_spin_hz == 0) return "none";
  return fmt::format("{:.4g} ({:.4g}..{:.4g}) Hz", sensor.default_spin_hz, sensor.min_spin_hz,
                     sensor.max_spin_hz);
}

std::string line(const std::array<std::string, 7>& cells) {
  const auto& [name, channels, view, shots, range, spin, title] = cells;
  return fmt::format("{:12} {:>8}  {:23} {:>9}  {:12}  {:15}  {}", name, channels, view, shots,
                     range, spin, title);
}

}  // namespace

std::vector<std::string> summary_lines(const std::vector<Sensor>& sensors) {
  std::vector<std::string> lines = {
      line({"NAME", "CHANNELS", "FIELD OF VIEW", "SHOTS/S", "RANGE", "SPIN", "TITLE"})};
  for (const Sensor& sensor : sensors) {
    lines.push_back(line({sensor.name, std::to_string(channels(sensor)), field_of_view(sensor),
                          fmt::format("{:.0f}", shots_per_s(sensor)),
                          fmt::format("{:.4g}..{:.4g} m", sensor.min_range_m, sensor.max_range_m),
                          spin(sensor), sensor.title}));
  }
  return lines;
}

nlohmann::json summary_json(const Sensor& sensor) {
  nlohmann::json document = {{"name", sensor.name},
                             {"title", sensor.title},
                             {"kind", sensor.wedges ? "risley" : "spinning"},
                             {"channels", channels(sensor)},
                             {"shots_per_second", shots_per_s(sensor)},
                             {"range_m", {sensor.min_range_m, sensor.max_range_m}}};
  if (sensor.wedges) {
    document["cone_deg"] = cone_deg(sensor);
    return document;
  }
  document["elevation_deg"] = elevations_deg(sensor);
  document["spin_hz"] = {{"least", sensor.min_spin_hz},
                         {"most", sensor.max_spin_hz},
                         {"default", sensor.default_spin_hz}};
  return document;
}

}  // namespace plotscan::sensor
