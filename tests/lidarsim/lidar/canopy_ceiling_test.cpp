// SPDX-License-Identifier: Apache-2.0
// The ceiling over a canopy against every triangle tried one by one.
#include "lidar/internal/canopy_ceiling.h"

#include <gtest/gtest.h>

#include "moeller_trumbore.h"
#include "small_farm.h"

namespace plotscan::lidar {
namespace {

RayGrid grid_over(const farm::Plot& plot) {
  PlotBox box = plot.box;
  box.width_m = 0.8;
  box.length_m = 1.1;
  box.heading_rad = 0.4;
  return {box, 0.03};
}

std::optional<std::vector<float>> ceiling_over(const farm::Farm& farm, const farm::Plot& plot) {
  const CanopyCeiling ceiling(farm);
  const RayGrid grid = grid_over(plot);
  return ceiling.over(grid, ceiling.plants_near(grid));
}

double highest_m(const std::vector<testing::WorldTriangle>& triangles,
                 const Eigen::Vector2d& place) {
  double z_m = -50;
  for (const auto& triangle : triangles) {
    if (triangle.plant == 0) continue;
    const double range_m = testing::moeller_trumbore({place.x(), place.y(), 50},
                                                     -Eigen::Vector3d::UnitZ(), triangle.corners);
    z_m = std::max(z_m, 50 - range_m);
  }
  return z_m;
}

struct Excess {
  double least_m = 1;
  double mean_m = 0;
};

// By how much the ceiling exceeds what rays hit, where they hit plants.
Excess excess_of(const farm::Farm& farm) {
  const auto triangles = testing::world_triangles(farm);
  Excess excess;
  std::size_t hits = 0;
  for (const farm::Plot& plot : farm.plots) {
    const RayGrid grid = grid_over(plot);
    const std::vector<float> ceiling_m = ceiling_over(farm, plot).value();
    for (std::size_t i = 0; i < grid.rays(); ++i) {
      const Eigen::Vector2d place = grid.place(i);
      const double ground_m = farm.terrain.height(place.x(), place.y()).value();
      const double above_m = highest_m(triangles, place) - ground_m;
      if (above_m <= 0) continue;
      const double more_m = static_cast<double>(ceiling_m[i]) - above_m;
      excess.least_m = std::min(excess.least_m, more_m);
      excess.mean_m += more_m;
      ++hits;
    }
  }
  excess.mean_m /= static_cast<double>(hits);
  return excess;
}

TEST(CanopyCeiling, NothingExceedsItAndItIsNear) {
  farm::Farm farm = testing::small_farm();
  for (farm::Plant& plant : farm.plants)
    plant.rotation = Eigen::AngleAxisd(plant.id, Eigen::Vector3d::UnitZ());
  const Excess excess = excess_of(farm);
  EXPECT_GT(excess.least_m, 0);
  EXPECT_LT(excess.mean_m, 0.15);  // leaves of 0.1 m that stand in any way
}

TEST(CanopyCeiling, NothingOfLeaningPlantsExceedsIt) {
  EXPECT_GT(excess_of(testing::small_farm()).least_m, 0);
}

TEST(CanopyCeiling, BareGroundHasNone) {
  farm::Farm farm = testing::small_farm();
  farm.plants.clear();
  const std::vector<float> ceiling_m = ceiling_over(farm, farm.plots[0]).value();
  EXPECT_TRUE(std::ranges::all_of(ceiling_m, [](float height_m) { return height_m == 0; }));
}

TEST(CanopyCeiling, IsNotKnownAtTheTerrainsEdge) {
  farm::Farm farm = testing::small_farm();
  farm.plots[0].box.center = {7.8, 0};
  EXPECT_FALSE(ceiling_over(farm, farm.plots[0]));
  farm.plots[0].box.center = {20, 0};
  EXPECT_FALSE(ceiling_over(farm, farm.plots[0]));
}

TEST(CanopyCeiling, IsNotSoughtWherePlantsStandInEachOther) {
  farm::Farm farm = testing::small_farm();
  farm.plants.resize(200, farm.plants[0]);
  EXPECT_FALSE(ceiling_over(farm, farm.plots[0]));
}

}  // namespace
}  // namespace plotscan::lidar
