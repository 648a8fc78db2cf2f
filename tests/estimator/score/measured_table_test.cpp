// SPDX-License-Identifier: Apache-2.0
#include "score/measured_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "estimator/score/turned_box.h"
#include "score/run.h"
#include "temporary_folder.h"

namespace plotscan::score {
namespace {

using plotscan::testing::message_of;
using plotscan::testing::TemporaryFolder;
using ::testing::AllOf;
using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Pair;

// Plots 1, "A-2" and 3 in a row, each 0.8 m tall; the mean of their plants is 0.1 m less.
estimate::Estimate plots_to_measure() {
  estimate::Estimate estimate{.method = "lattice"};
  for (const PlotId& id : {PlotId(1), PlotId("A-2"), PlotId(3)}) {
    estimate.plots.push_back({.id = id,
                              .box = turned_box(5.0 * static_cast<double>(estimate.plots.size())),
                              .heights_m = {{"max", 0.8}, {"mean", 0.7}}});
    estimate.plots.back().errors["mean"] = {0.02, 0.66, 0.74};
  }
  return estimate;
}

class MeasuredTable : public ::testing::Test {
 protected:
  MeasuredPlots read(const std::string& text) {
    return read_measured(folder_.write("ruler.csv", text), plots_to_measure());
  }
  std::string refusal(const std::string& text) {
    return message_of<InputError>([&] { read(text); });
  }
  TemporaryFolder folder_;
};

TEST_F(MeasuredTable, IsKnownByItsExtensionInAnyCase) {
  for (const char* name : {"a.csv", "A.CSV", "a.Tsv", "a.TXT"})
    EXPECT_TRUE(is_measured_table(name)) << name;
  for (const char* name : {"a.geojson", "a", "farm"}) EXPECT_FALSE(is_measured_table(name)) << name;
}

TEST_F(MeasuredTable, IsMatchedByIdAndCountsInItsUnit) {
  const MeasuredPlots measured = read(
      "plot_id,observer,height_mean_cm,canopy_p95_mm,height_m\nA-2,Ada,71.5,800,0.7\n"
      "3,Bob,,NA,.\n9,Bob,60,,\n");
  EXPECT_EQ(measured.id_column, "plot_id");
  ASSERT_EQ(measured.plots.size(), 3U);
  EXPECT_FALSE(measured.plots[0].scored);
  EXPECT_FALSE(measured.plots[2].scored);  // no height of it was taken
  EXPECT_THAT(measured.plots[1].heights_m,
              ElementsAre(Pair("canopy_p95_m", DoubleNear(0.8, 1e-12)),
                          Pair("height_hand_m", DoubleNear(0.7, 1e-12)),
                          Pair("height_mean_m", DoubleNear(0.715, 1e-12))));
  EXPECT_EQ(measured.plots[1].box.center, plots_to_measure().plots[1].box.center);
  EXPECT_THAT(measured.not_found, ElementsAre(PlotId(9)));
}

TEST_F(MeasuredTable, TakesSemicolonsAndAnIdOfTheUsersChoice) {
  const auto table = folder_.write("ruler.csv", "entry;plot_id;height_max_cm\n3;77;81,25\n");
  const MeasuredPlots measured = read_measured(table, plots_to_measure(), "entry");
  EXPECT_THAT(measured.plots[2].heights_m,
              ElementsAre(Pair("height_max_m", DoubleNear(0.8125, 1e-12))));
}

TEST_F(MeasuredTable, SaysWhatIsWrong) {
  EXPECT_THAT(refusal("plot_id,yield\n3,5\n"),
              AllOf(HasSubstr("no column of heights"), HasSubstr("plot_id, yield")));
  EXPECT_THAT(refusal("plot,height_cm\n3,5\n"), HasSubstr("--id"));
  EXPECT_THAT(refusal("plot_id,height_cm\n3,tall\n"), HasSubstr("height_cm"));
  EXPECT_THAT(refusal("plot_id,height_cm\n3,-99999\n"), HasSubstr("must be -100 to 1000 m"));
  EXPECT_THAT(refusal("plot_id,height_cm\n3,70\n3,71\n"), HasSubstr("names plot 3 again"));
  EXPECT_THAT(refusal("plot_id,height_cm\n,70\n"), HasSubstr("every plot has an id"));
  EXPECT_THAT(refusal("plot_id,height_cm,height_m\n3,70,0.7\n"), HasSubstr("height_hand_m"));
  EXPECT_THAT(refusal("plot_id,height_cm\n3,\n"), HasSubstr("has no height"));
  EXPECT_THAT(refusal("plot_id,height_cm\n301,70\n302,70\n"),
              AllOf(HasSubstr("plot 301 and others"), HasSubstr("--first-number")));
}

TEST_F(MeasuredTable, IsScoredWithoutBoxesAndWithoutExtraPlots) {
  const auto table = folder_.write("ruler.csv", "plot_id,height_mean_cm\n1,68\n3,76\n12,70\n");
  const Scores scores = score_against(table, plots_to_measure(), {});
  EXPECT_EQ(scores.field.plots.size(), 2U);
  EXPECT_THAT(scores.field.extra, IsEmpty());
  EXPECT_THAT(scores.table.value().not_found, ElementsAre(PlotId(12)));
  const nlohmann::json document = to_json(scores);
  EXPECT_TRUE(document["boxes"].is_null());
  EXPECT_EQ(document["table"]["not_found"], nlohmann::json({"12"}));
  // max and mean against the measured mean: errors of mean +2 and -6 cm, one inside its interval.
  ASSERT_EQ(scores.heights.size(), 2U);
  EXPECT_NEAR(scores.heights[1].bias_m, -0.02, 1e-12);
  EXPECT_NEAR(scores.heights[1].rmse_m, std::sqrt(0.002), 1e-12);
  EXPECT_NEAR(scores.heights[1].coverage95, 0.5, 1e-12);
}

}  // namespace
}  // namespace plotscan::score
