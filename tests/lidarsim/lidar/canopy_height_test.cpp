// SPDX-License-Identifier: Apache-2.0
// The canopy's true heights against closed forms and against every triangle tried one by one.
#include "lidar/canopy_height.h"

#include <gtest/gtest.h>

#include "core/statistics.h"
#include "farmfolder/read_farm.h"
#include "farmfolder/write_farm.h"
#include "mesh/alpha_mask.h"
#include "moeller_trumbore.h"
#include "small_farm.h"
#include "temporary_folder.h"
#include "test_images.h"

namespace plotscan::lidar {
namespace {

// A plate of 1 x 1 m at the height of 1 m over its foot.
mesh::Mesh plate() {
  return {.vertices = {{-0.5F, -0.5F, 1}, {0.5F, -0.5F, 1}, {0.5F, 0.5F, 1}, {-0.5F, 0.5F, 1}},
          .triangles = {{0, 1, 2}, {0, 2, 3}},
          .materials = {{.name = "leaf"}},
          .triangle_material = {0, 0},
          .texture_coordinates = {{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
}

// A plot of 1 x 10 m that is turned, on flat ground at 3 m.
farm::Farm one_plot() {
  farm::Farm farm{.name = "one",
                  .terrain = testing::flat_terrain(20, 3),
                  .models = {{.name = "plate", .mesh = plate(), .height_m = 1}},
                  .plots = {},
                  .plants = {}};
  farm.plots.push_back(
      {.id = 1,
       .row = 1,
       .column = 1,
       .box = {.center = {2, -1}, .width_m = 1, .length_m = 10, .heading_rad = 0.6},
       .plant_count = 1,
       .heights = {}});
  return farm;
}

// A plate over the whole width and `length_m` of the plot's middle, `along_m` from its centre.
void add_plate(farm::Farm& farm, double along_m, double length_m, double height_m) {
  const PlotBox& box = farm.plots[0].box;
  const Eigen::Vector2d place = box.center + along_m * box.length_axis();
  farm.plants.push_back(
      {.id = static_cast<std::uint32_t>(farm.plants.size() + 1),
       .plot = 1,
       .position = {place.x(), place.y(), 3},
       .rotation = Eigen::Quaterniond(Eigen::AngleAxisd(box.heading_rad, Eigen::Vector3d::UnitZ())),
       .scale = {length_m, 2, height_m}});
}

farm::CanopyHeights canopy_of(farm::Farm farm, int threads = 1) {
  measure_canopies(farm, threads);
  return farm.plots[0].canopy.value();
}

TEST(CanopyHeight, BareGroundIsNoCanopy) {
  const farm::CanopyHeights canopy = canopy_of(one_plot());
  EXPECT_EQ(canopy.p95, 0);
  EXPECT_EQ(canopy.p99, 0);
}

// 3 % of the plot are 0.8 m high, another 4 % 0.5 m, the rest is ground: its 95th percentile is the
// lower plate, its 99th the higher one.
TEST(CanopyHeight, IsAPercentileOfThePlotsArea) {
  farm::Farm farm = one_plot();
  add_plate(farm, -3, 0.3, 0.8);
  add_plate(farm, 2, 0.4, 0.5);
  const farm::CanopyHeights canopy = canopy_of(farm);
  EXPECT_NEAR(canopy.p95, 0.5, 1e-6);
  EXPECT_NEAR(canopy.p99, 0.8, 1e-6);
}

// 4.9 % are too little for the 95th percentile, 5.1 % are enough: a grid of 1 cm can tell.
TEST(CanopyHeight, TheGridIsOneCentimetre) {
  farm::Farm less = one_plot();
  add_plate(less, 0.005, 0.49, 0.7);
  EXPECT_EQ(canopy_of(less).p95, 0);
  farm::Farm more = one_plot();
  add_plate(more, 0.005, 0.51, 0.7);
  EXPECT_NEAR(canopy_of(more).p95, 0.7, 1e-6);
}

// What hangs over the plot counts whoever's it is; what lies under something does not.
TEST(CanopyHeight, RaysHitWhatIsThere) {
  farm::Farm farm = one_plot();
  add_plate(farm, 0, 20, 0.4);
  farm.plants[0].plot = 7;
  add_plate(farm, 0, 20, 0.3);
  add_plate(farm, 0, 1, 0.6);
  farm.plants[2].kind = farm::PlantKind::weed;
  const farm::CanopyHeights canopy = canopy_of(farm);
  EXPECT_NEAR(canopy.p95, 0.6, 1e-6);
  farm.plants.pop_back();
  EXPECT_NEAR(canopy_of(farm).p95, 0.4, 1e-6);
}

// A mask of which 1 pixel of 4 is opaque.
TEST(CanopyHeight, MasksLetRaysThrough) {
  farm::Farm farm = one_plot();
  const std::string png = testing::png_of_grey(
      2, 2, [](int column, int row) { return column == 0 && row == 0 ? 255 : 0; });
  farm.models[0].mesh.materials[0].mask = std::make_shared<const mesh::AlphaMask>(
      std::make_shared<const mesh::Image>(mesh::Image{"mask.png", png}), mesh::kAlphaCutoff,
      "mask.png");
  add_plate(farm, 0, 0.16, 0.9);  // 0.4 % of the plot when it is masked
  EXPECT_EQ(canopy_of(farm).p99, 0);
  farm.models[0].mesh.materials[0].mask = nullptr;  // 1.6 %
  EXPECT_NEAR(canopy_of(farm).p99, 0.9, 1e-6);
}

TEST(CanopyHeight, IsWhatTryingEveryTriangleGives) {
  farm::Farm farm = testing::small_farm();
  for (farm::Plot& plot : farm.plots) {
    plot.box.width_m = 0.4;  // 40 x 60 rays
    plot.box.length_m = 0.6;
    plot.box.heading_rad = 0.4;
  }
  measure_canopies(farm, 2);
  const auto triangles = testing::world_triangles(farm);
  for (const farm::Plot& plot : farm.plots) {
    std::vector<double> heights_m;
    for (int i = 0; i < 60; ++i) {
      for (int j = 0; j < 40; ++j) {
        const Eigen::Vector2d place = plot.box.center + (i - 29.5) * 0.01 * plot.box.length_axis() +
                                      (j - 19.5) * 0.01 * plot.box.width_axis();
        const double ground_m = farm.terrain.height(place.x(), place.y()).value();
        double highest_m = ground_m;
        for (const auto& triangle : triangles) {
          const double range_m = testing::moeller_trumbore(
              {place.x(), place.y(), 50}, -Eigen::Vector3d::UnitZ(), triangle.corners);
          if (triangle.plant != 0) highest_m = std::max(highest_m, 50 - range_m);
        }
        heights_m.push_back(highest_m - ground_m);
      }
    }
    // Single precision may decide otherwise about a ray at an edge: another order statistic then.
    EXPECT_NEAR(plot.canopy->p95, quantile(heights_m, 0.95), 1e-3) << plot.id;
    EXPECT_NEAR(plot.canopy->p99, quantile(heights_m, 0.99), 1e-3) << plot.id;
    EXPECT_GT(plot.canopy->p95, 0.05);
  }
}

// Each plot is measured among its own plants alone.
TEST(CanopyHeight, OtherPlotsChangeNothing) {
  farm::Farm farm = testing::small_farm();
  const farm::CanopyHeights among_others = canopy_of(farm);
  farm.plots.resize(1);
  EXPECT_EQ(canopy_of(farm).p95, among_others.p95);
  EXPECT_EQ(canopy_of(farm).p99, among_others.p99);
}

// A vertex that no triangle uses makes no plant higher: rays start above the highest plant.
TEST(CanopyHeight, LooseVerticesHideNothing) {
  farm::Farm farm = one_plot();
  add_plate(farm, 0, 20, 5);
  farm.models.push_back(farm.models[0]);
  farm.models[1].mesh.vertices.push_back({0, 0, 90});
  add_plate(farm, 0, 1, 0.2);
  farm.plants[1].model = 1;
  EXPECT_NEAR(canopy_of(farm).p99, 5, 1e-5);
}

TEST(CanopyHeight, ThreadsChangeNothing) {
  const farm::Farm farm = testing::small_farm();
  const farm::CanopyHeights one = canopy_of(farm, 1);
  for (const int threads : {2, 5}) {
    EXPECT_EQ(canopy_of(farm, threads).p95, one.p95);
    EXPECT_EQ(canopy_of(farm, threads).p99, one.p99);
  }
}

TEST(CanopyHeight, ComesBackWithTheFarm) {
  const testing::TemporaryFolder folder;
  farm::Farm farm = testing::small_farm();
  for (std::size_t i = 0; i < farm.plants.size(); ++i)
    farm.plants[i].id = static_cast<std::uint32_t>(i + 1);
  farmfolder::write_farm(farm, folder.path() / "without", {.command = "test"});
  EXPECT_FALSE(farmfolder::read_farm(folder.path() / "without").plots[0].canopy);
  measure_canopies(farm, 1);
  farmfolder::write_farm(farm, folder.path() / "with", {.command = "test"});
  const farm::Farm again = farmfolder::read_farm(folder.path() / "with");
  ASSERT_TRUE(again.plots[1].canopy);
  EXPECT_EQ(again.plots[1].canopy->p95, farm.plots[1].canopy->p95);
  EXPECT_EQ(again.plots[1].canopy->p99, farm.plots[1].canopy->p99);
}

}  // namespace
}  // namespace plotscan::lidar
