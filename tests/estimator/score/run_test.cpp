// SPDX-License-Identifier: Apache-2.0
// `estimator score`: files in, files out.
#include "score/run.h"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/plot_features.h"
#include "estimator/score/turned_box.h"
#include "score/score_files.h"
#include "temporary_folder.h"

namespace plotscan::score {
namespace {

using plotscan::testing::message_of;
using plotscan::testing::TemporaryFolder;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class ScoreRun : public ::testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directories(folder_.path() / "farm" / "truth");
    write_plot_features(
        folder_.path() / "farm" / "truth" / "plots.geojson",
        {{turned_box(0), {{"plot_number", 4}, {"plants", 90}, {"height_max_m", 0.6}}},
         {turned_box(5), {{"plot_number", 7}, {"plants", 90}, {"height_max_m", 0.8}}}});
    write_plot_features(estimate_, {{turned_box(5), {{"plot_number", 1}, {"height_mine_m", 0.9}}}});
  }

  TemporaryFolder folder_;
  std::filesystem::path estimate_ = folder_.path() / "anyones.geojson";
};

TEST_F(ScoreRun, ReadsAnyonesEstimateAndWritesTheScores) {
  const Scores scores = run({.estimate = estimate_,
                             .truth = folder_.path() / "farm",
                             .output = folder_.path() / "scores"});
  EXPECT_EQ(scores.boxes.found, 1U);
  EXPECT_EQ(scores.boxes.missed, 1U);
  ASSERT_EQ(scores.heights.size(), 1U);  // plants is no height
  EXPECT_EQ(scores.heights[0].height, "mine");
  EXPECT_NEAR(scores.heights[0].bias_m, 0.1, 1e-12);
  EXPECT_EQ(scores.field.plots[1].truth.id, 7U);
  const auto document = nlohmann::json::parse(read_text(folder_.path() / "scores" / "scores.json"));
  EXPECT_EQ(document["boxes"]["missed"], 1);
  EXPECT_NEAR(document["heights"][0]["rmse_m"].get<double>(), 0.1, 1e-12);
  EXPECT_TRUE(document["heights"][0]["r2"].is_null());
  EXPECT_TRUE(std::filesystem::exists(folder_.path() / "scores" / "manifest.json"));
}

TEST_F(ScoreRun, TakesTruthsOfTheCanopy) {
  const std::filesystem::path truth = folder_.path() / "canopy.geojson";
  write_plot_features(truth, {{turned_box(5), {{"canopy_p95_m", 0.7}, {"height_max_m", 0.8}}}});
  const Scores scores = run({.estimate = estimate_, .truth = truth});
  ASSERT_EQ(scores.heights.size(), 2U);
  EXPECT_EQ(scores.heights[0].truth, "canopy_p95_m");
  EXPECT_NEAR(scores.heights[0].bias_m, 0.2, 1e-12);
}

TEST_F(ScoreRun, SaysWhyThereIsNothingToCompare) {
  const auto notes_for = [&](double x, const nlohmann::json& properties) {
    const std::filesystem::path truth = folder_.path() / "truth.geojson";
    write_plot_features(truth, {{turned_box(x), properties}});
    return run({.estimate = estimate_, .truth = truth}).notes;
  };
  EXPECT_THAT(notes_for(5, {{"height_max_m", 0.7}}), IsEmpty());
  EXPECT_THAT(notes_for(20, {{"height_max_m", 0.7}}), ElementsAre(HasSubstr("same coordinates?")));
  EXPECT_THAT(notes_for(5, {{"height_max_m", "0.7"}}), ElementsAre(HasSubstr("no true plot has")));
}

TEST_F(ScoreRun, SaysWhyAnEstimateHasNoPlots) {
  const std::vector<TruePlot> truth = read_truth(folder_.path() / "farm");
  estimate::Estimate none{.method = "m"};
  EXPECT_THAT(score(truth, none, {}).notes, IsEmpty());
  none.diagnostics.why_no_plots = "no canopy";
  EXPECT_THAT(score(truth, none, {}).notes, ElementsAre("The estimate has no plots: no canopy"));
}

TEST_F(ScoreRun, RefusesATruthThatHasAPlotTwice) {
  const auto truth_with = [&](int id, double x) {
    const std::filesystem::path truth = folder_.path() / "truth.geojson";
    write_plot_features(truth, {{turned_box(0), {{"plot_number", 4}}},
                                {turned_box(5), {{"plot_number", 7}}},
                                {turned_box(x), {{"plot_number", id}}}});
    return truth;
  };
  const auto message_for = [&](int id, double x) {
    return message_of<InputError>([&] { read_truth(truth_with(id, x)); });
  };
  EXPECT_THAT(message_for(4, 10), HasSubstr("truth.geojson: has two plots with the id 4"));
  EXPECT_THAT(message_for(8, 5.1), HasSubstr("has plots 7 and 8 at the same place"));
  EXPECT_EQ(read_truth(truth_with(8, 10)).size(), 3U);
}

TEST_F(ScoreRun, RefusesHeightsThatStandForNone) {
  for (const double height_m : {-9999.0, 1e30}) {
    write_plot_features(estimate_,
                        {{turned_box(5), {{"plot_number", 3}, {"height_p95_m", height_m}}}});
    EXPECT_THAT(message_of<InputError>([&] { read_truth(estimate_); }),
                HasSubstr("anyones.geojson: plot 3: height_p95_m is "));
    EXPECT_THAT(message_of<InputError>(
                    [&] { run({.estimate = estimate_, .truth = folder_.path() / "farm"}); }),
                HasSubstr("it must be metres, -100 to 1000"));
  }
}

TEST_F(ScoreRun, BadInputLeavesNothingBehind) {
  const std::filesystem::path scores = folder_.path() / "scores";
  EXPECT_THAT(message_of<InputError>(
                  [&] { run({.estimate = estimate_, .truth = folder_.path(), .output = scores}); }),
              HasSubstr("plots.geojson: no such file"));
  EXPECT_THAT(message_of<InputError>([&] {
                run({.estimate = estimate_,
                     .truth = folder_.path() / "farm",
                     .output = scores,
                     .score = {.min_iou = 2}});
              }),
              HasSubstr("at most 1"));
  EXPECT_FALSE(std::filesystem::exists(scores));
}

}  // namespace
}  // namespace plotscan::score
