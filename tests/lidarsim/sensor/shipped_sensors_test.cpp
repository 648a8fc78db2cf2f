// SPDX-License-Identifier: Apache-2.0
// Every shipped sensor's shots against its maker's (or its driver's) formulae and numbers, typed
// here anew. The VLP-16 is in shots_test.cpp, the Mid-40 in risley_test.cpp.
#include <cmath>
#include <functional>

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/angle.h"
#include "sensor/shots.h"
#include "sensor/summary.h"

namespace plotscan::sensor {
namespace {

using ::testing::ElementsAre;

struct PlainShot {
  double time_s = 0;
  Eigen::Vector3d origin;
  Eigen::Vector3d direction;
};

// Holds a hovering sensor's first shots against a formula of (sequence, place in the sequence).
void expect_shots(const std::string& name, double spin_hz, std::size_t lasers,
                  double direction_tolerance,
                  const std::function<PlainShot(std::uint64_t, std::size_t)>& plain) {
  const scan::Trajectory hovering({{.time_s = 0}, {.time_s = 1}});
  const ShotPlan plan(load_sensor(name), spin_hz, Eigen::Isometry3d::Identity(), hovering);
  ASSERT_EQ(plan.lasers(), lasers);
  SequenceShots fired;
  for (std::uint64_t sequence = 0; sequence < 3000; ++sequence) {
    plan.fire(sequence, fired);
    for (std::size_t k = 0; k < lasers; ++k) {
      const PlainShot expected = plain(sequence, k);
      const auto i = static_cast<Eigen::Index>(k);
      ASSERT_NEAR(plan.time_s(sequence, k), expected.time_s, 1e-11);
      for (int axis = 0; axis < 3; ++axis) {
        ASSERT_NEAR(fired.direction[axis][i], expected.direction[axis], direction_tolerance)
            << name << " sequence " << sequence << " laser " << k;
        ASSERT_NEAR(fired.origin_m[axis][i], expected.origin[axis], 1e-9);
      }
    }
  }
}

// velodyne_pointcloud, rawdata.cc: the azimuth is lessened by rot_correction; x forward, y left.
Eigen::Vector3d velodyne_direction(double azimuth, double rot_correction, double vert_correction) {
  return {std::cos(vert_correction) * std::cos(azimuth - rot_correction),
          -std::cos(vert_correction) * std::sin(azimuth - rot_correction),
          std::sin(vert_correction)};
}

double head_azimuth(double spin_hz, double time_s) {
  return 2 * kPi * std::fmod(spin_hz * time_s, 1.0);
}

// Manual 63-9243, table 9-1: steps of 4/3 degrees, the lower and the upper half in turns.
TEST(ShippedSensors, PuckHiRes) {
  constexpr double kVertical_mm[16] = {7.4, -0.9, 6.5, -1.8, 5.5, -2.7, 4.6, -3.7,
                                       3.7, -4.6, 2.7, -5.5, 1.8, -6.5, 0.9, -7.4};
  expect_shots("puck_hires", 10, 16, 1e-5, [&](std::uint64_t n, std::size_t k) {
    const auto step = static_cast<double>(k / 2);
    const double elevation_deg = (k % 2 == 0 ? -10 : 2.0 / 3) + 4.0 / 3 * step;
    const double time_s = 55.296e-6 * static_cast<double>(n) + 2.304e-6 * static_cast<double>(k);
    return PlainShot{
        .time_s = time_s,
        .origin = {0, 0, 1e-3 * kVertical_mm[k]},
        .direction = velodyne_direction(head_azimuth(10, time_s), 0, elevation_deg * kDegrees)};
  });
}

// Manual 63-9113, page 10, and VeloView's timing. The manual rounds 4/3 degrees to hundredths.
TEST(ShippedSensors, Hdl32e) {
  expect_shots("hdl32e", 20, 32, 2e-4, [](std::uint64_t n, std::size_t k) {
    const auto step = static_cast<double>(k / 2);
    const double elevation_deg = (k % 2 == 0 ? -92.0 / 3 : -28.0 / 3) + 4.0 / 3 * step;
    const double time_s = 46.08e-6 * static_cast<double>(n) + 1.152e-6 * static_cast<double>(k);
    return PlainShot{
        .time_s = time_s,
        .origin = {0, 0, 0},
        .direction = velodyne_direction(head_azimuth(20, time_s), 0, elevation_deg * kDegrees)};
  });
}

// velodyne_pointcloud, params/VeloView-VLP-32C.yaml: vert_correction and rot_correction, radians.
TEST(ShippedSensors, Vlp32c) {
  constexpr double kVertical[32] = {
      -0.43633231, -0.01745329, -0.02909464, -0.27295204, -0.19739674, 0.0,         -0.01164135,
      -0.15433947, -0.12660618, 0.00581195,  -0.00581195, -0.10730284, -0.09307841, 0.02326524,
      0.01164135,  -0.06981317, -0.08145452, 0.02909464,  0.01745329,  -0.06400122, -0.05817182,
      0.05817182,  0.04071853,  -0.04654793, -0.05235988, 0.12217305,  0.08145452,  -0.04071853,
      -0.03490659, 0.26179939,  0.18034487,  -0.02326524};
  constexpr double kRotation[32] = {
      -0.02443461, 0.07330383,  -0.02443461, 0.02443461,  -0.02443461, 0.02443461,  -0.07330383,
      0.02443461,  -0.02443461, 0.07330383,  -0.02443461, 0.02443461,  -0.07330383, 0.02443461,
      -0.07330383, 0.02443461,  -0.02443461, 0.07330383,  -0.02443461, 0.07330383,  -0.07330383,
      0.02443461,  -0.02443461, 0.02443461,  -0.02443461, 0.02443461,  -0.02443461, 0.07330383,
      -0.07330383, 0.02443461,  -0.02443461, 0.02443461};
  expect_shots("vlp32c", 10, 32, 2e-5, [&](std::uint64_t n, std::size_t k) {
    const double time_s =
        55.296e-6 * static_cast<double>(n) + 2.304e-6 * static_cast<double>(k / 2);
    return PlainShot{
        .time_s = time_s,
        .origin = {0, 0, 0},
        .direction = velodyne_direction(head_azimuth(10, time_s), kRotation[k], kVertical[k])};
  });
}

// Ouster's guide, "Lidar range to XYZ": the encoder counts down from a full turn; n is the beam's
// origin. A point at range r is at x = (r - n) cos(encoder + azimuth) cos(altitude) + n
// cos(encoder) and so on, so the ray starts at r = n.
TEST(ShippedSensors, Os1) {
  constexpr double kOrigin_m = 12.163e-3;
  constexpr double kAzimuth_deg[4] = {3.164, 1.055, -1.055, -3.164};
  for (const double spin_hz : {10.0, 20.0}) {
    expect_shots("os1_64", spin_hz, 64, 2e-5, [&](std::uint64_t m, std::size_t i) {
      const double encoder = 2 * kPi * (1 - static_cast<double>(m % 1024) / 1024);
      const double azimuth = -2 * kPi * kAzimuth_deg[i % 4] / 360;
      const double altitude = (16.611 - 33.222 / 63 * static_cast<double>(i)) * kDegrees;
      return PlainShot{
          .time_s = static_cast<double>(m) / (1024 * spin_hz),
          .origin = {kOrigin_m * std::cos(encoder), kOrigin_m * std::sin(encoder), 0},
          .direction = {std::cos(encoder + azimuth) * std::cos(altitude),
                        std::sin(encoder + azimuth) * std::cos(altitude), std::sin(altitude)}};
    });
  }
}

TEST(ShippedSensors, PublishedFigures) {
  struct Published {
    const char* name;
    int channels;
    double shots_per_s;
    double least_elevation_deg;
    double most_elevation_deg;
    double max_range_m;
  };
  const Published published[] = {
      {"vlp16", 16, 289'352, -15, 15, 100},          {"puck_hires", 16, 289'352, -10, 10, 100},
      {"vlp32c", 32, 578'704, -25, 15, 200},         {"hdl32e", 32, 694'444, -30.67, 10.67, 100},
      {"os1_64", 64, 655'360, -16.611, 16.611, 120}, {"livox_mid40", 1, 100'000, 0, 0, 260}};
  ASSERT_EQ(sensor_names().size(), std::size(published));
  for (const Published& expected : published) {
    const nlohmann::json summary = summary_json(load_sensor(expected.name));
    EXPECT_EQ(summary["name"], expected.name);
    EXPECT_EQ(summary["channels"], expected.channels) << expected.name;
    EXPECT_NEAR(summary["shots_per_second"], expected.shots_per_s, 1) << expected.name;
    EXPECT_EQ(summary["range_m"][1], expected.max_range_m) << expected.name;
    if (expected.channels == 1) continue;
    EXPECT_NEAR(summary["elevation_deg"][0], expected.least_elevation_deg, 1e-9) << expected.name;
    EXPECT_NEAR(summary["elevation_deg"][1], expected.most_elevation_deg, 1e-9) << expected.name;
  }
  EXPECT_NEAR(summary_json(load_sensor("livox_mid40"))["cone_deg"], 38.4, 0.05);
}

// Ring 0 is the lowest laser, also of Ouster's sensors, whose own numbers begin at the top.
TEST(ShippedSensors, RingsCountFromTheLowest) {
  for (const std::string& name : sensor_names()) {
    const Sensor sensor = load_sensor(name);
    if (sensor.wedges) continue;
    std::vector<std::uint16_t> rings;
    for (const Laser& laser : sensor.lasers) {
      rings.push_back(laser.ring);
      for (const Laser& other : sensor.lasers)
        ASSERT_EQ(laser.ring < other.ring, laser.elevation_rad < other.elevation_rad) << name;
    }
    std::ranges::sort(rings);
    for (std::size_t i = 0; i < rings.size(); ++i) ASSERT_EQ(rings[i], i) << name;
  }
  EXPECT_EQ(load_sensor("os1_64").lasers.front().ring, 63);
}

TEST(ShippedSensors, AreListed) {
  EXPECT_THAT(sensor_names(),
              ElementsAre("vlp16", "puck_hires", "vlp32c", "hdl32e", "os1_64", "livox_mid40"));
  std::vector<Sensor> sensors;
  for (const std::string& name : sensor_names()) sensors.push_back(load_sensor(name));
  const auto lines = summary_lines(sensors);
  ASSERT_EQ(lines.size(), 7u);
  EXPECT_THAT(lines[1],
              ::testing::AllOf(::testing::HasSubstr("vlp16"), ::testing::HasSubstr("289352"),
                               ::testing::HasSubstr("10 (5..20) Hz")));
  EXPECT_THAT(lines[6], ::testing::AllOf(::testing::HasSubstr("cone of 38.4 deg"),
                                         ::testing::HasSubstr("none")));
  const nlohmann::json risley = summary_json(sensors.back());
  EXPECT_EQ(risley["kind"], "risley");
  EXPECT_FALSE(risley.contains("spin_hz"));
  EXPECT_EQ(summary_json(sensors.front())["spin_hz"]["default"], 10);
}

}  // namespace
}  // namespace plotscan::sensor
