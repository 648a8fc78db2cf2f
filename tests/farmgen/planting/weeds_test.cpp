// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../example_trials.h"
#include "core/error.h"
#include "description/load_description.h"
#include "planting/generate.h"
#include "planting/internal/plants.h"

namespace plotscan::planting {
namespace {

using plotscan::testing::message_of;
using plotscan::testing::TemporaryFolder;
using ::testing::HasSubstr;

// The example's two rows of plots (turned by 30 degrees) with weeds.
farm::Farm weedy(const std::string& weeds, const std::vector<std::string>& overrides = {}) {
  const TemporaryFolder folder;
  const std::string section =
      weeds.empty() ? "" : "weeds: {" + weeds + ", models: [{crop: soybean, name: weed}]}\n";
  return generate(
      description::load_description(
          folder.write("weedy.yaml", testing::example_description() + section), overrides),
      4);
}

std::vector<farm::Plant> weeds_of(const farm::Farm& farm) {
  std::vector<farm::Plant> weeds;
  for (const farm::Plant& plant : farm.plants) {
    if (plant.kind == farm::PlantKind::weed) weeds.push_back(plant);
  }
  return weeds;
}

std::uint32_t plot_at(const farm::Farm& farm, const farm::Plant& plant) {
  for (const farm::Plot& plot : farm.plots) {
    if (plot.box.contains(plant.position.head<2>())) return plot.id;
  }
  return 0;
}

// The rectangle about the example's plots is 5.5 x 7 m; 1 m more on every side.
constexpr double kField_m2 = 7.5 * 9;
constexpr double kPlots_m2 = 5 * 1.5 * 3;

TEST(Weeds, StandInTheWholeField) {
  const farm::Farm farm = weedy("per_m2: 4, scale: [0.3, 0.5]");
  const std::vector<farm::Plant> weeds = weeds_of(farm);
  EXPECT_EQ(weeds.size(), 270u) << "as many as per_m2 says: all of the field lies on the terrain";
  double in_plots = 0;
  for (const farm::Plant& weed : weeds) {
    EXPECT_EQ(weed.plot, plot_at(farm, weed));
    EXPECT_EQ(weed.position.z(), farm.terrain.height(weed.position.x(), weed.position.y()));
    EXPECT_EQ(farm.models[weed.model].name, "weed");
    EXPECT_GE(weed.scale.minCoeff(), 0.3);
    EXPECT_LE(weed.scale.maxCoeff(), 0.5);
    EXPECT_DOUBLE_EQ(weed.height_m, weed.scale.z() * farm.models[weed.model].height_m);
    in_plots += weed.plot > 0 ? 1 : 0;
  }
  const double share = kPlots_m2 / kField_m2;
  EXPECT_NEAR(in_plots, 270 * share, 4 * std::sqrt(270 * share * (1 - share)));
}

// Trials of other headings: the rectangle does not depend on which comes first.
TEST(Weeds, HaveOneFieldInWhicheverOrderTrialsCome) {
  const auto number_of = [](const std::string& trials) {
    const TemporaryFolder folder;
    const auto file = folder.write(
        "two.yaml", "terrain: {side_m: 30}\ntrials:\n" + trials +
                        "weeds: {per_m2: 1, margin_m: 0, models: [{crop: soybean, name: weed}]}\n");
    return weeds_of(generate(description::load_description(file), 4)).size();
  };
  const auto trial = [](const std::string& plots, const std::string& plants) {
    return "  - {plots: " + plots + ", plants: " + plants + "}\n";
  };
  const std::string turned = trial(testing::first_trial(), testing::first_plants());
  const std::string straight = trial(testing::second_trial(), testing::second_plants());
  EXPECT_EQ(number_of(turned + straight), number_of(straight + turned));
}

TEST(Weeds, StandInAlleysOrInPlotsAlone) {
  const double share = kPlots_m2 / kField_m2;
  const double expected = 40 * kField_m2;
  const double deviation = std::sqrt(expected * share * (1 - share));
  const farm::Farm in_alleys = weedy("per_m2: 40, where: alleys");
  EXPECT_NEAR(static_cast<double>(weeds_of(in_alleys).size()), expected * (1 - share),
              4 * deviation);
  for (const farm::Plant& weed : weeds_of(in_alleys)) {
    EXPECT_EQ(weed.plot, 0u);
    EXPECT_EQ(plot_at(in_alleys, weed), 0u);
  }
  const farm::Farm in_plots = weedy("per_m2: 40, where: plots, margin_m: 0");
  const double plots_m2 = kPlots_m2;
  EXPECT_NEAR(static_cast<double>(weeds_of(in_plots).size()), 40 * plots_m2,
              4 * std::sqrt(40 * plots_m2));
  std::uint32_t counted = 0;
  for (const farm::Plot& plot : in_plots.plots) counted += plot.weed_count;
  EXPECT_EQ(counted, weeds_of(in_plots).size());
  for (const farm::Plant& weed : weeds_of(in_plots)) EXPECT_EQ(weed.plot, plot_at(in_plots, weed));
}

TEST(Weeds, LeaveTheCropAsItIs) {
  const farm::Farm without = weedy("");
  const farm::Farm with = weedy("per_m2: 4, scale: [3, 3]");
  ASSERT_GT(with.plants.size(), without.plants.size());
  for (std::size_t i = 0; i < without.plants.size(); ++i) {
    EXPECT_EQ(with.plants[i].id, without.plants[i].id);
    EXPECT_EQ(with.plants[i].position, without.plants[i].position);
    EXPECT_EQ(with.plants[i].rotation.coeffs(), without.plants[i].rotation.coeffs());
    EXPECT_EQ(with.plants[i].scale, without.plants[i].scale);
  }
  for (std::size_t i = 0; i < without.plots.size(); ++i) {
    EXPECT_EQ(with.plots[i].plant_count, without.plots[i].plant_count);
    EXPECT_EQ(with.plots[i].heights.max, without.plots[i].heights.max) << "weeds do not count";
    EXPECT_EQ(with.plots[i].heights.hand3, without.plots[i].heights.hand3);
  }
}

TEST(Weeds, GrowNoneWhereTheTerrainEnds) {
  const farm::Farm farm = weedy("per_m2: 1, margin_m: 100");
  const std::size_t weeds = weeds_of(farm).size();
  EXPECT_NEAR(static_cast<double>(weeds), 400, 4 * std::sqrt(400.0));
}

TEST(Weeds, CannotBeMoreThanAMillion) {
  EXPECT_THAT(message_of<InputError>([] { weedy("per_m2: 1000, margin_m: 500"); }),
              HasSubstr("weedy.yaml: weeds.per_m2 makes 10125"));
}

}  // namespace
}  // namespace plotscan::planting
