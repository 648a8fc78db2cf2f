// SPDX-License-Identifier: Apache-2.0
#include "score/oracle_ground.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "core/random.h"

namespace plotscan::score {
namespace {

// Two triangles that meet in a ridge along y at x = 0, 1 m high, falling by 0.1 m a metre.
terrain::Terrain ridge() {
  return terrain::Terrain(
      {{-10, -10, 0}, {0, -10, 1}, {10, -10, 0}, {-10, 10, 0}, {0, 10, 1}, {10, 10, 0}},
      {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}});
}

double ridge_z(double x) { return 1 - 0.1 * std::abs(x); }

struct Field {
  cloud::CloudMap map{cloud::Area{-9.5, -9.5, 9.5, 9.5}};
  std::vector<TruePlot> plots;
};

// Ground everywhere and, over each plot, points whose heights are uniform in [0, top_m].
Field ridge_field(double top_m) {
  Field field;
  for (const double x : {-3.0, 0.0, 3.0}) {
    field.plots.push_back({.id = static_cast<std::uint32_t>(field.plots.size() + 1),
                           .box = {.center = {x, 0},
                                   .width_m = 1.5,
                                   .length_m = 4,
                                   .heading_rad = std::numbers::pi / 2}});
  }
  RandomStream random(5, random_purpose("test/ridge"), 0);
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 40000; ++i) {
    const Eigen::Vector2d at(random.uniform(-9, 9), random.uniform(-9, 9));
    points.emplace_back(at.x(), at.y(), ridge_z(at.x()) + 0.01 * random.normal());
  }
  for (const TruePlot& plot : field.plots) {
    for (int i = 0; i < 40000; ++i) {
      const double x = plot.box.center.x() + random.uniform(-0.75, 0.75);
      points.emplace_back(x, random.uniform(-2, 2), ridge_z(x) + random.uniform(0, top_m));
    }
  }
  field.map.add(points);
  return field;
}

TEST(OracleGround, TakesThePercentileOverTheTrueTerrain) {
  const Field field = ridge_field(0.8);
  // Voxels of 5 mm hold few points, so that raw and voxel-filtered points have one
  // distribution: uniform in (0.05, 0.8], whose 99th percentile is known.
  const estimate::Estimate estimate =
      oracle_ground(field.map, field.plots, ridge(), {.voxel_m = 0.005});
  ASSERT_EQ(estimate.plots.size(), 3U);
  for (const estimate::PlotEstimate& plot : estimate.plots) {
    EXPECT_NEAR(plot.heights_m.at("p99"), 0.05 + 0.99 * 0.75, 0.004) << "plot " << plot.id;
    EXPECT_GT(plot.points, 40000U);
  }
  EXPECT_EQ(estimate.method, "oracle-ground");
  EXPECT_DOUBLE_EQ(estimate.plots[1].box.center.x(), 0);
}

TEST(OracleGround, SeesTheBoxAndItsEndsOnly) {
  const std::vector<TruePlot> plots = {
      {.id = 1, .box = {.center = {0, 0}, .width_m = 1, .length_m = 2, .heading_rad = 0}}};
  const terrain::Terrain flat({{-5, -5, 0}, {5, -5, 0}, {5, 5, 0}, {-5, 5, 0}},
                              {{0, 1, 2}, {0, 2, 3}});
  const auto height_with = [&](const Eigen::Vector3d& point) {
    cloud::CloudMap map(cloud::Area{-4, -4, 4, 4});
    map.add(std::vector<Eigen::Vector3d>{{0, 0, 0.04}, point});
    return oracle_ground(map, plots, flat, {.extend_m = 0.5}).plots[0].heights_m;
  };
  EXPECT_NEAR(height_with({1.4, 0, 0.7}).at("p99"), 0.7, 1e-6);  // in the extended end
  EXPECT_TRUE(height_with({1.6, 0, 0.7}).empty());               // beyond it
  EXPECT_TRUE(height_with({0, 0.6, 0.7}).empty());               // beside the box
  EXPECT_TRUE(height_with({0, 0.1, 0.049}).empty());             // ground
}

TEST(OracleGround, APlotBesideTheTerrainHasNoHeight) {
  cloud::CloudMap map(cloud::Area{-20, -20, 20, 20});
  map.add(std::vector<Eigen::Vector3d>{{15, 0, 0.7}});
  const std::vector<TruePlot> plots = {
      {.id = 1, .box = {.center = {15, 0}, .width_m = 1, .length_m = 2, .heading_rad = 0}}};
  EXPECT_TRUE(oracle_ground(map, plots, ridge()).plots[0].heights_m.empty());
}

}  // namespace
}  // namespace plotscan::score
