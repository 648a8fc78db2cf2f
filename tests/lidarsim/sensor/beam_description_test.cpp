// SPDX-License-Identifier: Apache-2.0
// The `beam:` section of a sensor's file.
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "sensor/sensor.h"

namespace plotscan::sensor {
namespace {

using ::testing::HasSubstr;

std::string with_beam(const std::string& beam) {
  return "name: mine\ntitle: Mine\nkind: spinning\nrange: {least_m: 1, most_m: 50}\n"
         "spin_hz: {least: 5, most: 20, default: 10}\nfiring_sequence_us: 50\n" +
         beam + "lasers: [{fires_us: 0, elevation_deg: 0}]\n";
}

std::string beam_refusal(const std::string& beam) {
  try {
    parse_sensor(with_beam(beam), "mine.yaml");
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(BeamDescription, IsReadInSiUnits) {
  const Sensor sensor = parse_sensor(with_beam("beam:\n"
                                               "  divergence_mrad: [3, 1.5]\n"
                                               "  pulse_ns: 6\n"
                                               "  faintest: {reflectance: 0.1, range_m: 50}\n"
                                               "  least_separation_m: 1\n"),
                                     "mine.yaml");
  ASSERT_TRUE(sensor.beam.has_value());
  EXPECT_DOUBLE_EQ(sensor.beam->along_rad, 3e-3);
  EXPECT_DOUBLE_EQ(sensor.beam->across_rad, 1.5e-3);
  EXPECT_DOUBLE_EQ(sensor.beam->pulse_s, 6e-9);
  EXPECT_DOUBLE_EQ(sensor.beam->faintest_reflectance, 0.1);
  EXPECT_DOUBLE_EQ(sensor.beam->faintest_range_m, 50);
  EXPECT_DOUBLE_EQ(sensor.beam->least_separation_m, 1);
}

TEST(BeamDescription, MayBeLeftOut) {
  EXPECT_FALSE(parse_sensor(with_beam(""), "mine.yaml").beam.has_value());
}

TEST(BeamDescription, EveryShippedSensorHasOne) {
  for (const std::string& name : sensor_names())
    EXPECT_TRUE(load_sensor(name).beam.has_value()) << name;
}

TEST(BeamDescription, WhatCannotBeIsRefused) {
  const auto beam = [](const std::string& divergence, const std::string& rest) {
    return "beam: {divergence_mrad: " + divergence + ", " + rest + "}\n";
  };
  const std::string faintest = "faintest: {reflectance: 0.1, range_m: 50}";
  EXPECT_THAT(beam_refusal(beam("[3, -1]", "pulse_ns: 6, " + faintest)),
              HasSubstr("mine.yaml:7: beam.divergence_mrad"));
  EXPECT_THAT(beam_refusal(beam("3", "pulse_ns: 6, " + faintest)),
              HasSubstr("beam.divergence_mrad"));
  EXPECT_THAT(beam_refusal(beam("[3, 1]", "pulse_ns: 0, " + faintest)), HasSubstr("beam.pulse_ns"));
  EXPECT_THAT(beam_refusal(beam("[3, 1]", "pulse_ns: .nan, " + faintest)),
              HasSubstr("beam.pulse_ns"));
  EXPECT_THAT(beam_refusal(beam("[3, 1]", "pulse_ns: 6")), HasSubstr("faintest"));
  EXPECT_THAT(beam_refusal(beam("[3, 1]", "pulse_ns: 6, faintest: {reflectance: 2, range_m: 50}")),
              HasSubstr("beam.faintest.reflectance"));
  EXPECT_THAT(beam_refusal(beam("[3, 1]", "pulse_ns: 6, faintest: {reflectance: 0.1, range_m: 0}")),
              HasSubstr("beam.faintest.range_m"));
  EXPECT_THAT(beam_refusal(beam("[3, 1]", "width: 2, pulse_ns: 6, " + faintest)),
              HasSubstr("width"));
}

}  // namespace
}  // namespace plotscan::sensor
