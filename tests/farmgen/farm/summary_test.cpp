// SPDX-License-Identifier: Apache-2.0
#include "farm/summary.h"

#include <gtest/gtest.h>

#include "../example_farm.h"
#include "description/load_description.h"
#include "mesh/measure.h"
#include "planting/generate.h"

namespace plotscan::farm {
namespace {

using plotscan::testing::TemporaryFolder;

TEST(Summary, CountsWhatTheFarmHolds) {
  const TemporaryFolder folder;
  const Farm farm = planting::generate(description::load_description(write_example(folder)), 3);
  const FarmSummary summary = summarise(farm);
  EXPECT_EQ(summary.terrain_size_m, Eigen::Vector2d(20, 20));
  EXPECT_EQ(summary.plots, 5u);
  EXPECT_EQ(summary.trials, 1u);
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
    area += mesh::ScaledArea::of_leaves(mesh).at(plant.scale);
    triangles += mesh.triangles.size();
  }
  EXPECT_EQ(summary.plant_height_m.min, least);
  EXPECT_NEAR(summary.plant_height_m.mean, total / 100, 1e-12);
  EXPECT_EQ(summary.plant_triangles, triangles);
  EXPECT_NEAR(summary.leaf_area_index, area / (5 * 1.5 * 3), 1e-9);
  EXPECT_GE(summary.plot_height_max_m.min, summary.plant_height_m.min);
  EXPECT_EQ(summary.plot_height_max_m.max, summary.plant_height_m.max);
}

TEST(Summary, AddsUpEveryCultivarsPlots) {
  const TemporaryFolder folder;
  const Farm farm = planting::generate(
      description::load_description(
          write_example(folder),
          {"plants.design=cycle", "plants.missing={rate: 0.2}",
           "plants.cultivars=[{name: flat, lodging: {plots_rate: 1, angle_deg: [40, 50]}}, "
           "{name: tall, height_m: {mean: 2, sd: 0.1}}]",
           "weeds={per_m2: 5, models: [{crop: soybean, name: weed}]}"}),
      3);
  const FarmSummary summary = summarise(farm);
  ASSERT_EQ(summary.cultivars.size(), 2u);
  std::size_t in_plots = 0;
  for (const CultivarSummary& cultivar : summary.cultivars) {
    std::size_t plants = 0;
    std::size_t weeds = 0;
    double total = 0;
    double highest = 0;
    double leaves = 0;
    double plots = 0;
    for (const Plot& plot : farm.plots) {
      if (plot.accession != cultivar.name) continue;
      ++plots;
      for (const Plant& plant : farm.plants) {
        if (plant.plot != plot.id) continue;
        if (plant.kind == PlantKind::weed) {
          ++weeds;
          continue;
        }
        ++plants;
        total += plant.height_m;
        highest = std::max(highest, plant.height_m);
        leaves += mesh::ScaledArea::of_leaves(farm.models[plant.model].mesh).at(plant.scale);
      }
    }
    const double area = plots * 1.5 * 3;
    EXPECT_EQ(cultivar.plots, plots);
    EXPECT_EQ(cultivar.lodged_plots, cultivar.name == "flat" ? 3u : 0u);
    EXPECT_EQ(cultivar.plants, plants);
    EXPECT_EQ(cultivar.plants + cultivar.missing_plants, 20 * plots);
    EXPECT_EQ(cultivar.weeds, weeds);
    EXPECT_NEAR(cultivar.height_mean_m, total / static_cast<double>(plants), 1e-12);
    EXPECT_EQ(cultivar.height_max_m, highest);
    EXPECT_NEAR(cultivar.plants_per_m2, static_cast<double>(plants) / area, 1e-12);
    EXPECT_NEAR(cultivar.leaf_area_index, leaves / area, 1e-9);
    in_plots += plants;
  }
  EXPECT_EQ(summary.plants, in_plots);
  EXPECT_EQ(summary.plants + summary.weeds, farm.plants.size());
}

}  // namespace
}  // namespace plotscan::farm
