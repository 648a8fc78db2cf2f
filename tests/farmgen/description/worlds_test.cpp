// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "core/error.h"
#include "description/load_description.h"
#include "planting/generate.h"

namespace plotscan::description {
namespace {

namespace fs = std::filesystem;

fs::path worlds_folder() { return fs::path(PLOTSCAN_SOURCE_DIR) / "worlds"; }

std::vector<std::string> worlds() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(worlds_folder())) {
    if (entry.path().extension() == ".yaml") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

farm::Farm made(const std::string& world) {
  return planting::generate(load_description(worlds_folder() / (world + ".yaml")), 1);
}

class World : public ::testing::TestWithParam<std::string> {};

TEST_P(World, IsSound) {
  const farm::Farm farm = made(GetParam());
  EXPECT_EQ(farm.name, GetParam());
  EXPECT_FALSE(farm.plants.empty());
  for (const farm::Plot& plot : farm.plots) EXPECT_GT(plot.plant_count, 0u) << "plot " << plot.id;
}

INSTANTIATE_TEST_SUITE_P(Shipped, World, ::testing::ValuesIn(worlds()),
                         [](const auto& world) { return world.param; });

// What the plots of each cultivar are high on average, and how many blocks it stands in.
void expect_blocks(const farm::Farm& farm, std::size_t cultivars, std::size_t blocks) {
  std::map<std::string, std::set<int>> blocks_of;
  for (const farm::Plot& plot : farm.plots) {
    EXPECT_EQ(plot.block, plot.row) << "rows are blocks";
    blocks_of[plot.accession].insert(plot.block);
  }
  EXPECT_EQ(blocks_of.size(), cultivars);
  for (const auto& [name, own] : blocks_of) EXPECT_EQ(own.size(), blocks) << name;
}

TEST(World, KentlandIsTheFieldOfThePaper) {
  const farm::Farm farm = made("kentland");
  ASSERT_EQ(farm.plots.size(), 112u);
  expect_blocks(farm, 28, 4);
  for (const farm::Plot& plot : farm.plots) {
    for (const farm::Plot& other : farm.plots) {
      if (other.row == plot.row && other.column == plot.column + 1) {
        EXPECT_NEAR((other.box.center - plot.box.center - Eigen::Vector2d(1.122, 0.956)).norm(), 0,
                    1e-12);
      }
      if (other.column == plot.column && other.row == plot.row + 1) {
        EXPECT_NEAR((other.box.center - plot.box.center - Eigen::Vector2d(-3.25, 3.85)).norm(), 0,
                    1e-12);
      }
      if (other.id <= plot.id) continue;
      EXPECT_LT(intersection_area(plot.box, other.box), 1e-9);
    }
  }
}

TEST(World, MaizeStandsOnItsRidges) {
  const farm::Farm farm = made("maize");
  ASSERT_EQ(farm.plots.size(), 32u);
  expect_blocks(farm, 8, 4);
  double on_rows_m = 0;
  double between_rows_m = 0;
  std::size_t plants = 0;
  for (const farm::Plant& plant : farm.plants) {
    if (plant.kind == farm::PlantKind::weed) continue;
    ++plants;
    on_rows_m += plant.position.z();
    between_rows_m += farm.terrain.height(plant.position.x() + 0.38, plant.position.y()).value();
  }
  EXPECT_NEAR((on_rows_m - between_rows_m) / static_cast<double>(plants), 0.08, 0.02);
}

}  // namespace
}  // namespace plotscan::description
