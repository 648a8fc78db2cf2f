// SPDX-License-Identifier: Apache-2.0
// What `farmgen info` tells of a crop's default plot, against what was published of it.
#include <cmath>

#include <gtest/gtest.h>

#include "core/csv.h"
#include "crop/grow.h"
#include "description/load_description.h"
#include "farm/summary.h"
#include "planting/generate.h"
#include "temporary_folder.h"

namespace plotscan::description {
namespace {

constexpr double kWidth_m = 1.5;
constexpr double kLength_m = 2;

farm::CultivarSummary default_plots(const std::string& crop, const crop::StageFacts& facts) {
  const testing::TemporaryFolder folder;
  const auto file =
      folder.write("plots.yaml",
                   "terrain: {side_m: 10}\n"
                   "plots: {width_m: 1.5, length_m: 2, rows: [{plots: 2}]}\n"
                   "plants:\n"
                   "  density_m2: " +
                       format_number(facts.plants_per_m2) + "\n  models: [{crop: " + crop +
                       ", stage: " + facts.stage.name + ", variants: 15}]\n");
  return farm::summarise(planting::generate(load_description(file), 11)).cultivars.at(0);
}

TEST(DefaultPlots, LieInThePublishedRangesAtEveryStage) {
  for (const std::string& crop : crop::crops()) {
    for (const std::string& stage : crop::stages(crop)) {
      const crop::StageFacts facts = crop::stage_facts(crop, stage);
      const farm::CultivarSummary plots = default_plots(crop, facts);
      const double sown = std::round(facts.plants_per_m2 * kWidth_m * kLength_m);
      EXPECT_EQ(plots.plants, 2 * static_cast<std::size_t>(sown));
      EXPECT_TRUE(facts.stage.height_m.contains(plots.height_mean_m))
          << crop << " " << stage << ": " << plots.height_mean_m << " m, published "
          << facts.stage.height_m.text();
      EXPECT_TRUE(facts.stage.leaf_area_index.contains(plots.leaf_area_index))
          << crop << " " << stage << ": leaf area index " << plots.leaf_area_index << ", published "
          << facts.stage.leaf_area_index.text();
    }
  }
}

}  // namespace
}  // namespace plotscan::description
