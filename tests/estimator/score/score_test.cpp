// SPDX-License-Identifier: Apache-2.0
#include "score/score.h"

#include <cmath>
#include <fstream>
#include <numbers>

#include "temporary_folder.h"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/csv.h"
#include "core/error.h"
#include "core/plot_features.h"
#include "core/random.h"
#include "score/height_score.h"
#include "score/run.h"
#include "score/score_files.h"

namespace plotscan::score {
namespace {

using plotscan::testing::message_of;
using plotscan::testing::TemporaryFolder;
using ::testing::HasSubstr;

PlotBox box_at(double x, double heading_rad = 0) {
  return {.center = {x, 0}, .width_m = 1, .length_m = 4, .heading_rad = heading_rad};
}

TruePlot true_plot(std::uint32_t id, double x, double max_m) {
  return {.id = id,
          .row = 1,
          .column = static_cast<int>(id),
          .box = box_at(x),
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
      .plots = {estimated_plot(1, box_at(5.3, 0.1), 0.75), estimated_plot(2, box_at(0), 0.5),
                estimated_plot(3, box_at(20), 9)}};
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
  EXPECT_THAT(field.extra, ::testing::ElementsAre(3U));
}

TEST(ScoreField, BoxesTogether) {
  const std::vector<FieldScore> fields = {three_plots(), three_plots()};
  const BoxScore boxes = score_boxes(fields);
  const double second_iou = fields[0].plots[1].found->iou;
  EXPECT_EQ(boxes.plots, 6U);
  EXPECT_EQ(boxes.found, 4U);
  EXPECT_EQ(boxes.missed, 2U);
  EXPECT_EQ(boxes.extra, 2U);
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

TEST(ScoreHeight, WhatCannotBeComputedIsNaN) {
  const HeightScore none = score_height("e", "t", {});
  EXPECT_TRUE(std::isnan(none.rmse_m) && std::isnan(none.r2));
  const HeightScore one = score_height("e", "t", {.estimates_m = {1}, .truths_m = {2}});
  EXPECT_DOUBLE_EQ(one.rmse_m, 1);
  EXPECT_TRUE(std::isnan(one.standard_error_m) && std::isnan(one.r2) &&
              std::isnan(one.correlation2));
}

TEST(ScoreHeight, AMissingHeightIsCounted) {
  estimate::Estimate estimate{
      .method = "m",
      .plots = {estimated_plot(1, box_at(0), 0.5), estimated_plot(2, box_at(5), 0.5)}};
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

TEST(ScoreFiles, AFieldComesBackFromJson) {
  const FieldScore field = three_plots();
  const nlohmann::json document = to_json(field);
  const FieldScore again = field_from_json(nlohmann::json::parse(document.dump()));
  EXPECT_EQ(to_json(again), document);
  EXPECT_DOUBLE_EQ(again.plots[1].found->heading_error_rad,
                   field.plots[1].found->heading_error_rad);
  EXPECT_EQ(again.plots[2].truth.heights_m, field.plots[2].truth.heights_m);
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
  EXPECT_THAT(heights, ::testing::ElementsAre("0.5", "0.75", ""));
}

class ScoreRun : public ::testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directories(folder_.path() / "farm" / "truth");
    write_plot_features(folder_.path() / "farm" / "truth" / "plots.geojson",
                        {{box_at(0), {{"plot_number", 4}, {"plants", 90}, {"height_max_m", 0.6}}},
                         {box_at(5), {{"plot_number", 7}, {"plants", 90}, {"height_max_m", 0.8}}}});
    write_plot_features(estimate_, {{box_at(5), {{"plot_number", 1}, {"height_mine_m", 0.9}}}});
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
