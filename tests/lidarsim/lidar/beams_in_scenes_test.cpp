// SPDX-License-Identifier: Apache-2.0
// Beams with a footprint, from the trajectory to the points, against closed forms.
#include <cmath>
#include <map>

#include "simulated.h"
#include "small_farm.h"
#include "temporary_folder.h"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "lidar/beam.h"
#include "lidar/fly.h"

namespace plotscan::lidar {
namespace {

using ::testing::HasSubstr;
using testing::message_of;
using Points = std::vector<scan::LabelledPoint>;

constexpr double kHeight_m = 8;
constexpr float kSoil = 0.3f;
constexpr float kPlate = 0.5f;
constexpr float kPlateReach_m = 12;

// One laser, across the spin axis, that spins about the flight's direction, here east.
sensor::Sensor one_laser() {
  sensor::Sensor sensor = testing::exact_vlp16();
  sensor.lasers = {{.elevation_rad = 0, .offset_m = 0, .fires_s = 0, .ring = 0}};
  return sensor;
}

mesh::Mesh rectangle(float x0, float x1, float half_y, float z) {
  return {.vertices = {{x0, -half_y, z}, {x1, -half_y, z}, {x1, half_y, z}, {x0, half_y, z}},
          .triangles = {{0, 1, 2}, {0, 2, 3}}};
}

// Ground at z 0 and a plate over what lies west of x = edge_m. The plate is no larger than the
// tests need: the ray tracer's single precision shifts an edge by about 1e-7 of its triangle's
// size.
SceneContent plate_over_ground(double plate_z_m, double edge_m) {
  return {
      .meshes = {rectangle(-300, 300, 300, 0),
                 rectangle(-kPlateReach_m, static_cast<float>(edge_m), kPlateReach_m,
                           static_cast<float>(plate_z_m))},
      .placed = {
          {.mesh = 0, .surface = {.label = scan::PointClass::ground, .reflectance = kSoil}},
          {.mesh = 1,
           .surface = {
               .label = scan::PointClass::crop, .plot = 3, .plant = 7, .reflectance = kPlate}}}};
}

SceneContent ground() {
  return {.meshes = {rectangle(-300, 300, 300, 0)},
          .placed = {
              {.mesh = 0, .surface = {.label = scan::PointClass::ground, .reflectance = kSoil}}}};
}

// A hover over x 0.
struct Hover {
  explicit Hover(const sensor::Sensor& from)
      : sensor(from),
        plan(sensor, 10, testing::spin_along_flight(), testing::hover({0, 0, kHeight_m}, 0.2)) {}

  Points scan(const SceneContent& content, const SimulateOptions& options) const {
    Points points;
    const Scene scene(content);
    simulate(scene, sensor, {.fired = plan, .placed = plan}, options,
             [&](std::span<const scan::LabelledPoint> piece) {
               points.insert(points.end(), piece.begin(), piece.end());
             });
    return points;
  }
  // The range to the plane at height z of the shot that made the point, and its cosine to it.
  std::uint64_t shot(const scan::LabelledPoint& point) const {
    return static_cast<std::uint64_t>(std::lround(point.time / sensor.sequence_s));
  }
  double down(const scan::LabelledPoint& point) const { return down_of(shot(point)); }
  double down_of(std::uint64_t shot) const {
    sensor::SequenceShots shots;
    plan.fire(shot, shots);
    return -shots.direction[2][0];
  }

  sensor::Sensor sensor;
  sensor::ShotPlan plan;
};

double range_of(const scan::LabelledPoint& point) {
  return (testing::position(point) - Eigen::Vector3d(0, 0, kHeight_m)).norm();
}

// How far the sub-rays on one side of an edge through the axis are off it along the edge, at most
// over all turns of the pattern, in standard deviations of the beam.
double off_centre(int sub_rays) {
  double most = 0;
  for (int step = 0; step < 3600; ++step) {
    const Eigen::Rotation2Dd turn(std::numbers::pi * step / 3600);
    double sum = 0;
    for (const Eigen::Vector2d& point : normal_pattern(sub_rays)) {
      const Eigen::Vector2d turned = turn * point;
      if (turned.x() < 0) sum += turned.y();
    }
    most = std::max(most, std::abs(sum) / (0.5 * sub_rays));
  }
  return most;
}

// How far a half of the beam moves a range on a level surface: to first order by its offset times
// the surface's slope to the beam, and by the second order that a whole beam has too.
double half_beam_bound(double off, const Hover& hover, double range_m, double down) {
  const double slope = std::sqrt(1 - down * down) / down;
  return off * hover.sensor.beam->along_rad / 4 * range_m * slope + 1e-4 / std::pow(down, 4);
}

// How far the share of the sub-rays on one side of a straight edge is from the Gaussian's, at most
// over all edges and turns.
double worst_split(int sub_rays) {
  double most = 0;
  for (int step = 0; step < 720; ++step) {
    const Eigen::Rotation2Dd turn(std::numbers::pi * step / 720);
    std::vector<double> beside;
    for (const Eigen::Vector2d& point : normal_pattern(sub_rays))
      beside.push_back((turn * point).x());
    std::ranges::sort(beside);
    for (int i = 0; i < sub_rays; ++i) {
      const double share =
          0.5 * std::erfc(-beside[static_cast<std::size_t>(i)] / std::numbers::sqrt2);
      most = std::max({most, std::abs(share - static_cast<double>(i) / sub_rays),
                       std::abs(share - static_cast<double>(i + 1) / sub_rays)});
    }
  }
  return most;
}

// The share of the beam that meets the plate is Phi(edge / (sigma R)), R the plate's range.
void expect_split(double edge_m) {
  constexpr double kPlateZ_m = 4;
  constexpr int kSubRays = 100;
  const Hover hover(one_laser());
  const double sigma_rad = hover.sensor.beam->across_rad / 4;
  const Points points = hover.scan(
      plate_over_ground(kPlateZ_m, edge_m),
      {.range_noise_m = 0, .threads = 2, .sub_rays = kSubRays, .returns = ReturnMode::dual});
  const double worst = worst_split(kSubRays);
  double error_sum = 0;
  double shots = 0;
  for (const scan::LabelledPoint& point : points) {
    const double down = hover.down(point);
    if (point.plant != 7 || down < 0.5) continue;
    const double range_m = (kHeight_m - kPlateZ_m) / down;
    const double share = 0.5 * std::erfc(-edge_m / (sigma_rad * range_m) / std::numbers::sqrt2);
    const double seen = point.intensity / (100 * kPlate * down);
    ASSERT_NEAR(seen, share, worst + 0.6 / (100 * kPlate * down));
    error_sum += seen - share;
    ++shots;
  }
  ASSERT_GT(shots, 500);
  EXPECT_NEAR(error_sum / shots, 0, 0.002) << "edge at " << edge_m;
}

TEST(BeamsInScenes, HalfCoveredBeamSplitsItsEnergy) { expect_split(0); }

TEST(BeamsInScenes, AnEdgeAsideSplitsByTheErrorFunction) {
  for (const double edge_m : {-0.002, -0.0007, 0.001, 0.003}) expect_split(edge_m);
}

TEST(BeamsInScenes, DualReturnsThroughAGapOfKnownDepth) {
  constexpr double kPlateZ_m = 3;
  const Hover hover(one_laser());
  const auto content = plate_over_ground(kPlateZ_m, 0);
  const auto scan = [&](ReturnMode mode) {
    return hover.scan(content, {.range_noise_m = 0, .sub_rays = 16, .returns = mode});
  };
  const Points dual = scan(ReturnMode::dual);
  const double off = off_centre(16);
  int pairs = 0;
  for (std::size_t i = 0; i + 1 < dual.size(); ++i) {
    const double down = hover.down(dual[i]);
    if (dual[i].return_count != 2 || dual[i].return_number != 1 || down < 0.4) continue;
    ASSERT_EQ(dual[i + 1].return_number, 2);
    ASSERT_EQ(dual[i + 1].return_count, 2);
    ASSERT_EQ(dual[i + 1].time, dual[i].time);
    const double near_bound_m = half_beam_bound(off, hover, (kHeight_m - kPlateZ_m) / down, down);
    const double far_bound_m = half_beam_bound(off, hover, kHeight_m / down, down);
    ASSERT_NEAR(range_of(dual[i + 1]) - range_of(dual[i]), kPlateZ_m / down,
                near_bound_m + far_bound_m);
    ASSERT_NEAR(dual[i].z, kPlateZ_m, near_bound_m * down);
    ASSERT_NEAR(dual[i + 1].z, 0, far_bound_m * down);
    ASSERT_EQ(dual[i].plant, 7u);
    ASSERT_EQ(dual[i + 1].label, scan::PointClass::ground);
    ++pairs;
  }
  EXPECT_GT(pairs, 900);
  // The plate is nearer and brighter.
  for (const auto& point : scan(ReturnMode::strongest)) {
    if (hover.down(point) < 0.4) continue;
    ASSERT_EQ(point.plant, 7u);
    ASSERT_EQ(point.return_count, 1);
  }
  for (const auto& point : scan(ReturnMode::last)) {
    if (hover.down(point) < 0.4) continue;
    ASSERT_EQ(point.label, scan::PointClass::ground);
    ASSERT_EQ(point.return_number, 1);
  }
}

// Whether a sub-ray of the shot passes the plate's edge, at x = 0, within what single precision
// tells apart there.
bool grazes_edge(const Hover& hover, int sub_rays, std::uint64_t shot, double plate_z_m) {
  constexpr double kEdgeError_m = 5e-6;
  sensor::SequenceShots shots;
  hover.plan.fire(shot, shots);
  std::vector<Ray> rays;
  SubRays(*hover.sensor.beam, sub_rays)
      .append(ray_of(shots, 0), hover.plan.spin_axis(shot).cast<float>(), shot, rays);
  return std::ranges::any_of(rays, [&](const Ray& ray) {
    const double x_m = (kHeight_m - plate_z_m) * ray.direction.x() / -ray.direction.z();
    return std::abs(x_m) < kEdgeError_m;
  });
}

// The maximum of two pulses that merge: a mean of their ranges weighted by what of each is received
// there. Of 0.1 m it is 0.2 mm from the mean weighted by power.
double merged_peak(double near_m, double near, double far_m, double far) {
  constexpr double kPulse_m = 0.38191;  // standard deviation of 6 ns
  double peak_m = (near * near_m + far * far_m) / (near + far);
  for (int i = 0; i < 100; ++i) {
    const double a = near * std::exp(-0.5 * std::pow((near_m - peak_m) / kPulse_m, 2));
    const double b = far * std::exp(-0.5 * std::pow((far_m - peak_m) / kPulse_m, 2));
    peak_m = (a * near_m + b * far_m) / (a + b);
  }
  return peak_m;
}

// A gap shallower than the pulse gives one point between.
TEST(BeamsInScenes, AShallowEdgeGivesAMixedPixel) {
  constexpr double kPlateZ_m = 0.1;
  const Hover hover(one_laser());
  const double off = off_centre(16);
  int mixed = 0;
  int grazing = 0;
  for (const auto& point :
       hover.scan(plate_over_ground(kPlateZ_m, 0),
                  {.range_noise_m = 0, .sub_rays = 16, .returns = ReturnMode::dual})) {
    const double down = hover.down(point);
    if (down < 0.7) continue;
    if (grazes_edge(hover, 16, hover.shot(point), kPlateZ_m)) {
      ++grazing;
      continue;
    }
    const double near_m = (kHeight_m - kPlateZ_m) / down;
    const double far_m = kHeight_m / down;
    const double near = kPlate / (near_m * near_m);
    const double far = kSoil / (far_m * far_m);
    ASSERT_NEAR(range_of(point), merged_peak(near_m, near, far_m, far),
                half_beam_bound(off, hover, far_m, down));
    ASSERT_EQ(point.return_count, 1);
    ASSERT_EQ(point.plant, 7u);
    ASSERT_NEAR(point.intensity, 50 * (kPlate + kSoil) * down, 1.1);
    ++mixed;
  }
  EXPECT_GT(mixed, 500);
  EXPECT_LT(grazing, mixed / 20);
}

TEST(BeamsInScenes, IntensityFollowsLambertForAnyNumberOfSubRays) {
  const Hover hover(one_laser());
  for (const int sub_rays : {1, 2, 7, 64}) {
    for (const auto& point : hover.scan(ground(), {.range_noise_m = 0, .sub_rays = sub_rays})) {
      const double down = hover.down(point);
      if (down > 0.35) {
        ASSERT_NEAR(point.intensity, 100 * kSoil * down, 0.501) << sub_rays;
        ASSERT_NEAR(range_of(point), kHeight_m / down, 1e-4 / std::pow(down, 4)) << sub_rays;
      }
    }
  }
}

// Soil seen ever flatter: its echo weakens with its cosine and its range, and its pulse is
// stretched by the footprint's depth.
TEST(BeamsInScenes, SoilVanishesWhereTheThresholdSays) {
  const Hover hover(one_laser());
  const sensor::Beam& beam = *hover.sensor.beam;
  const double threshold = beam.faintest_reflectance / std::pow(beam.faintest_range_m, 2);
  const double pulse_m = 0.5 * 299'792'458.0 * beam.pulse_s / (2 * std::sqrt(2 * std::log(2)));
  const auto peak = [&](double range_m) {
    const double down = kHeight_m / range_m;
    const double depth_m =
        beam.along_rad / 4 * range_m * std::sqrt(1 - down * down) / down;  // standard deviation
    return kSoil * down / (range_m * range_m) * pulse_m / std::hypot(pulse_m, depth_m);
  };
  double reach_m = kHeight_m;
  while (peak(reach_m) > threshold) reach_m += 0.01;
  ASSERT_GT(reach_m, 30);
  ASSERT_LT(reach_m, 45);
  std::map<std::uint64_t, double> seen;
  for (const auto& point : hover.scan(ground(), {.range_noise_m = 0, .sub_rays = 64}))
    seen[hover.shot(point)] = range_of(point);
  for (const auto& point :
       hover.scan(ground(), {.range_noise_m = 0})) {  // one ray knows no threshold
    const double range_m = range_of(point);
    if (std::abs(range_m / reach_m - 1) < 0.02) continue;
    ASSERT_EQ(seen.count(hover.shot(point)) == 1, range_m < reach_m)
        << range_m << " of " << reach_m;
  }
  EXPECT_GT(seen.size(), 1000u);
}

// The first return's noise is the one of the shot's only return; the second's is its own.
TEST(BeamsInScenes, EachReturnHasItsNoise) {
  constexpr double kSigma_m = 0.03;
  const Hover hover(one_laser());
  const auto errors = [&](const SceneContent& content, const SimulateOptions& options) {
    std::map<std::uint64_t, std::vector<double>> found;
    for (const auto& point : hover.scan(content, options)) {
      const double down = hover.down(point);
      if (down < 0.6) continue;
      const double truth = (kHeight_m - (point.plant == 7 ? 4 : 0)) / down;
      found[hover.shot(point)].push_back(range_of(point) - truth);
    }
    return found;
  };
  const auto single = errors(ground(), {.range_noise_m = kSigma_m, .seed = 3});
  const auto dual = errors(plate_over_ground(4, 0), {.range_noise_m = kSigma_m,
                                                     .seed = 3,
                                                     .threads = 3,
                                                     .sub_rays = 8,
                                                     .returns = ReturnMode::dual});
  const double off = off_centre(8);
  double products = 0;
  double squares = 0;
  const auto n = static_cast<double>(dual.size());
  for (const auto& [shot, pair] : dual) {
    ASSERT_EQ(pair.size(), 2u);
    const double down = hover.down_of(shot);
    ASSERT_NEAR(pair[0], single.at(shot)[0], half_beam_bound(off, hover, 4 / down, down));
    products += pair[0] * pair[1];
    squares += pair[1] * pair[1];
  }
  ASSERT_GT(n, 500);
  EXPECT_NEAR(products / n, 0, 4 * kSigma_m * kSigma_m / std::sqrt(n));
  EXPECT_NEAR(std::sqrt(squares / n), kSigma_m, 4 * kSigma_m / std::sqrt(2 * n));
}

bool same(const scan::LabelledPoint& a, const scan::LabelledPoint& b) {
  return a.x == b.x && a.y == b.y && a.z == b.z && a.intensity == b.intensity && a.ring == b.ring &&
         a.time == b.time && a.return_number == b.return_number &&
         a.return_count == b.return_count && a.label == b.label && a.plot == b.plot &&
         a.plant == b.plant;
}

// The small farm under slats 2 m over it, so that shots have two returns.
SceneContent farm_under_slats() {
  SceneContent content = scene_content(testing::small_farm());
  mesh::Mesh slats;
  for (int i = -50; i < 50; ++i) {
    const auto x = 0.1f * static_cast<float>(i);
    const auto first = static_cast<std::uint32_t>(slats.vertices.size());
    const mesh::Mesh slat = rectangle(x, x + 0.05f, 4, 2);
    slats.vertices.insert(slats.vertices.end(), slat.vertices.begin(), slat.vertices.end());
    for (const auto& t : slat.triangles)
      slats.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  }
  content.placed.push_back({.mesh = static_cast<std::uint32_t>(content.meshes.size()),
                            .surface = {.label = scan::PointClass::other, .reflectance = kPlate}});
  content.meshes.push_back(std::move(slats));
  return content;
}

TEST(BeamsInScenes, SamePointsForAnyNumberOfThreads) {
  const sensor::Sensor sensor = sensor::load_sensor("vlp16");
  const scan::Trajectory flight(
      {{.time_s = 0, .position_m = {-4, 0.3, 4}}, {.time_s = 0.2, .position_m = {4, 0.3, 4}}});
  const sensor::ShotPlan plan(sensor, 20, testing::spin_along_flight(), flight);
  const Scene scene(farm_under_slats());
  for (const ReturnMode mode : {ReturnMode::strongest, ReturnMode::last, ReturnMode::dual}) {
    const auto scan = [&](int threads) {
      Points points;
      simulate(scene, sensor, {.fired = plan, .placed = plan},
               {.seed = 9, .threads = threads, .sub_rays = 5, .returns = mode},
               [&](std::span<const scan::LabelledPoint> piece) {
                 points.insert(points.end(), piece.begin(), piece.end());
               });
      return points;
    };
    const Points one = scan(1);
    ASSERT_GT(one.size(), 10000u);
    const auto of_two =
        std::ranges::count_if(one, [](const auto& point) { return point.return_count == 2; });
    EXPECT_EQ(of_two > 100, mode == ReturnMode::dual);
    for (const int threads : {2, 5})
      EXPECT_TRUE(std::ranges::equal(one, scan(threads), same)) << threads;
  }
}

// One sub-ray is the axis, whatever returns are asked for.
TEST(BeamsInScenes, OneSubRayHasOneReturn) {
  const Hover hover(one_laser());
  const Points plain = hover.scan(plate_over_ground(4, 0.1), {});
  const Points dual = hover.scan(plate_over_ground(4, 0.1), {.returns = ReturnMode::dual});
  EXPECT_TRUE(std::ranges::equal(plain, dual, same));
  for (const auto& point : plain) ASSERT_EQ(point.return_count, 1);
}

TEST(BeamsInScenes, WhatCannotBeIsRefused) {
  const testing::TemporaryFolder folder;
  const auto flight = folder.write("flight.tum", "0 -3 0 5 0 0 0 1\n0.1 3 0 5 0 0 0 1\n");
  const auto no_beam =
      folder.write("mine.yaml",
                   "name: mine\ntitle: Mine\nkind: spinning\nrange: {least_m: 1, most_m: 50}\n"
                   "spin_hz: {least: 5, most: 20, default: 10}\nfiring_sequence_us: 50\n"
                   "lasers: [{fires_us: 0, elevation_deg: 0}]\n");
  const auto refusal = [&](const FlyOptions& options) {
    return message_of<InputError>(
        [&] { fly(testing::small_farm(), folder.path() / "scan", options, false); });
  };
  EXPECT_THAT(refusal({.flight = flight, .sub_rays = 0}), HasSubstr("--sub-rays 0 must be in"));
  EXPECT_THAT(refusal({.flight = flight, .sub_rays = 1025}), HasSubstr("[1, 1024]"));
  EXPECT_THAT(refusal({.flight = flight, .returns = "first"}),
              HasSubstr("--returns \"first\" must be one of strongest, last, dual"));
  EXPECT_THAT(refusal({.sensor = no_beam.string(), .flight = flight, .sub_rays = 2}),
              HasSubstr("--sub-rays 2 needs a beam; the file of sensor mine states none"));
  fly(testing::small_farm(), folder.path() / "scan", {.sensor = no_beam.string(), .flight = flight},
      false);
}

}  // namespace
}  // namespace plotscan::lidar
