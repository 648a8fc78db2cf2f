// SPDX-License-Identifier: Apache-2.0
#include "farm/summary.h"

#include "farmgen/farm/example_farm.h"
#include "mesh/measure.h"
#include <gtest/gtest.h>

#include "farm/generate.h"

namespace plotscan::farm {
namespace {

using plotscan::testing::TemporaryFolder;

TEST(Summary, CountsWhatTheFarmHolds) {
  const TemporaryFolder folder;
  const Farm farm = generate(load_description(write_example(folder)), 3);
  const FarmSummary summary = summarise(farm);
  EXPECT_EQ(summary.terrain_size_m, Eigen::Vector2d(20, 20));
  EXPECT_EQ(summary.plots, 5u);
  EXPECT_EQ(summary.plants, 100u);
  EXPECT_EQ(summary.models, 2u);
  double least = 1e9;
  double total = 0;
  double area = 0;
  std::size_t triangles = 0;
  for (const Plant& plant : farm.plants) {
    const mesh::Mesh& mesh = farm.models[plant.model].mesh;
    least = std::min(least, plant.height_m);
    total += plant.height_m;
    area += mesh::ScaledArea(mesh).at(plant.scale);
    triangles += mesh.triangles.size();
  }
  EXPECT_EQ(summary.plant_height_m.min, least);
  EXPECT_NEAR(summary.plant_height_m.mean, total / 100, 1e-12);
  EXPECT_EQ(summary.plant_triangles, triangles);
  EXPECT_NEAR(summary.leaf_area_index, area / (5 * 1.5 * 3), 1e-9);
  EXPECT_GE(summary.plot_height_max_m.min, summary.plant_height_m.min);
  EXPECT_EQ(summary.plot_height_max_m.max, summary.plant_height_m.max);
}

}  // namespace
}  // namespace plotscan::farm
