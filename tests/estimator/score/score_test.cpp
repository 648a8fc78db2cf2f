// SPDX-License-Identifier: Apache-2.0
#include "score/score.h"

#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/csv.h"
#include "core/random.h"
#include "estimator/score/turned_box.h"
#include "score/height_score.h"
#include "score/score_files.h"
#include "temporary_folder.h"

namespace plotscan::score {
namespace {

using plotscan::testing::TemporaryFolder;
using ::testing::ElementsAre;

TruePlot true_plot(std::uint32_t id, double x, double max_m) {
  return {.id = id,
          .row = 1,
          .column = static_cast<int>(id),
          .box = turned_box(x),
          .heights_m = {{"height_max_m", max_m}, {"height_mean_m", max_m / 2}}};
}

estimate::PlotEstimate estimated_plot(std::uint32_t id, const PlotBox& box, double height_m) {
  return {.id = id, .box = box, .heights_m = {{"raw-p99", height_m}}};
}

// Three true plots 5 m apart; the first found exactly, the second shifted and turned, the third
// missed; one estimate where no plot is.
FieldScore three_plots() {
  const estimate::Estimate estimate{
      .method = "m",
      .plots = {estimated_plot(1, turned_box(5.3, 0.1), 0.75),
                estimated_plot(2, turned_box(0), 0.5), estimated_plot(3, turned_box(20), 9)}};
  return score_field({true_plot(1, 0, 0.6), true_plot(2, 5, 0.8), true_plot(3, 10, 1.0)}, estimate);
}

// Errors that random numbers give, with textbook two-pass formulae as the oracle.
HeightPairs random_pairs(std::size_t count) {
  RandomStream random(3, random_purpose("test/pairs"), count);
  HeightPairs pairs;
  for (std::size_t i = 0; i < count; ++i) {
    pairs.truths_m.push_back(random.uniform(0.3, 1.2));
    pairs.estimates_m.push_back(0.9 * pairs.truths_m.back() + 0.04 + 0.05 * random.normal());
  }
  return pairs;
}

TEST(ScoreField, SaysWhichPlotsWereFoundAndHowWell) {
  const FieldScore field = three_plots();
  ASSERT_TRUE(field.plots[0].found && field.plots[1].found);
  EXPECT_FALSE(field.plots[2].found);
  EXPECT_EQ(field.plots[0].found->estimate, 2U);
  EXPECT_DOUBLE_EQ(field.plots[0].found->iou, 1);
  EXPECT_DOUBLE_EQ(field.plots[0].found->center_error_m, 0);
  EXPECT_NEAR(field.plots[1].found->center_error_m, 0.3, 1e-12);
  EXPECT_NEAR(field.plots[1].found->heading_error_rad, 0.1, 1e-12);
  EXPECT_THAT(field.extra, ElementsAre(3U));
}

TEST(ScoreField, BoxesTogether) {
  const std::vector<FieldScore> fields = {three_plots(), three_plots()};
  const BoxScore boxes = score_boxes(fields);
  const double second_iou = fields[0].plots[1].found->iou;
  EXPECT_EQ(boxes.plots, 6U);
  EXPECT_EQ(boxes.found, 4U);
  EXPECT_EQ(boxes.missed, 2U);
  EXPECT_EQ(boxes.extra, 2U);
  EXPECT_DOUBLE_EQ(boxes.recall, 4.0 / 6);
  EXPECT_DOUBLE_EQ(boxes.precision, 4.0 / 6);
  EXPECT_DOUBLE_EQ(boxes.iou_mean, (1 + second_iou) / 2);
  EXPECT_DOUBLE_EQ(boxes.iou_min, second_iou);
  EXPECT_DOUBLE_EQ(boxes.iou_median, (1 + second_iou) / 2);
  EXPECT_NEAR(boxes.center_rmse_m, 0.3 / std::sqrt(2), 1e-12);
  EXPECT_NEAR(boxes.heading_rmse_rad, 0.1 / std::sqrt(2), 1e-12);
}

TEST(ScoreField, NothingFoundHasNoOverlap) {
  const FieldScore field = score_field({true_plot(1, 0, 1)}, {.method = "m", .plots = {}});
  const BoxScore boxes = score_boxes({&field, 1});
  EXPECT_EQ(boxes.missed, 1U);
  EXPECT_TRUE(std::isnan(boxes.iou_median));
  EXPECT_TRUE(std::isnan(boxes.center_rmse_m));
}

TEST(ScoreHeight, ByHand) {
  // Errors -0.1 and -0.05 on truths 0.6 and 0.8.
  const HeightScore score = score_height("raw-p99", "height_max_m",
                                         height_pairs(three_plots(), "raw-p99", "height_max_m"));
  EXPECT_EQ(score.plots, 2U);
  EXPECT_EQ(score.without, 0U);
  EXPECT_NEAR(score.rmse_m, std::sqrt((0.01 + 0.0025) / 2), 1e-12);
  EXPECT_NEAR(score.bias_m, -0.075, 1e-12);
  EXPECT_NEAR(score.mae_m, 0.075, 1e-12);
  EXPECT_NEAR(score.standard_error_m, 0.025, 1e-12);  // sqrt((2 * 0.025^2) / 1 / 2)
  EXPECT_NEAR(score.r2, 1 - 0.0125 / 0.02, 1e-12);
  EXPECT_NEAR(score.correlation2, 1, 1e-12);
}

TEST(ScoreHeight, AgreesWithTheTextbook) {
  const HeightPairs pairs = random_pairs(200);
  const HeightScore score = score_height("e", "t", pairs);
  double sum_e = 0, sum_e2 = 0, sum_abs = 0, sum_x = 0, sum_y = 0, sum_xx = 0, sum_yy = 0,
         sum_xy = 0;
  for (std::size_t i = 0; i < 200; ++i) {
    const double y = pairs.estimates_m[i], x = pairs.truths_m[i], e = y - x;
    sum_e += e, sum_e2 += e * e, sum_abs += std::abs(e), sum_x += x, sum_y += y;
    sum_xx += x * x, sum_yy += y * y, sum_xy += x * y;
  }
  const double n = 200;
  const double sst = sum_xx - sum_x * sum_x / n;
  EXPECT_NEAR(score.rmse_m, std::sqrt(sum_e2 / n), 1e-12);
  EXPECT_NEAR(score.bias_m, sum_e / n, 1e-12);
  EXPECT_NEAR(score.mae_m, sum_abs / n, 1e-12);
  EXPECT_NEAR(score.standard_error_m, std::sqrt((sum_e2 - sum_e * sum_e / n) / (n - 1) / n), 1e-12);
  EXPECT_NEAR(score.r2, 1 - sum_e2 / sst, 1e-10);
  EXPECT_NEAR(score.correlation2,
              std::pow(n * sum_xy - sum_x * sum_y, 2) /
                  ((n * sum_xx - sum_x * sum_x) * (n * sum_yy - sum_y * sum_y)),
              1e-10);
}

// Four plots in a row, as an estimate that knows its errors says them: inside its interval, outside
// it with a flag, outside it without one, and without an interval.
FieldScore four_plots_with_intervals() {
  std::vector<TruePlot> truth;
  estimate::Estimate estimate{.method = "m"};
  const double errors_m[] = {0.01, 0.08, -0.06, 0.04};
  for (std::uint32_t i = 0; i < 4; ++i) {
    truth.push_back(true_plot(i + 1, 3.0 * i, 1));
    estimate.plots.push_back({.id = i + 1,
                              .box = turned_box(3.0 * i),
                              .heights_m = {{"max", 1 + errors_m[i]}, {"raw-p99", 1}},
                              .confidence = 0.5});
    const double height_m = 1 + errors_m[i];
    if (i < 3) {
      estimate.plots[i].errors["max"] = {
          .standard_error_m = 0.01, .low95_m = height_m - 0.02, .high95_m = height_m + 0.02};
    }
  }
  estimate.plots[1].flags = {"few returns, far away", "cut"};
  return score_field(truth, estimate);
}

TEST(Trust, CountsWhatTheIntervalsAndFlagsSay) {
  const FieldScore field = four_plots_with_intervals();
  HeightPairs pairs = height_pairs(field, "max", "height_max_m");
  EXPECT_EQ(pairs.trust.intervals, 3U);
  EXPECT_EQ(pairs.trust.covered, 1U);
  EXPECT_EQ(pairs.trust.flagged, 1U);
  EXPECT_EQ(pairs.trust.large_unflagged, 1U);
  append(pairs, height_pairs(field, "max", "height_max_m"));
  const HeightScore score = score_height("max", "height_max_m", pairs);
  EXPECT_EQ(score.plots, 8U);
  EXPECT_DOUBLE_EQ(score.coverage95, 1.0 / 3);
  EXPECT_EQ(score.flagged, 2U);
  EXPECT_EQ(score.large_unflagged, 2U);
  EXPECT_DOUBLE_EQ(score.large_unflagged_share, 0.25);
}

// Errors of the greatest heights stay visible where only the mean is unsure.
TEST(Trust, AFlagCountsForTheHeightsThatItConcerns) {
  FieldScore field = four_plots_with_intervals();
  for (PlotScore& plot : field.plots) {
    plot.found->flags = {"mean height is unsure by centimetres"};
    plot.found->heights_m["mean"] = 1;  // the truths are 0.5
  }
  EXPECT_EQ(height_pairs(field, "max", "height_max_m").trust.flagged, 0U);
  EXPECT_EQ(height_pairs(field, "max", "height_max_m").trust.large_unflagged, 2U);
  EXPECT_EQ(height_pairs(field, "mean", "height_mean_m").trust.flagged, 4U);
  EXPECT_EQ(height_pairs(field, "mean", "height_mean_m").trust.large_unflagged, 0U);
  field.plots[1].found->flags.emplace_back("p95 height is unsure by centimetres");
  EXPECT_EQ(height_pairs(field, "max", "height_max_m").trust.flagged, 0U);
  field.plots[1].found->flags.emplace_back("max height is unsure by centimetres");
  EXPECT_EQ(height_pairs(field, "max", "height_max_m").trust.flagged, 1U);
  field.plots[1].found->flags = {"cut"};
  EXPECT_EQ(height_pairs(field, "max", "height_max_m").trust.flagged, 1U);
}

// The interval of "max" says nothing of the mean plant.
TEST(Trust, IntervalsCountForTheTruthThatTheHeightIsNamedAfter) {
  const FieldScore field = four_plots_with_intervals();
  EXPECT_EQ(height_pairs(field, "max", "height_mean_m").trust.intervals, 0U);
  EXPECT_TRUE(
      std::isnan(score_height("max", "height_mean_m", height_pairs(field, "max", "height_mean_m"))
                     .coverage95));
  EXPECT_EQ(named_truth("p95"), "height_p95_m");
  EXPECT_EQ(named_truth("canopy_p95"), "canopy_p95_m");
  EXPECT_THAT(heights_beside("height_max_m", {"max", "mean"}), ElementsAre("max"));
  EXPECT_THAT(heights_beside("height_hand3_m", {"max", "mean"}), ElementsAre("mean"));
  EXPECT_THAT(heights_beside("height_max_m", {"raw-max", "raw-p99"}),
              ElementsAre("raw-max", "raw-p99"));
}

TEST(ScoreField, WhatIsSaidOfAnUnscoredPlotDoesNotCount) {
  std::vector<TruePlot> truth = {true_plot(1, 0, 0.6), true_plot(2, 5, 0.8), true_plot(3, 10, 1)};
  truth[1].scored = truth[2].scored = false;
  PlotBox cut = turned_box(10);  // a third of the plot: too little for a pair
  cut.length_m = 1.3;
  cut.center.x() = 9;
  const estimate::Estimate estimate{
      .method = "m",
      .plots = {estimated_plot(1, turned_box(0), 0.5), estimated_plot(2, turned_box(5), 0.5),
                estimated_plot(3, cut, 0.5), estimated_plot(4, turned_box(30), 0.5)}};
  const FieldScore field = score_field(truth, estimate);
  ASSERT_EQ(field.plots.size(), 1U);
  EXPECT_EQ(field.plots[0].truth.id, 1U);
  EXPECT_THAT(field.extra, ElementsAre(4U));
}

TEST(ScoreHeight, WhatCannotBeComputedIsNaN) {
  const HeightScore none = score_height("e", "t", {});
  EXPECT_TRUE(std::isnan(none.rmse_m) && std::isnan(none.r2));
  const HeightScore one = score_height("e", "t", {.estimates_m = {1}, .truths_m = {2}});
  EXPECT_DOUBLE_EQ(one.rmse_m, 1);
  EXPECT_TRUE(std::isnan(one.standard_error_m) && std::isnan(one.r2) &&
              std::isnan(one.correlation2));
  // The mean of three times 0.1 is not 0.1.
  const HeightScore equal =
      score_height("e", "t", {.estimates_m = {0.1, 0.2, 0.3}, .truths_m = {0.1, 0.1, 0.1}});
  EXPECT_TRUE(std::isnan(equal.r2) && std::isnan(equal.correlation2)) << equal.r2;
}

TEST(ScoreHeight, AMissingHeightIsCounted) {
  estimate::Estimate estimate{
      .method = "m",
      .plots = {estimated_plot(1, turned_box(0), 0.5), estimated_plot(2, turned_box(5), 0.5)}};
  estimate.plots[1].heights_m.clear();
  const FieldScore field = score_field({true_plot(1, 0, 0.6), true_plot(2, 5, 0.8)}, estimate);
  const auto scores = score_heights(field);
  ASSERT_EQ(scores.size(), 2U);  // one height against two truths
  EXPECT_EQ(scores[0].truth, "height_max_m");
  EXPECT_EQ(scores[1].truth, "height_mean_m");
  for (const HeightScore& score : scores) {
    EXPECT_EQ(score.plots, 1U);
    EXPECT_EQ(score.without, 1U);
  }
}

TEST(ScoreHeight, EachTrialHasScoresOfItsOwn) {
  FieldScore field = three_plots();
  EXPECT_TRUE(score_trials(field).empty());
  field.plots[0].truth.trial = field.plots[2].truth.trial = 1;
  field.plots[1].truth.trial = 3;
  const std::vector<TrialScore> trials = score_trials(field);
  ASSERT_EQ(trials.size(), 2U);
  EXPECT_EQ(trials[0].trial, 1);
  EXPECT_EQ(trials[0].plots, 2U);
  EXPECT_EQ(trials[0].found, 1U);
  EXPECT_EQ(trials[0].heights[0].truth, "height_max_m");
  EXPECT_NEAR(trials[0].heights[0].bias_m, 0.5 - 0.6, 1e-12);
  EXPECT_EQ(trials[1].trial, 3);
  EXPECT_NEAR(trials[1].heights[0].bias_m, 0.75 - 0.8, 1e-12);
  const nlohmann::json written = trials[0];
  EXPECT_EQ(written["trial_number"], 1);
  EXPECT_EQ(written["heights"][1]["truth"], "height_mean_m");
}

TEST(ScoreFiles, AFieldComesBackFromJson) {
  const FieldScore field = three_plots();
  const nlohmann::json document = field;
  const FieldScore again = nlohmann::json::parse(document.dump());
  EXPECT_EQ(nlohmann::json(again), document);
  EXPECT_DOUBLE_EQ(again.plots[1].found->heading_error_rad,
                   field.plots[1].found->heading_error_rad);
  EXPECT_EQ(again.plots[2].truth.heights_m, field.plots[2].truth.heights_m);
}

TEST(ScoreFiles, IntervalsConfidenceAndFlagsComeBack) {
  const FieldScore field = four_plots_with_intervals();
  const nlohmann::json document = field;
  const FieldScore again = nlohmann::json::parse(document.dump());
  EXPECT_EQ(nlohmann::json(again), document);
  EXPECT_EQ(again.plots[1].found->flags, field.plots[1].found->flags);
  EXPECT_EQ(again.plots[0].found->confidence, 0.5);
  EXPECT_EQ(again.plots[2].found->errors.at("max").high95_m,
            field.plots[2].found->errors.at("max").high95_m);
  const TemporaryFolder folder;
  write_plot_table(folder.path() / "plots.csv", field);
  const CsvTable table = read_csv_table(folder.path() / "plots.csv");
  std::vector<std::string> rows;
  for (const CsvTable::Line& line : table.lines) {
    std::string text;
    for (std::size_t i = 0; i < line.fields.size(); ++i) {
      const std::string& column = table.columns[i];
      if (column == "low95_height_max_m" || column == "high95_height_max_m" ||
          column == "confidence" || column == "flags")
        text += line.fields[i] + "|";
    }
    rows.push_back(text);
  }
  EXPECT_THAT(rows, ElementsAre("0.99|1.03|0.5||", "1.06|1.1|0.5|few returns, far away;cut|",
                                "0.9199999999999999|0.96|0.5||", "||0.5||"));
}

TEST(ScoreFiles, OneRowAPlot) {
  const TemporaryFolder folder;
  write_plot_table(folder.path() / "plots.csv", three_plots());
  std::vector<std::string> heights;
  read_csv(folder.path() / "plots.csv",
           {"plot_number", "found", "iou", "estimated_height_raw-p99_m"},
           {"row_number", "col_number", "estimate", "center_error_m", "heading_error_deg",
            "true_height_max_m", "true_height_mean_m"},
           [&](const CsvRow& row) {
             heights.emplace_back(row.text(3));
             EXPECT_EQ(row.integer(0, 1, 3), static_cast<long long>(heights.size()));
           });
  EXPECT_THAT(heights, ElementsAre("0.5", "0.75", ""));
}

TEST(ScoreFiles, TellTheTrialsOfAFieldThatHasSeveral) {
  FieldScore field = three_plots();
  EXPECT_FALSE(nlohmann::json(field)["plots"][0].contains("trial_number"));
  for (PlotScore& plot : field.plots) plot.truth.trial = 2;
  EXPECT_EQ(nlohmann::json(field).get<FieldScore>().plots[1].truth.trial, 2);
  const TemporaryFolder folder;
  write_plot_table(folder.path() / "plots.csv", field);
  const CsvTable table = read_csv_table(folder.path() / "plots.csv");
  EXPECT_EQ(table.columns[1], "trial_number");
  EXPECT_EQ(table.lines[0].fields[1], "2");
}

}  // namespace
}  // namespace plotscan::score
