// SPDX-License-Identifier: Apache-2.0
#include "farm/summary.h"

#include "example_farm.h"
#include <gtest/gtest.h>

#include "farm/generate.h"

namespace plotscan::farm {
namespace {

using plotscan::testing::TemporaryFolder;

// A box of 2 x 3 x 5 m without its bottom.
Mesh open_box() {
  Mesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.vertices.emplace_back(i & 1 ? 2 : 0, i & 2 ? 3 : 0, i & 4 ? 5 : 0);
  }
  mesh.triangles = {{4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4}, {2, 7, 3},
                    {2, 6, 7}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

TEST(Summary, AreaOfAScaledBoxIsThatOfItsSides) {
  EXPECT_DOUBLE_EQ(scaled_area(open_box(), {1, 1, 1}), 2 * 3 + 2 * (2 + 3) * 5);
  EXPECT_DOUBLE_EQ(scaled_area(open_box(), {0.5, 2, 3}), 1 * 6 + 2 * (1 + 6) * 15);
}

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
    const Mesh& mesh = farm.models[plant.model].mesh;
    least = std::min(least, plant.height_m);
    total += plant.height_m;
    area += scaled_area(mesh, plant.scale);
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
