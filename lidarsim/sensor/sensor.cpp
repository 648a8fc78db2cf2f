// SPDX-License-Identifier: Apache-2.0
#include "sensor/sensor.h"

#include <algorithm>
#include <numbers>

#include "core/error.h"
#include "core/text.h"
#include "core/yaml_section.h"
#include "sensor/sensor_files.h"

namespace plotscan::sensor {
namespace {

constexpr Range kElevation_deg{-90, 90};
constexpr Range kOffset_mm{-1000, 1000};
constexpr Range kRange_m{0, 10'000};
constexpr Range kSpin_hz{0.01, 1000};
constexpr Range kSequence_us{0.1, 1e6};
constexpr Range kDivergence_mrad{0, 100};
constexpr Range kPulse_ns{0.01, 1000};
constexpr Range kReflectance{0, 1};
constexpr Range kDistanceStep_mm{0.1, 100};
constexpr double kMostPacketSteps = 65'535;  // 16 bits

std::vector<Laser> read_lasers(const YamlSection& root, double sequence_us) {
  std::vector<Laser> lasers;
  for (const YamlSection& section : root.list("lasers", kMaxLasers)) {
    section.allow_only({"fires_us", "elevation_deg", "offset_mm"});
    const double before_us = lasers.empty() ? 0 : 1e6 * lasers.back().fires_s;
    lasers.push_back(
        {.elevation_rad = section.number("elevation_deg", kElevation_deg) * std::numbers::pi / 180,
         .offset_m = 1e-3 * section.number("offset_mm", kOffset_mm, 0.0),
         .fires_s = 1e-6 * section.number("fires_us", {before_us, sequence_us})});
  }
  if (lasers.empty()) root.fail("lasers", "must name at least one laser");
  for (Laser& laser : lasers) {
    laser.ring = static_cast<std::uint16_t>(std::ranges::count_if(
        lasers, [&](const Laser& other) { return other.elevation_rad < laser.elevation_rad; }));
  }
  return lasers;
}

Beam read_beam(const YamlSection& section) {
  section.allow_only({"divergence_mrad", "pulse_ns", "faintest", "least_separation_m"});
  const auto [along_mrad, across_mrad] = section.pair("divergence_mrad", kDivergence_mrad);
  const YamlSection faintest = section.section("faintest");
  faintest.allow_only({"reflectance", "range_m"});
  return {.along_rad = 1e-3 * along_mrad,
          .across_rad = 1e-3 * across_mrad,
          .pulse_s = 1e-9 * section.number("pulse_ns", kPulse_ns),
          .faintest_reflectance = faintest.number("reflectance", kReflectance),
          .faintest_range_m = faintest.number("range_m", {0.01, kRange_m.high}),
          .least_separation_m = section.number("least_separation_m", {0, 100}, 0.0)};
}

std::optional<PacketFormat> read_packets(const YamlSection& root, const Sensor& sensor) {
  if (!root.has("packets")) return std::nullopt;
  const YamlSection section = root.section("packets");
  section.allow_only({"product", "distance_mm"});
  const PacketFormat format{
      .product = static_cast<std::uint8_t>(section.integer("product", 0, 255)),
      .distance_step_m = 1e-3 * section.number("distance_mm", kDistanceStep_mm)};
  if (sensor.lasers.size() != 16 && sensor.lasers.size() != 32)
    section.fail("product", "needs 16 or 32 lasers: Velodyne's packets hold no other number");
  if (sensor.max_range_m > kMostPacketSteps * format.distance_step_m)
    section.fail("distance_mm", "is too fine: range.most_m is beyond 65535 steps of it");
  return format;
}

}  // namespace

const std::vector<std::string>& sensor_names() {
  static const std::vector<std::string> names = {"vlp16"};
  return names;
}

Sensor parse_sensor(const std::string& description, const std::filesystem::path& file) {
  const YamlSection root = YamlSection::parse(description, file);
  root.allow_only({"name", "title", "kind", "range", "spin_hz", "beam", "firing_sequence_us",
                   "lasers", "packets", "sources"});
  Sensor sensor{.name = root.text("name"),
                .title = root.text("title"),
                .lasers = {},
                .description = description};
  root.choice("kind", {"spinning"});
  const YamlSection range = root.section("range");
  range.allow_only({"least_m", "most_m", "step_m"});
  sensor.min_range_m = range.number("least_m", kRange_m);
  sensor.max_range_m = range.number("most_m", {sensor.min_range_m, kRange_m.high});
  sensor.range_step_m = range.number("step_m", {0, 1}, 0.0);
  const YamlSection spin = root.section("spin_hz");
  spin.allow_only({"least", "most"});
  sensor.min_spin_hz = spin.number("least", kSpin_hz);
  sensor.max_spin_hz = spin.number("most", {sensor.min_spin_hz, kSpin_hz.high});
  if (root.has("beam")) sensor.beam = read_beam(root.section("beam"));
  const double sequence_us = root.number("firing_sequence_us", kSequence_us);
  sensor.sequence_s = 1e-6 * sequence_us;
  sensor.lasers = read_lasers(root, sequence_us);
  sensor.packets = read_packets(root, sensor);
  return sensor;
}

Sensor load_sensor(const std::string& name_or_file) {
  if (std::ranges::count(sensor_names(), name_or_file) > 0)
    return parse_sensor(sensor_file(name_or_file), "models/sensors/" + name_or_file + ".yaml");
  if (!name_or_file.ends_with(".yaml")) {
    throw InputError("sensor \"" + name_or_file + "\" is unknown; there are " +
                     joined(sensor_names(), ", ") + ", or give a sensor's own file, NAME.yaml");
  }
  return parse_sensor(read_text(name_or_file), name_or_file);
}

}  // namespace plotscan::sensor
