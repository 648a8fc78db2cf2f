// SPDX-License-Identifier: Apache-2.0
// Several returns of a beam: their noise, their order, and what is refused.
#include <cmath>
#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "lidar/fly.h"
#include "plate_scenes.h"
#include "small_farm.h"
#include "temporary_folder.h"

namespace plotscan::lidar {
namespace {

using ::testing::HasSubstr;
using testing::message_of;

// The first return's noise is the one of the shot's only return; the second's is its own.
TEST(ReturnsInScenes, EachReturnHasItsNoise) {
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

// Noise of half a metre often puts the ground's return before the plate's, 1.5 m above.
TEST(ReturnsInScenes, CountFromTheNearestWhateverTheNoise) {
  const Hover hover(one_laser());
  const Points points =
      hover.scan(plate_over_ground(1.5, 0),
                 {.range_noise_m = 0.5, .seed = 3, .sub_rays = 8, .returns = ReturnMode::dual});
  int ground_first = 0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (points[i].return_number != 2) continue;
    ASSERT_EQ(points[i - 1].time, points[i].time);
    ASSERT_LE(range_of(points[i - 1]), range_of(points[i]));
    ground_first += points[i - 1].label == scan::PointClass::ground ? 1 : 0;
  }
  EXPECT_GT(ground_first, 0);
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

TEST(ReturnsInScenes, SamePointsForAnyNumberOfThreads) {
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
TEST(ReturnsInScenes, OneSubRayHasOneReturn) {
  const Hover hover(one_laser());
  const Points plain = hover.scan(plate_over_ground(4, 0.1), {});
  const Points dual = hover.scan(plate_over_ground(4, 0.1), {.returns = ReturnMode::dual});
  EXPECT_TRUE(std::ranges::equal(plain, dual, same));
  for (const auto& point : plain) ASSERT_EQ(point.return_count, 1);
}

TEST(ReturnsInScenes, WhatCannotBeIsRefused) {
  const testing::TemporaryFolder folder;
  const auto flight = folder.write("flight.tum", "0 -3 0 5 0 0 0 1\n0.1 3 0 5 0 0 0 1\n");
  const auto no_beam =
      folder.write("mine.yaml",
                   "name: mine\ntitle: Mine\nkind: spinning\nrange: {least_m: 1, most_m: 50}\n"
                   "spin_hz: {least: 5, most: 20, default: 10}\nfiring_sequence_us: 50\n"
                   "lasers: [{fires_us: 0, elevation_deg: 0}]\n");
  const auto refusal = [&](const FlyOptions& options) {
    return message_of<InputError>(
        [&] { fly(testing::small_farm(), folder.path() / "scan", options); });
  };
  EXPECT_THAT(refusal({.flight = flight, .sub_rays = 0}), HasSubstr("--sub-rays 0 must be in"));
  EXPECT_THAT(refusal({.flight = flight, .sub_rays = 1025}), HasSubstr("[1, 1024]"));
  EXPECT_THAT(refusal({.flight = flight, .returns = "first"}),
              HasSubstr("--returns \"first\" must be one of strongest, last, dual"));
  EXPECT_THAT(refusal({.sensor = no_beam.string(), .flight = flight, .sub_rays = 2}),
              HasSubstr("--sub-rays 2 needs a beam; the file of sensor mine states none"));
  fly(testing::small_farm(), folder.path() / "scan",
      {.sensor = no_beam.string(), .flight = flight});
}

}  // namespace
}  // namespace plotscan::lidar
