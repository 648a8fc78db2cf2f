// SPDX-License-Identifier: Apache-2.0
#include "sensor/sensor.h"

#include <algorithm>
#include <cmath>

#include "core/angle.h"
#include "core/contains.h"
#include "core/csv.h"
#include "core/error.h"
#include "core/text.h"
#include "core/yaml_section.h"
#include "sensor/internal/sensor_files.h"
#include "sensor/risley.h"

namespace plotscan::sensor {
namespace {

constexpr Range kElevation_deg{-90, 90};
constexpr Range kAzimuth_deg{-360, 360};
constexpr Range kOffset_mm{-1000, 1000};
constexpr Range kRange_m{0, 10'000};
constexpr double kFinestStep_m = 1e-6;
constexpr Range kSpin_hz{0.01, 1000};
constexpr Range kSpinJitter_deg{0, 1};
constexpr Range kSequence_us{0.1, 1e6};
constexpr Range kDivergence_mrad{0, 100};
constexpr Range kPulse_ns{0.01, 1000};
constexpr Range kReflectance{0, 1};
constexpr Range kDistanceStep_mm{0.1, 100};
constexpr double kMostPacketSteps = 65'535;  // 16 bits

constexpr Range kSlant_deg{0, 45};
constexpr Range kRefractiveIndex{1, 4};
constexpr Range kPrism_rpm{-1e6, 1e6};
constexpr Range kPhase_deg{-360, 360};
constexpr std::size_t kMaxSources = 100;
constexpr int kMaxColumns = 1'000'000;
// A Risley scanner's shots are worked on this many at once: enough to keep a processor's vectors
// full, and so few that the drone turns little meanwhile.
constexpr int kRisleyShots = 32;

// Reads the lasers. They must fire within the firing sequence, which takes `sequence_us` at least.
std::vector<Laser> read_lasers(const YamlSection& root, double sequence_us) {
  std::vector<Laser> lasers;
  double before_us = 0;
  for (const YamlSection& section : root.list("lasers", kMaxLasers)) {
    const double fires_us = section.number("fires_us", {before_us, sequence_us});
    lasers.push_back({.elevation_rad = radians(section.number("elevation_deg", kElevation_deg)),
                      .azimuth_rad = radians(section.number("azimuth_deg", kAzimuth_deg, 0.0)),
                      .offset_m = 1e-3 * section.number("offset_mm", kOffset_mm, 0.0),
                      .radius_m = 1e-3 * section.number("radius_mm", kOffset_mm, 0.0),
                      .fires_s = 1e-6 * fires_us});
    before_us = fires_us;
  }
  for (Laser& laser : lasers) {
    laser.ring = static_cast<std::uint16_t>(std::ranges::count_if(
        lasers, [&](const Laser& other) { return other.elevation_rad < laser.elevation_rad; }));
  }
  return lasers;
}

Beam read_beam(const YamlSection& section) {
  const auto [along_mrad, across_mrad] = section.pair("divergence_mrad", kDivergence_mrad);
  const YamlSection faintest = section.section("faintest");
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
  const PacketFormat format{
      .product = static_cast<std::uint8_t>(section.integer("product", 0, 255)),
      .distance_step_m = 1e-3 * section.number("distance_mm", kDistanceStep_mm)};
  if (sensor.lasers.size() != 16 && sensor.lasers.size() != 32)
    section.fail("product", "needs 16 or 32 lasers: Velodyne's packets hold no other number");
  if (sensor.columns_per_turn > 0)
    section.fail("product", "needs firing_sequence_us: Velodyne's sensors fire by the clock");
  if (sensor.max_range_m > kMostPacketSteps * format.distance_step_m)
    section.fail("distance_mm", "is too fine: range.most_m is beyond 65535 steps of it");
  return format;
}

void read_spin(const YamlSection& root, Sensor& sensor) {
  const YamlSection spin = root.section("spin_hz");
  sensor.min_spin_hz = spin.number("least", kSpin_hz);
  sensor.max_spin_hz = spin.number("most", {sensor.min_spin_hz, kSpin_hz.high});
  sensor.default_spin_hz = spin.number("default", {sensor.min_spin_hz, sensor.max_spin_hz});
}

// Firing sequences follow the clock or the spin.
void read_sequence(const YamlSection& root, Sensor& sensor) {
  const bool by_clock = root.has("firing_sequence_us");
  if (by_clock == root.has("columns_per_turn")) {
    root.fail("firing_sequence_us",
              "or columns_per_turn has to be given, one of the two: the first of a sensor that "
              "fires by the clock, the second of one that fires by its azimuth");
  }
  if (by_clock) {
    sensor.sequence_s = 1e-6 * root.number("firing_sequence_us", kSequence_us);
  } else {
    sensor.columns_per_turn = static_cast<int>(root.integer("columns_per_turn", 1, kMaxColumns));
  }
}

void read_spinning(const YamlSection& root, Sensor& sensor) {
  read_spin(root, sensor);
  read_sequence(root, sensor);
  sensor.lasers = read_lasers(root, 1e6 * sequence_time_s(sensor, sensor.max_spin_hz));
  sensor.spin_jitter_rad = radians(root.number("spin_jitter_deg", kSpinJitter_deg, 0.0));
  if (sensor.spin_jitter_rad > 0 && sensor.columns_per_turn > 0)
    root.fail("spin_jitter_deg",
              "needs firing_sequence_us: a sensor that fires by its azimuth is always on it");
}

void read_risley(const YamlSection& root, Sensor& sensor) {
  const double period_s = 1e-6 * root.number("shot_period_us", kSequence_us);
  for (int shot = 0; shot < kRisleyShots; ++shot)
    sensor.lasers.push_back({.fires_s = shot * period_s});
  sensor.sequence_s = kRisleyShots * period_s;
  const auto sections = root.list("prisms", 2);
  if (sections.size() != 2) root.fail("prisms", "must be two");
  std::array<Wedge, 2> wedges;
  for (std::size_t i = 0; i < 2; ++i) {
    const YamlSection& section = sections[i];
    wedges[i] = {.slant_rad = radians(section.number("wedge_deg", kSlant_deg)),
                 .refractive_index = section.number("refractive_index", kRefractiveIndex),
                 .turns_hz = section.number("rpm", kPrism_rpm) / 60,
                 .phase_rad = radians(section.number("phase_deg", kPhase_deg, 0.0))};
  }
  if (std::isnan(deflections_rad(wedges)[0]))
    root.fail("prisms", "are so steep that they reflect the beam back; smaller wedges would not");
  sensor.wedges = wedges;
}

Sensor read_sensor(const YamlSection& root, const std::string& description) {
  const bool is_risley = root.choice("kind", {"spinning", "risley"}) == 1;
  Sensor sensor{.name = root.text("name"),
                .title = root.text("title"),
                .lasers = {},
                .description = description};
  const YamlSection range = root.section("range");
  sensor.min_range_m = range.number("least_m", kRange_m);
  sensor.max_range_m = range.number("most_m", {sensor.min_range_m, kRange_m.high});
  sensor.range_step_m = range.number("step_m", {0, 1}, 0.0);
  if (sensor.range_step_m > 0 && sensor.range_step_m < kFinestStep_m)
    range.fail("step_m", "is to be 0, for none, or in [1e-06, 1]");
  if (root.has("sources")) {
    for (const YamlSection& source : root.list("sources", kMaxSources, "source"))
      source.text("source");
  }
  if (root.has("beam")) sensor.beam = read_beam(root.section("beam"));
  if (is_risley) {
    read_risley(root, sensor);
  } else {
    read_spinning(root, sensor);
    sensor.packets = read_packets(root, sensor);
  }
  root.refuse_unread();
  return sensor;
}

}  // namespace

double sequence_time_s(const Sensor& sensor, double spin_hz) {
  return sensor.columns_per_turn > 0 ? 1 / (spin_hz * sensor.columns_per_turn) : sensor.sequence_s;
}

double chosen_spin_hz(const Sensor& sensor, std::optional<double> asked_hz) {
  if (sensor.wedges) {
    if (!asked_hz) return 0;
    throw InputError("sensor " + sensor.name + " does not spin; leave out --spin (spin_hz)");
  }
  const double spin_hz = asked_hz.value_or(sensor.default_spin_hz);
  if (spin_hz >= sensor.min_spin_hz && spin_hz <= sensor.max_spin_hz) return spin_hz;
  throw InputError("--spin " + format_number(spin_hz) + " must be in [" +
                   format_number(sensor.min_spin_hz) + ", " + format_number(sensor.max_spin_hz) +
                   "] Hz for sensor " + sensor.name);
}

Sensor parse_sensor(const std::string& description, const std::filesystem::path& file) {
  return read_sensor(YamlSection::parse(description, file), description);
}

Sensor parse_shipped_sensor(const std::string& description, const std::string& name) {
  const YamlSection root = YamlSection::parse(description, "models/sensors/" + name + ".yaml");
  Sensor sensor = read_sensor(root, description);
  if (sensor.name != name)
    root.fail("name", "is " + sensor.name + ", but the file is " + name + "'s");
  return sensor;
}

Sensor load_sensor(const std::string& name_or_file) {
  if (contains(sensor_names(), name_or_file))
    return parse_shipped_sensor(sensor_file(name_or_file), name_or_file);
  if (!name_or_file.ends_with(".yaml")) {
    throw InputError("sensor \"" + name_or_file + "\" is unknown; there are " +
                     joined(sensor_names(), ", ") + ", or give a sensor's own file, NAME.yaml");
  }
  return parse_sensor(read_text(name_or_file), name_or_file);
}

}  // namespace plotscan::sensor
