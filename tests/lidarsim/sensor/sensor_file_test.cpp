// SPDX-License-Identifier: Apache-2.0
// A user's own sensor file: what is read, and what is refused in one message.
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "sensor/internal/sensor_files.h"
#include "sensor/sensor.h"
#include "temporary_folder.h"

namespace plotscan::sensor {
namespace {

using ::testing::HasSubstr;
using testing::message_of;
using testing::TemporaryFolder;

constexpr const char* kSpinning = R"(name: mine
title: My sensor
kind: spinning
range: {least_m: 0.5, most_m: 50, step_m: 0.004}
spin_hz: {least: 5, most: 20, default: 10}
firing_sequence_us: 100
lasers:
  - {fires_us: 0, elevation_deg: -5}
  - {fires_us: 20, elevation_deg: 5}
sources: ["my desk"]
)";

constexpr const char* kRisley = R"(name: prisms
title: My prisms
kind: risley
range: {least_m: 1, most_m: 100}
shot_period_us: 4
prisms:
  - {wedge_deg: 10, refractive_index: 1.5, rpm: 6000, phase_deg: 90}
  - {wedge_deg: 10, refractive_index: 1.5, rpm: -600}
)";

// The text with one piece of it changed.
std::string changed(std::string text, const std::string& piece, const std::string& by) {
  const auto at = text.find(piece);
  EXPECT_NE(at, std::string::npos) << piece;
  return text.replace(at, piece.size(), by);
}

std::string refusal(const std::string& text) {
  return message_of<InputError>([&] { parse_sensor(text, "mine.yaml"); });
}

std::string refusal(const std::string& text, const std::string& piece, const std::string& by) {
  return refusal(changed(text, piece, by));
}

TEST(SensorFile, SpinningIsRead) {
  const Sensor sensor = parse_sensor(kSpinning, "mine.yaml");
  EXPECT_EQ(sensor.name, "mine");
  EXPECT_EQ(sensor.lasers.size(), 2u);
  EXPECT_EQ(sensor.lasers[1].ring, 1);
  EXPECT_DOUBLE_EQ(sensor.lasers[1].fires_s, 20e-6);
  EXPECT_EQ(sensor.range_step_m, 0.004);
  EXPECT_EQ(sensor.default_spin_hz, 10);
  EXPECT_EQ(sensor.description, kSpinning);
  EXPECT_DOUBLE_EQ(sequence_time_s(sensor, 7), 100e-6);
  const Sensor columns = parse_sensor(
      changed(kSpinning, "firing_sequence_us: 100", "columns_per_turn: 250"), "mine.yaml");
  EXPECT_DOUBLE_EQ(sequence_time_s(columns, 8), 500e-6);
}

TEST(SensorFile, RisleyIsRead) {
  const Sensor sensor = parse_sensor(kRisley, "mine.yaml");
  ASSERT_TRUE(sensor.wedges.has_value());
  EXPECT_DOUBLE_EQ(sensor.wedges->at(0).turns_hz, 100);
  EXPECT_NEAR(sensor.wedges->at(0).phase_rad, 1.5707963, 1e-6);
  EXPECT_DOUBLE_EQ(sensor.wedges->at(1).turns_hz, -10);
  EXPECT_DOUBLE_EQ(sequence_time_s(sensor, 0) / static_cast<double>(sensor.lasers.size()), 4e-6);
}

TEST(SensorFile, SpinIsTheSensorsOwnOrWhatItCan) {
  const Sensor sensor = parse_sensor(kSpinning, "mine.yaml");
  EXPECT_EQ(chosen_spin_hz(sensor, {}), 10);
  EXPECT_EQ(chosen_spin_hz(sensor, 20), 20);
  EXPECT_THAT(message_of<InputError>([&] { chosen_spin_hz(sensor, 21); }),
              HasSubstr("--spin 21 must be in [5, 20] Hz for sensor mine"));
  const Sensor risley = parse_sensor(kRisley, "mine.yaml");
  EXPECT_EQ(chosen_spin_hz(risley, {}), 0);
  EXPECT_THAT(message_of<InputError>([&] { chosen_spin_hz(risley, 10); }),
              HasSubstr("prisms does not spin; leave out --spin"));
}

TEST(SensorFile, IsLoadedByItsPath) {
  const TemporaryFolder folder;
  const auto file = folder.write("mine.yaml", kSpinning);
  EXPECT_EQ(load_sensor(file.string()).title, "My sensor");
  EXPECT_THAT(message_of<InputError>([&] { load_sensor((folder.path() / "no.yaml").string()); }),
              HasSubstr("no.yaml"));
  EXPECT_THAT(message_of<InputError>([] { load_sensor("mine"); }),
              HasSubstr("sensor \"mine\" is unknown; there are vlp16, "));
  EXPECT_THAT(message_of<InputError>([&] { load_sensor(folder.write("e.yaml", "").string()); }),
              HasSubstr("e.yaml:1"));
}

TEST(SensorFile, AShippedOneHasTheNameOfItsFile) {
  EXPECT_EQ(parse_shipped_sensor(kSpinning, "mine").name, "mine");
  EXPECT_THAT(message_of<InputError>([] { parse_shipped_sensor(kSpinning, "yours"); }),
              HasSubstr("models/sensors/yours.yaml:1: name is mine, but the file is yours's"));
  const TemporaryFolder folder;
  EXPECT_EQ(load_sensor(folder.write("yours.yaml", kSpinning).string()).name, "mine");
}

TEST(SensorFile, BrokenYamlIsRefused) {
  EXPECT_THAT(refusal(""), HasSubstr("mine.yaml:1"));
  EXPECT_THAT(refusal("- 1\n- 2\n"), HasSubstr("mine.yaml:1: is not a map"));
  const std::string text = kSpinning;
  EXPECT_THAT(refusal(text.substr(0, text.find("elevation_deg: 5}"))), HasSubstr("mine.yaml:"));
  // Cut at any byte it is a whole sensor or refused.
  for (std::size_t length = 0; length < text.size(); ++length) {
    try {
      EXPECT_EQ(parse_sensor(text.substr(0, length), "mine.yaml").name, "mine");
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr("mine.yaml:")) << length;
    }
  }
}

TEST(SensorFile, KeysAreChecked) {
  EXPECT_THAT(refusal(kSpinning, "kind: spinning", "kind: flash"),
              HasSubstr("mine.yaml:3: kind \"flash\" is not one of spinning, risley"));
  EXPECT_THAT(refusal(kSpinning, "kind: spinning\n", ""), HasSubstr("kind is missing"));
  EXPECT_THAT(refusal(kSpinning, "name: mine\n", ""), HasSubstr("name is missing"));
  EXPECT_THAT(refusal(kSpinning, "title: My sensor\n", ""), HasSubstr("title is missing"));
  EXPECT_THAT(refusal(kSpinning, "title:", "colour: red\ntitle:"),
              HasSubstr("mine.yaml:2: colour is not a known key"));
  EXPECT_THAT(refusal(kSpinning, "title:", "name: other\ntitle:"),
              HasSubstr("name is given twice"));
  EXPECT_THAT(refusal(kSpinning, "kind: spinning", "kind: risley"),
              HasSubstr("shot_period_us is missing"));
  EXPECT_THAT(refusal(kRisley, "shot_period_us: 4", "shot_period_us: 4\nspin_hz: {least: 5}"),
              HasSubstr("mine.yaml:6: spin_hz is not a known key; known here are kind, name"));
  EXPECT_THAT(refusal(kRisley, "shot_period_us: 4",
                      "shot_period_us: 4\npackets: {product: 1, distance_mm: 2}"),
              HasSubstr("mine.yaml:6: packets is not a known key"));
  EXPECT_THAT(refusal(kSpinning, "sources: [\"my desk\"]", "sources: []"), HasSubstr("sources"));
  EXPECT_THAT(refusal(kSpinning, "sources: [\"my desk\"]", "sources: {a: b}"),
              HasSubstr("sources"));
}

TEST(SensorFile, RangesAreChecked) {
  const auto with_range = [](const std::string& range) {
    return refusal(kSpinning, "{least_m: 0.5, most_m: 50, step_m: 0.004}", range);
  };
  EXPECT_THAT(with_range("{least_m: -1, most_m: 50}"),
              HasSubstr("mine.yaml:4: range.least_m -1 is not in [0, 10000]"));
  EXPECT_THAT(with_range("{least_m: 5, most_m: 4}"), HasSubstr("range.most_m 4 is not in [5, "));
  EXPECT_THAT(with_range("{least_m: nan, most_m: 4}"), HasSubstr("range.least_m nan is not in"));
  EXPECT_THAT(with_range("{least_m: .nan, most_m: 4}"), HasSubstr("range.least_m"));
  EXPECT_THAT(with_range("{least_m: 1, most_m: inf}"), HasSubstr("range.most_m inf is not in"));
  EXPECT_THAT(with_range("{least_m: 1}"), HasSubstr("range.most_m is missing"));
  EXPECT_THAT(with_range("{least_m: 1, most_m: 4, step_m: -1}"), HasSubstr("range.step_m"));
  EXPECT_THAT(with_range("{least_m: 1, most_m: 4, step_m: 1e-300}"),
              HasSubstr("mine.yaml:4: range.step_m is to be 0, for none, or in [1e-06, 1]"));
  EXPECT_THAT(with_range("far"), HasSubstr("range is not a map"));
}

TEST(SensorFile, SpinAndFiringAreChecked) {
  const std::string spin = "{least: 5, most: 20, default: 10}";
  EXPECT_THAT(refusal(kSpinning, spin, "{least: 5, most: 20}"),
              HasSubstr("mine.yaml:5: spin_hz.default is missing"));
  EXPECT_THAT(refusal(kSpinning, spin, "{least: 5, most: 20, default: 25}"),
              HasSubstr("spin_hz.default 25 is not in [5, 20]"));
  EXPECT_THAT(refusal(kSpinning, spin, "{least: 0, most: 20, default: 10}"),
              HasSubstr("spin_hz.least 0 is not in"));
  EXPECT_THAT(refusal(kSpinning, spin, "{least: 9, most: 8, default: 8}"),
              HasSubstr("spin_hz.most 8 is not in [9, "));
  EXPECT_THAT(refusal(kSpinning, "firing_sequence_us: 100", "firing_sequence_us: 0"),
              HasSubstr("mine.yaml:6: firing_sequence_us 0 is not in"));
  EXPECT_THAT(refusal(kSpinning, "firing_sequence_us: 100\n", ""),
              HasSubstr("firing_sequence_us or columns_per_turn has to be given"));
  EXPECT_THAT(
      refusal(kSpinning, "firing_sequence_us: 100", "firing_sequence_us: 100\ncolumns_per_turn: 9"),
      HasSubstr("mine.yaml:6: firing_sequence_us or columns_per_turn has to be given"));
  const auto jitter = [](const std::string& sequence) {
    return refusal(kSpinning, "firing_sequence_us: 100", sequence);
  };
  EXPECT_THAT(jitter("firing_sequence_us: 100\nspin_jitter_deg: 1.5"),
              HasSubstr("spin_jitter_deg 1.5 is not in [0, 1]"));
  EXPECT_THAT(jitter("columns_per_turn: 9\nspin_jitter_deg: 0.1"),
              HasSubstr("spin_jitter_deg needs firing_sequence_us"));
  EXPECT_THAT(refusal(kSpinning, "firing_sequence_us: 100", "columns_per_turn: 2.5"),
              HasSubstr("columns_per_turn \"2.5\" is not a whole number"));
  EXPECT_THAT(refusal(kSpinning, "firing_sequence_us: 100", "columns_per_turn: 0"),
              HasSubstr("columns_per_turn 0 is not in"));
  // At 20 Hz a column of 5000 a turn takes 10 us; the second laser would fire after that.
  EXPECT_THAT(refusal(kSpinning, "firing_sequence_us: 100", "columns_per_turn: 5000"),
              HasSubstr("lasers.1.fires_us 20 is not in [0, 10]"));
}

TEST(SensorFile, LasersAreChecked) {
  const std::string second = "{fires_us: 20, elevation_deg: 5}";
  EXPECT_THAT(refusal(kSpinning, "  - {fires_us: 0, elevation_deg: -5}\n  - " + second, "  []"),
              HasSubstr("lasers is not a list of 1 to 128 entries"));
  std::string many = "lasers:\n";
  for (int i = 0; i < 129; ++i) many += "  - {fires_us: 0, elevation_deg: 1}\n";
  EXPECT_THAT(refusal(kSpinning, "lasers:\n", many),
              HasSubstr("mine.yaml:8: lasers is not a list of 1 to 128 entries"));
  EXPECT_THAT(refusal(kSpinning, "lasers:", "laser:"),
              HasSubstr("laser is not a known key, and lasers is missing"));
  EXPECT_THAT(refusal(kSpinning, "fires_us: 0", "fires_us: 30"),
              HasSubstr("mine.yaml:9: lasers.1.fires_us 20 is not in [30, 100]"));
  EXPECT_THAT(refusal(kSpinning, second, "{fires_us: 101, elevation_deg: 5}"),
              HasSubstr("lasers.1.fires_us 101 is not in [0, 100]"));
  EXPECT_THAT(refusal(kSpinning, second, "{fires_us: -1, elevation_deg: 5}"),
              HasSubstr("lasers.1.fires_us -1 is not in"));
  EXPECT_THAT(refusal(kSpinning, second, "{fires_us: 20}"),
              HasSubstr("mine.yaml:9: lasers.1.elevation_deg is missing"));
  EXPECT_THAT(refusal(kSpinning, second, "{fires_us: 20, elevation_deg: 91}"),
              HasSubstr("lasers.1.elevation_deg 91 is not in [-90, 90]"));
  EXPECT_THAT(refusal(kSpinning, second, "{fires_us: 20, elevation_deg: up}"),
              HasSubstr("elevation_deg \"up\" is not a number"));
  EXPECT_THAT(refusal(kSpinning, second, "{fires_us: 20, elevation_deg: 5, azimuth_deg: 400}"),
              HasSubstr("azimuth_deg 400 is not in"));
  EXPECT_THAT(refusal(kSpinning, second, "{fires_us: 20, elevation_deg: 5, radius_mm: nan}"),
              HasSubstr("radius_mm nan is not in"));
  EXPECT_THAT(refusal(kSpinning, second, "{fires_us: 20, elevation_deg: 5, colour: 3}"),
              HasSubstr("lasers.1.colour is not a known key"));
  EXPECT_THAT(refusal(kSpinning, second, "5"), HasSubstr("lasers.1 is not a map"));
}

TEST(SensorFile, PrismsAreChecked) {
  const std::string second = "  - {wedge_deg: 10, refractive_index: 1.5, rpm: -600}\n";
  EXPECT_THAT(refusal(kRisley, second, ""), HasSubstr("mine.yaml:7: prisms must be two"));
  EXPECT_THAT(refusal(kRisley, second, second + second),
              HasSubstr("prisms is not a list of 1 to 2 entries"));
  EXPECT_THAT(refusal(kRisley, "shot_period_us: 4", "shot_period_us: -4"),
              HasSubstr("mine.yaml:5: shot_period_us -4 is not in"));
  EXPECT_THAT(refusal(kRisley, "rpm: 6000", "rpm: fast"), HasSubstr("prisms.0.rpm \"fast\""));
  EXPECT_THAT(refusal(kRisley, "refractive_index: 1.5", "refractive_index: 0.5"),
              HasSubstr("prisms.0.refractive_index 0.5 is not in [1, 4]"));
  EXPECT_THAT(refusal(kRisley, "wedge_deg: 10", "wedge_deg: nan"),
              HasSubstr("prisms.0.wedge_deg nan is not in"));
  // Beyond the critical angle, asin(1 / 1.5) = 41.8 degrees.
  EXPECT_THAT(refusal(kRisley, "wedge_deg: 10", "wedge_deg: 42"),
              HasSubstr("mine.yaml:7: prisms are so steep that they reflect the beam back"));
}

}  // namespace
}  // namespace plotscan::sensor
