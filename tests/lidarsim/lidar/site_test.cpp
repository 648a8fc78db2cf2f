// SPDX-License-Identifier: Apache-2.0
#include "lidar/site.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "lidar/flight_plan.h"
#include "lidar/scene.h"
#include "small_farm.h"

namespace plotscan::lidar {
namespace {

using scan::PointClass;

// A square sheet of side 1 m around the origin.
mesh::Mesh sheet() {
  return {.vertices = {{-0.5, -0.5, 0}, {0.5, -0.5, 0}, {0.5, 0.5, 0}, {-0.5, 0.5, 0}},
          .triangles = {{0, 1, 2}, {0, 2, 3}}};
}

PlacedMesh sheet_at(const Eigen::Vector3d& center, double length_m, double width_m,
                    PointClass label) {
  PlacedMesh placed{.surface = {.label = label}};
  placed.world_from_mesh =
      Eigen::Translation3d(center) * Eigen::Scaling(Eigen::Vector3d(length_m, width_m, 1));
  return placed;
}

TEST(Site, OfAFarmIsItsPlots) {
  const farm::Farm farm = testing::small_farm();
  const Site site = site_of(farm);
  EXPECT_EQ(site.kind, "farm");
  EXPECT_EQ(site.name, "small");
  ASSERT_EQ(site.areas.size(), 2u);
  EXPECT_EQ(site.areas[1].center, farm.plots[1].box.center);
  double sum = 0;
  for (const farm::Plot& plot : farm.plots) {
    sum += farm.terrain.height(plot.box.center.x(), plot.box.center.y()).value();
    for (const auto& corner : plot.box.corners())
      sum += farm.terrain.height(corner.x(), corner.y()).value();
  }
  EXPECT_NEAR(site.ground_m.value(), sum / 10, 1e-12);
}

TEST(Site, OfAWorldIsItsCropWhereThereIsOne) {
  const SceneContent content{.meshes = {sheet()},
                             .placed = {sheet_at({0, 0, 2}, 100, 100, PointClass::ground),
                                        sheet_at({5, 1, 2.5}, 4, 2, PointClass::crop),
                                        sheet_at({9, 3, 2.5}, 2, 2, PointClass::weed),
                                        sheet_at({-30, -30, 3}, 8, 8, PointClass::other)}};
  const Site site = site_of("field", content);
  EXPECT_EQ(site.kind, "world");
  ASSERT_EQ(site.areas.size(), 1u);
  EXPECT_TRUE(site.areas[0].center.isApprox(Eigen::Vector2d(6.5, 2)));
  EXPECT_DOUBLE_EQ(site.areas[0].length_m, 7);
  EXPECT_DOUBLE_EQ(site.areas[0].width_m, 4);
  EXPECT_NEAR(site.ground_m.value(), 2, 1e-5);
}

TEST(Site, OfAWorldWithoutCropIsAllButTheGround) {
  SceneContent content{.meshes = {sheet()},
                       .placed = {sheet_at({1, 1, 0.5}, 60, 50, PointClass::other),
                                  sheet_at({5, 1, 3}, 4, 2, PointClass::other)}};
  EXPECT_TRUE(site_of("w", content).areas.at(0).center.isApprox(Eigen::Vector2d(5, 1)));
  EXPECT_NEAR(site_of("w", content).ground_m.value(), 0.5, 1e-5) << "the largest is the ground";
  content.placed.pop_back();
  EXPECT_DOUBLE_EQ(site_of("w", content).areas.at(0).length_m, 60) << "nothing but the ground";
  content.placed.clear();
  EXPECT_TRUE(site_of("w", content).areas.empty());
}

TEST(Site, OfAWorldWithoutGroundStandsOnItsLowestThing) {
  const SceneContent content{.meshes = {sheet()},
                             .placed = {sheet_at({5, 1, 1.5}, 4, 2, PointClass::crop),
                                        sheet_at({6, 1, 2}, 4, 2, PointClass::crop)}};
  EXPECT_DOUBLE_EQ(site_of("w", content).ground_m.value(), 1.5);
}

// A wall as wide as a leaf beside the path stops the flight; one further away does not.
TEST(Site, NothingMayReachUpToThePath) {
  SceneContent content{.meshes = {sheet()},
                       .placed = {sheet_at({0, 0, 0}, 100, 100, PointClass::ground),
                                  sheet_at({0, 0, 0.1}, 20, 1, PointClass::crop),
                                  sheet_at({3, 0.4, 6}, 0.2, 0.2, PointClass::other)}};
  const flight::StripOptions options{.altitude_m = 5, .spacing_m = 6, .run_up_m = 1};
  const Site site = site_of("w", content);
  EXPECT_THROW(plan_strips(site, Scene(content), options), InputError);
  content.placed[2] = sheet_at({3, 0.8, 6}, 0.2, 0.2, PointClass::other);
  EXPECT_EQ(plan_strips(site, Scene(content), options).size(), 2u);
  content.placed[2] = sheet_at({3, 0.4, 4.9}, 0.2, 0.2, PointClass::other);
  EXPECT_EQ(plan_strips(site, Scene(content), options).size(), 2u) << "the path passes above it";
}

}  // namespace
}  // namespace plotscan::lidar
