// SPDX-License-Identifier: Apache-2.0
#include "sensor/summary.h"

#include <algorithm>
#include <array>

#include <fmt/core.h>

#include "core/angle.h"
#include "sensor/risley.h"

namespace plotscan::sensor {
namespace {

std::string field_of_view(const SensorSummary& summary) {
  if (summary.is_risley) return fmt::format("cone of {:.1f} deg", summary.cone_deg);
  return fmt::format("360 x {:.4g}..{:.4g} deg", summary.least_elevation_deg,
                     summary.most_elevation_deg);
}

std::string spin(const SensorSummary& summary) {
  if (summary.max_spin_hz == 0) return "none";
  return fmt::format("{:.4g} ({:.4g}..{:.4g}) Hz", summary.default_spin_hz, summary.min_spin_hz,
                     summary.max_spin_hz);
}

std::string line(const std::array<std::string, 7>& cells) {
  const auto& [name, channels, view, shots, range, spin, title] = cells;
  return fmt::format("{:12} {:>8}  {:23} {:>9}  {:12}  {:15}  {}", name, channels, view, shots,
                     range, spin, title);
}

}  // namespace

SensorSummary summary_of(const Sensor& sensor) {
  const double lasers = static_cast<double>(sensor.lasers.size());
  SensorSummary summary{.name = sensor.name,
                        .title = sensor.title,
                        .channels = sensor.wedges ? 1 : static_cast<int>(sensor.lasers.size()),
                        .shots_per_s = lasers / sequence_time_s(sensor, sensor.default_spin_hz),
                        .min_range_m = sensor.min_range_m,
                        .max_range_m = sensor.max_range_m,
                        .min_spin_hz = sensor.min_spin_hz,
                        .max_spin_hz = sensor.max_spin_hz,
                        .default_spin_hz = sensor.default_spin_hz};
  summary.is_risley = sensor.wedges.has_value();
  if (summary.is_risley) {
    summary.cone_deg = 2 * deflections_rad(*sensor.wedges)[0] / kDegrees;
    return summary;
  }
  const auto [least, most] = std::ranges::minmax(sensor.lasers, {}, &Laser::elevation_rad);
  summary.least_elevation_deg = least.elevation_rad / kDegrees;
  summary.most_elevation_deg = most.elevation_rad / kDegrees;
  return summary;
}

std::vector<std::string> summary_lines(const std::vector<SensorSummary>& summaries) {
  std::vector<std::string> lines = {
      line({"NAME", "CHANNELS", "FIELD OF VIEW", "SHOTS/S", "RANGE", "SPIN", "TITLE"})};
  for (const SensorSummary& summary : summaries) {
    lines.push_back(line({summary.name, std::to_string(summary.channels), field_of_view(summary),
                          fmt::format("{:.0f}", summary.shots_per_s),
                          fmt::format("{:.4g}..{:.4g} m", summary.min_range_m, summary.max_range_m),
                          spin(summary), summary.title}));
  }
  return lines;
}

nlohmann::json summary_json(const SensorSummary& summary) {
  nlohmann::json document = {{"name", summary.name},
                             {"title", summary.title},
                             {"kind", summary.is_risley ? "risley" : "spinning"},
                             {"channels", summary.channels},
                             {"shots_per_second", summary.shots_per_s},
                             {"range_m", {summary.min_range_m, summary.max_range_m}}};
  if (summary.is_risley) {
    document["cone_deg"] = summary.cone_deg;
    return document;
  }
  document["elevation_deg"] = {summary.least_elevation_deg, summary.most_elevation_deg};
  document["spin_hz"] = {{"least", summary.min_spin_hz},
                         {"most", summary.max_spin_hz},
                         {"default", summary.default_spin_hz}};
  return document;
}

}  // namespace plotscan::sensor
