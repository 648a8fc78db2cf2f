// SPDX-License-Identifier: Apache-2.0
// Farms of several trials.
#include <algorithm>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../example_trials.h"
#include "core/error.h"
#include "core/text_file.h"
#include "description/load_description.h"
#include "farm/summary.h"
#include "farmfolder/plot_table.h"
#include "planting/generate.h"
#include "temporary_folder.h"

namespace plotscan::planting {
namespace {

using plotscan::testing::message_of;
using plotscan::testing::TemporaryFolder;
using ::testing::EndsWith;
using ::testing::HasSubstr;

farm::Farm farm_of(const std::vector<std::string>& overrides = {}) {
  const TemporaryFolder folder;
  return generate(description::load_description(testing::write_trials(folder), overrides), 4);
}

std::vector<farm::Plot> plots_of_trial(const farm::Farm& farm, int trial) {
  std::vector<farm::Plot> plots;
  for (const farm::Plot& plot : farm.plots)
    if (plot.trial == trial) plots.push_back(plot);
  return plots;
}

TEST(SeveralTrials, EachStandsWhereAndAsItsOwnSectionSays) {
  const farm::Farm farm = farm_of();
  const std::vector<farm::Plot> first = plots_of_trial(farm, 1);
  const std::vector<farm::Plot> second = plots_of_trial(farm, 2);
  ASSERT_EQ(first.size(), 6U);
  ASSERT_EQ(second.size(), 4U);
  EXPECT_EQ(first.back().id, 6U);
  EXPECT_EQ(second.front().id, 7U);
  EXPECT_EQ(second.front().row, 1);
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  for (const farm::Plot& plot : second) {
    EXPECT_EQ(plot.box.width_m, 2);
    EXPECT_EQ(plot.plant_count, 7U);
    middle += plot.box.center / 4;
  }
  EXPECT_LT((middle - Eigen::Vector2d(5, 0)).norm(), 1e-12);
  for (const farm::Plant& plant : farm.plants) EXPECT_EQ(plant.model, plant.plot <= 6 ? 0U : 1U);
}

// What is drawn for a trial does not depend on those after it.
TEST(SeveralTrials, TheFirstIsAsItWouldBeAlone) {
  const farm::Farm both = farm_of();
  const TemporaryFolder folder;
  const farm::Farm alone = generate(
      description::load_description(folder.write(
          "alone.yaml",
          "terrain: {side_m: 30, vertices: 40, relief_m: 0.4}\nplots: " + testing::first_trial() +
              "\nplants: " + testing::first_plants() + "\n")),
      4);
  ASSERT_EQ(alone.plots.size(), 6U);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(alone.plots[i].trial, 0);
    EXPECT_EQ(alone.plots[i].accession, both.plots[i].accession);
    EXPECT_EQ(alone.plots[i].heights.mean, both.plots[i].heights.mean);
  }
  ASSERT_EQ(alone.plants.size(), 72U);
  for (std::size_t i = 0; i < 72; ++i)
    EXPECT_EQ(alone.plants[i].position, both.plants[i].position) << i;
}

// Two trials of one description share no random number.
TEST(SeveralTrials, EachIsDrawnAnew) {
  const std::string plots = "{width_m: 1, length_m: 1, heading_deg: random, rows: [{plots: 8}]";
  const std::string trial = ", plants: " + testing::first_plants() + "}";
  for (const char* design : {"random", "rcbd"}) {
    const farm::Farm farm =
        farm_of({"trials=[{plots: " + plots + ", position_m: [-7, 0]}" + trial +
                     ", {plots: " + plots + ", position_m: [7, 0]}" + trial + "]",
                 std::string("trials.0.plants.design=") + design,
                 std::string("trials.1.plants.design=") + design});
    const std::vector<farm::Plot> first = plots_of_trial(farm, 1);
    const std::vector<farm::Plot> second = plots_of_trial(farm, 2);
    ASSERT_EQ(first.size(), second.size());
    EXPECT_GT(std::abs(first[0].box.heading_rad - second[0].box.heading_rad), 0.01);
    EXPECT_FALSE(
        std::ranges::equal(first, second, {}, &farm::Plot::accession, &farm::Plot::accession))
        << design;
    EXPECT_NE(first[0].heights.mean, second[0].heights.mean);
  }
}

TEST(SeveralTrials, ThoseThatOverlapAreRefused) {
  EXPECT_THAT(message_of<InputError>([] { farm_of({"trials.1.plots.position_m=[-6, 0]"}); }),
              HasSubstr("trials: plots 1 and 7 overlap"));
}

TEST(SeveralTrials, OneWithoutAPlotIsRefused) {
  EXPECT_THAT(message_of<InputError>([] { farm_of({"trials.1.plots.missing_rate=1"}); }),
              EndsWith("trials.1.plots: all 4 are missing; a lower missing_rate leaves some"));
}

TEST(SeveralTrials, TheTruthNamesThemAndIsReadBack) {
  const farm::Farm farm = farm_of();
  const TemporaryFolder folder;
  farmfolder::write_plots(folder.path() / "plots.geojson", farm.plots);
  const std::vector<farm::Plot> read = farmfolder::read_plots(folder.path() / "plots.geojson");
  const std::vector<farm::Plot> boxes =
      farmfolder::read_plot_boxes(folder.path() / "plots.geojson");
  for (std::size_t i = 0; i < farm.plots.size(); ++i) {
    EXPECT_EQ(read.at(i).trial, i < 6 ? 1 : 2);
    EXPECT_EQ(boxes.at(i).trial, i < 6 ? 1 : 2);
  }
  farmfolder::write_trial_layout(folder.path() / "plots.csv", "station", farm.plots);
  const std::string table = read_text(folder.path() / "plots.csv");
  EXPECT_THAT(table, HasSubstr("plot_number,trial_number,block_number"));
  EXPECT_THAT(table, HasSubstr("\nstation_7,crop,7,2,1,1,1,1,"));
}

TEST(SeveralTrials, ASummaryTellsThemApart) {
  const farm::FarmSummary summary =
      farm::summarise(farm_of({"trials.0.plants.cultivars.0.name=crop"}));
  EXPECT_EQ(summary.trials, 2U);
  ASSERT_EQ(summary.cultivars.size(), 3U);
  EXPECT_EQ(summary.cultivars[1].trial, 1);
  EXPECT_EQ(summary.cultivars[1].name, "crop");
  EXPECT_EQ(summary.cultivars[1].plants, 36U);
  EXPECT_EQ(summary.cultivars[2].trial, 2);
  EXPECT_EQ(summary.cultivars[2].name, "crop");
  EXPECT_EQ(summary.cultivars[2].plants, 28U);
}

}  // namespace
}  // namespace plotscan::planting
