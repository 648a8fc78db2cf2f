// SPDX-License-Identifier: Apache-2.0
#include "lidar/simulate.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "simulated.h"
#include "small_farm.h"

namespace plotscan::lidar {
namespace {

using testing::WorldTriangle;
using Points = std::vector<scan::LabelledPoint>;

farm::Farm flat_farm(double half_side_m = 200) {
  return {.name = "flat",
          .seed = 1,
          .terrain = testing::flat_terrain(half_side_m, 0),
          .models = {},
          .plots = {},
          .plants = {}};
}

// Distance from a point to a triangle: to its plane where the foot is inside, else to its edges.
double distance(const Eigen::Vector3d& p, const std::array<Eigen::Vector3d, 3>& c) {
  const Eigen::Vector3d normal = (c[1] - c[0]).cross(c[2] - c[0]).normalized();
  bool inside = true;
  double nearest = 1e9;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d& a = c[i];
    const Eigen::Vector3d edge = c[(i + 1) % 3] - a;
    inside = inside && edge.cross(p - a).dot(normal) >= 0;
    const double share = std::clamp((p - a).dot(edge) / edge.squaredNorm(), 0.0, 1.0);
    nearest = std::min(nearest, (a + share * edge - p).norm());
  }
  return inside ? std::abs(normal.dot(p - c[0])) : nearest;
}

TEST(Simulate, EveryPointLiesOnWhatItsLabelsSay) {
  const farm::Farm farm = testing::small_farm();
  const sensor::Sensor sensor = testing::exact_vlp16();
  const scan::Trajectory flight(
      {{.time_s = 0, .position_m = {-4, 0.3, 4}}, {.time_s = 0.4, .position_m = {4, 0.3, 4}}});
  const sensor::ShotPlan plan(sensor, 20, testing::spin_along_flight(), flight);
  const Points points = testing::simulated(farm, sensor, plan, {.range_noise_m = 0});
  const auto triangles = testing::world_triangles(farm);
  std::set<std::uint32_t> plants;
  for (const scan::LabelledPoint& point : points) {
    double nearest = 1e9;
    for (const WorldTriangle& triangle : triangles) {
      if (triangle.plant != point.plant) continue;
      nearest = std::min(nearest, distance(testing::position(point), triangle.corners));
      ASSERT_EQ(triangle.plot, point.plot);
    }
    ASSERT_LT(nearest, 2e-5);
    ASSERT_EQ(point.label, point.plant == 0 ? scan::PointClass::ground : scan::PointClass::crop);
    plants.insert(point.plant);
  }
  EXPECT_EQ(plants.size(), farm.plants.size() + 1);
  EXPECT_GT(points.size(), 20000u);
}

TEST(Simulate, PointsComeInTheOrderOfFiring) {
  const sensor::Sensor sensor = sensor::load_sensor("vlp16");
  const sensor::ShotPlan plan(sensor, 10, testing::spin_along_flight(),
                              testing::hover({0, 0, 8}, 0.3));
  const Points points = testing::simulated(flat_farm(), sensor, plan, {.threads = 3});
  ASSERT_GT(points.size(), 1000u);
  for (std::size_t i = 1; i < points.size(); ++i) ASSERT_LT(points[i - 1].time, points[i].time);
}

// Straight down the intensity is the reflectance; elsewhere it falls with the cosine.
TEST(Simulate, IntensityFollowsLambert) {
  EXPECT_EQ(return_intensity(0.3f, 1), 30);
  EXPECT_EQ(return_intensity(0.45f, 0.8f), 36);
  const sensor::Sensor sensor = testing::exact_vlp16();
  const sensor::ShotPlan plan(sensor, 10, testing::spin_along_flight(),
                              testing::hover({0, 0, 8}, 0.1));
  for (const auto& point : testing::simulated(flat_farm(), sensor, plan, {.range_noise_m = 0})) {
    const Eigen::Vector3d ray =
        testing::position(point) - testing::world_shot(plan, testing::shot_of(point)).origin;
    ASSERT_NEAR(point.intensity, 30 * -ray.normalized().z(), 0.501);
  }
}

// Signed range errors of the returns of a hover by their shots, against the closed form.
std::map<std::uint64_t, double> errors_by_shot(const farm::Farm& farm, const sensor::Sensor& sensor,
                                               const SimulateOptions& options) {
  const sensor::ShotPlan plan(sensor, 10, testing::spin_along_flight(),
                              testing::hover({0, 0, 8}, 0.3));
  std::map<std::uint64_t, double> errors;
  for (const auto& point : testing::simulated(farm, sensor, plan, options)) {
    const std::uint64_t number = testing::shot_of(point);
    const testing::WorldShot shot = testing::world_shot(plan, number);
    const double truth = -shot.origin.z() / shot.direction.z();
    // Beyond 30 m, more of the error is of the file's single precision and the range's limits.
    if (truth < 30) errors[number] = (testing::position(point) - shot.origin).norm() - truth;
  }
  return errors;
}

std::vector<double> range_errors(const sensor::Sensor& sensor, const SimulateOptions& options) {
  std::vector<double> errors;
  for (const auto& [shot, error] : errors_by_shot(flat_farm(), sensor, options))
    errors.push_back(error);
  return errors;
}

TEST(Simulate, NoiseIsGaussianWithItsStandardDeviation) {
  constexpr double kSigma_m = 0.03;
  const std::vector<double> errors =
      range_errors(testing::exact_vlp16(), {.range_noise_m = kSigma_m, .seed = 5});
  const auto n = static_cast<double>(errors.size());
  ASSERT_GT(n, 20000);
  double sum = 0;
  double squares = 0;
  double fourths = 0;
  for (const double e : errors) {
    sum += e;
    squares += e * e;
    fourths += e * e * e * e;
  }
  EXPECT_NEAR(sum / n, 0, 4 * kSigma_m / std::sqrt(n));
  EXPECT_NEAR(std::sqrt(squares / n), kSigma_m, 4 * kSigma_m / std::sqrt(2 * n));
  EXPECT_NEAR(fourths * n / (squares * squares), 3, 4 * std::sqrt(24 / n));  // kurtosis
}

TEST(Simulate, RangesAreMultiplesOfTheStep) {
  const sensor::Sensor sensor = sensor::load_sensor("vlp16");
  const sensor::ShotPlan plan(sensor, 10, testing::spin_along_flight(),
                              testing::hover({0, 0, 8}, 0.1));
  const Points points = testing::simulated(flat_farm(), sensor, plan, {.seed = 2});
  ASSERT_GT(points.size(), 10'000u);
  for (const auto& point : points) {
    const testing::WorldShot shot = testing::world_shot(plan, testing::shot_of(point));
    const double steps = (testing::position(point) - shot.origin).norm() / 0.002;
    ASSERT_NEAR(steps, std::round(steps), 0.01);
  }
  for (const double error : range_errors(sensor, {.range_noise_m = 0}))
    ASSERT_LE(std::abs(error), 0.001 + 1e-5);
}

TEST(Simulate, RangesBeyondTheLimitsLeaveNoPoint) {
  sensor::Sensor sensor = sensor::load_sensor("vlp16");
  sensor.min_range_m = 9;
  sensor.max_range_m = 12;
  const sensor::ShotPlan plan(sensor, 10, testing::spin_along_flight(),
                              testing::hover({0, 0, 8}, 0.1));
  int expected = 0;
  for (std::uint64_t shot = 0; shot < 16 * plan.sequences(); ++shot) {
    const testing::WorldShot ray = testing::world_shot(plan, shot);
    const double range = 0.002 * std::round(-ray.origin.z() / ray.direction.z() / 0.002);
    expected += range >= 9 && range <= 12 ? 1 : 0;
  }
  const Points points = testing::simulated(flat_farm(), sensor, plan, {.range_noise_m = 0});
  EXPECT_NEAR(static_cast<double>(points.size()), expected, 3);  // single precision at the limits
  EXPECT_GT(expected, 1000);
}

// A range of 0 is no return, as in the sensors' packets, whatever the sensor's least range.
TEST(Simulate, NoiseBehindTheSensorLeavesNoPoint) {
  sensor::Sensor sensor = sensor::load_sensor("vlp16");
  sensor.min_range_m = 0;
  const sensor::ShotPlan plan(sensor, 10, testing::spin_along_flight(),
                              testing::hover({0, 0, 2}, 0.1));
  const Points points = testing::simulated(flat_farm(), sensor, plan, {.range_noise_m = 1});
  ASSERT_GT(points.size(), 10'000u);
  for (const auto& point : points) {
    const testing::WorldShot shot = testing::world_shot(plan, testing::shot_of(point));
    ASSERT_GT((testing::position(point) - shot.origin).norm(), 1e-3);
  }
}

// A shot's noise is the same whatever else is seen.
// A drone, a head and lasers four times as slow fire the same shots: the same points, later.
TEST(Simulate, ASlowerTimeLeavesThePointsWhereTheyAre) {
  const farm::Farm farm = testing::small_farm();
  const auto points_at = [&](double slower) {
    sensor::Sensor sensor = testing::exact_vlp16();
    sensor.sequence_s *= slower;
    for (sensor::Laser& laser : sensor.lasers) laser.fires_s *= slower;
    const scan::Trajectory flight({{.time_s = 0, .position_m = {-4, 0.3, 4}},
                                   {.time_s = 0.2 * slower, .position_m = {4, 0.3, 4}}});
    const sensor::ShotPlan plan(sensor, 20 / slower, testing::spin_along_flight(), flight);
    return testing::simulated(farm, sensor, plan, {.range_noise_m = 0.02});
  };
  const Points points = points_at(1);
  const Points later = points_at(4);
  ASSERT_GT(points.size(), 10000u);
  ASSERT_EQ(later.size(), points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    ASSERT_LT((testing::position(later[i]) - testing::position(points[i])).norm(), 1e-5);
    ASSERT_NEAR(later[i].time, 4 * points[i].time, 1e-9);
    ASSERT_EQ(later[i].plant, points[i].plant);
  }
}

TEST(Simulate, NoiseBelongsToTheShotAndTheSeed) {
  const sensor::Sensor sensor = testing::exact_vlp16();
  const auto wide = errors_by_shot(flat_farm(), sensor, {.seed = 3});
  const auto narrow = errors_by_shot(flat_farm(2.5), sensor, {.seed = 3, .threads = 4});
  ASSERT_GT(narrow.size(), 1000u);
  ASSERT_LT(narrow.size(), wide.size() / 2);
  for (const auto& [shot, error] : narrow) ASSERT_NEAR(error, wide.at(shot), 1e-5);
  EXPECT_NE(range_errors(sensor, {.seed = 3}), range_errors(sensor, {.seed = 4}));
}

}  // namespace
}  // namespace plotscan::lidar
