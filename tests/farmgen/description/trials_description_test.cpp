// SPDX-License-Identifier: Apache-2.0
#include <ostream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../example_trials.h"
#include "core/error.h"
#include "description/load_description.h"

namespace plotscan::description {
namespace {

using plotscan::testing::message_of;
using plotscan::testing::TemporaryFolder;
using ::testing::EndsWith;

planting::FarmDescription loaded_trials(const std::vector<std::string>& overrides) {
  const TemporaryFolder folder;
  return load_description(testing::write_trials(folder), overrides);
}

TEST(TrialsDescription, EachHasPlotsAndPlantsOfItsOwnAndNumbersGoOn) {
  const planting::FarmDescription farm = loaded_trials({"trials.0.plots.first_number=101"});
  ASSERT_EQ(farm.trials.size(), 2U);
  EXPECT_EQ(farm.trials[0].plots.width_m, 1.5);
  EXPECT_EQ(farm.trials[0].plants->cultivars.size(), 2U);
  EXPECT_EQ(farm.trials[0].plants->cultivars[0].models, (std::vector<std::uint32_t>{0}));
  EXPECT_EQ(farm.trials[1].plots.width_m, 2);
  EXPECT_EQ(farm.trials[1].plants->cultivars[0].count, 7U);
  EXPECT_EQ(farm.trials[1].plants->cultivars[0].models, (std::vector<std::uint32_t>{1}));
  EXPECT_EQ(farm.trials[0].plots.first_number, 101U);
  EXPECT_EQ(farm.trials[1].plots.first_number, 107U) << "after the 6 plots of the first";
}

TEST(TrialsDescription, AFarmOfOneTrialMayListIt) {
  const TemporaryFolder folder;
  const auto file = folder.write(
      "one.yaml", "terrain: {side_m: 30}\ntrials:\n  - plots: " + testing::first_trial() +
                      "\n    plants: " + testing::first_plants() + "\n");
  EXPECT_EQ(load_description(file).trials.size(), 1U);
}

TEST(TrialsDescription, ALayoutPlacesThePlantsOfAll) {
  const TemporaryFolder folder;
  folder.write("plants.csv", "model,x_m,y_m\n");
  const std::string layout = "layout: {plants: plants.csv, models: [" +
                             (testing::models_folder() / "soybean_1.obj").string() + "]}\n";
  const std::string trials =
      "terrain: {side_m: 30}\ntrials:\n  - plots: " + testing::first_trial() +
      "\n  - plots: " + testing::second_trial() + "\n";
  const planting::FarmDescription farm =
      load_description(folder.write("laid_out.yaml", trials + layout));
  ASSERT_EQ(farm.trials.size(), 2U);
  EXPECT_FALSE(farm.trials[0].plants || farm.trials[1].plants);
  EXPECT_THAT(
      message_of<InputError>([&] {
        load_description(folder.write(
            "both.yaml", trials + "    plants: " + testing::second_plants() + "\n" + layout));
      }),
      EndsWith("trials.1.plants are placed by layout; give one of the two"));
}

struct MistakenTrial {
  const char* name;
  const char* assignment;
  const char* message;  // its end
};

void PrintTo(const MistakenTrial& mistake, std::ostream* out) { *out << mistake.name; }

class MistakenTrials : public ::testing::TestWithParam<MistakenTrial> {};

TEST_P(MistakenTrials, NameTheKey) {
  EXPECT_THAT(message_of<InputError>([&] { loaded_trials({GetParam().assignment}); }),
              EndsWith(GetParam().message));
}

INSTANTIATE_TEST_SUITE_P(
    TrialsDescription, MistakenTrials,
    ::testing::Values(
        MistakenTrial{"PlotsToo", "plots.width_m=1",
                      "trials takes the place of plots; give one of the two"},
        MistakenTrial{"PlantsToo", "plants.count=1",
                      "trials takes the place of plants; give one of the two"},
        MistakenTrial{"None", "trials=[]", "trials is not a list of 1 to 1000 entries"},
        MistakenTrial{"NoPlots", "trials=[{plants: {count: 3}}]", "trials.0.plots is missing"},
        MistakenTrial{
            "NumberTwice", "trials.1.plots.first_number=6",
            "trials.1.plots.first_number gives a plot the number 6, which trial 1 has too"},
        MistakenTrial{"TooManyPlots",
                      "trials=[{plots: {width_m: 1, length_m: 1, rows: [{plots: 60000}]}, plants: "
                      "{count: 0, models: [{crop: soybean}]}}, {plots: {width_m: 1, length_m: 1, "
                      "rows: [{plots: 60000}]}, plants: {count: 0, models: [{crop: soybean}]}}]",
                      "trials hold 120000 plots; at most 100000 are allowed"},
        MistakenTrial{"TooManyPlants",
                      "trials=[{plots: {width_m: 1, length_m: 1, rows: [{plots: 6}]}, plants: "
                      "{count: 1000000, models: [{crop: soybean}]}}, {plots: {width_m: 1, "
                      "length_m: 1, rows: [{plots: 6}]}, plants: {count: 1000000, models: [{crop: "
                      "soybean}]}}]",
                      "trials make 12000000 plants; at most 10000000 are allowed"}),
    [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace plotscan::description
