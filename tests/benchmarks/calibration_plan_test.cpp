// SPDX-License-Identifier: Apache-2.0
#include <set>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calibration/farm_plan.h"
#include "description/load_description.h"
#include "temporary_folder.h"

namespace plotscan::calibration {
namespace {

using plotscan::testing::TemporaryFolder;

const std::filesystem::path kFolder =
    std::filesystem::path(PLOTSCAN_SOURCE_DIR) / "benchmarks/calibration";

std::string text_of(const FarmPlan& plan, const std::string& key) {
  for (const std::string& set : plan.overrides)
    if (set.starts_with(key)) return set;
  return "";
}

// Of "plants.scale=[0.9, 1.1]".
double largest_scale(const FarmPlan& plan) {
  const std::string scale = text_of(plan, "plants.scale=");
  return std::stod(scale.substr(scale.find(',') + 1));
}

double value_of(const std::string& models, const std::string& key) {
  return std::stod(models.substr(models.find(key + "=") + key.size() + 1));
}

TEST(CalibrationPlan, HasFarmsThatCanBeMadeOfEveryLibrary) {
  std::set<std::uint64_t> seeds;
  const std::pair<const char*, const char*> kinds[] = {
      {"libraries.yaml", "usual"}, {"libraries.yaml", "wide"}, {"maize_shapes.yaml", "shapes"}};
  for (const auto& [file, ranges] : kinds) {
    const std::vector<Library> libraries = read_libraries(kFolder / file, ranges);
    ASSERT_FALSE(libraries.empty()) << file;
    std::set<std::string> names;
    for (std::size_t i = 0; i < libraries.size(); ++i) {
      EXPECT_TRUE(names.insert(libraries[i].name).second) << libraries[i].name;
      for (int number = 0; number < 3; ++number) {
        const FarmPlan plan = plan_farm(libraries[i], i, number);
        EXPECT_TRUE(seeds.insert(plan.seed).second) << plan.library << " " << number;
        EXPECT_NO_THROW(description::load_description(kFolder / "farm.yaml", plan.overrides))
            << plan.library << " " << number;
      }
    }
  }
}

// Bounds of a library's own hold for its farms of usual plants too, those of its crop do not, and
// vigour is that of some farms.
TEST(CalibrationPlan, DrawsALibrarysOwnBoundsForEveryFarm) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.write(
      "libraries.yaml",
      "ranges:\n"
      "  small:\n"
      "    {first_seed: 2000, vigour: [0.5, 0.6],\n"
      "     crops: {wheat: {awn_m: [0.02, 0.09], tuft_plants_per_m: [15, 45]}}}\n"
      "libraries:\n"
      "  - {name: wheat-dense, crop: wheat, stage: Z65, vary: {tuft_plants_per_m: [50, 60]},\n"
      "     row_m: [0.12, 0.2], spacing_m: [0.25, 0.25], spread: [0, 0.1], variants: [2, 4]}\n");
  const Library library = read_libraries(file, "small").front();
  int usual = 0, small = 0;
  for (int number = 0; number < 40; ++number) {
    const FarmPlan plan = plan_farm(library, 0, number);
    EXPECT_EQ(plan.seed, 2000U + static_cast<unsigned>(number));
    const std::string models = text_of(plan, "plants.models=");
    if (largest_scale(plan) < 0.7) ++small;
    EXPECT_GE(value_of(models, "tuft_plants_per_m"), 50) << models;
    EXPECT_LE(value_of(models, "tuft_plants_per_m"), 60) << models;
    if (models.find("awn_m=") == std::string::npos) ++usual;
  }
  EXPECT_GT(usual, 0);
  EXPECT_LT(usual, 40);
  EXPECT_GT(small, 0);
  EXPECT_LT(small, 40);
}

}  // namespace
}  // namespace plotscan::calibration
