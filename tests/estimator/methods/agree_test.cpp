// SPDX-License-Identifier: Apache-2.0
#include "methods/agree.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "temporary_folder.h"

namespace plotscan::methods {
namespace {

using estimate::Estimate;
using estimate::MeasuredHeights;
using plotscan::testing::message_of;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

// Plots 1 to `count` of a trial, each 0.8 m in its mean and 1 m in its greatest height.
void add_plots(int trial, std::uint64_t count, Estimate& estimate) {
  for (std::uint64_t i = 0; i < count; ++i) {
    estimate.plots.push_back({.id = estimate.plots.size() + 1,
                              .trial = trial,
                              .box = {},
                              .heights_m = {{"mean", 0.8}, {"max", 1}, {"raw-p99", 0.9}},
                              .errors = {{"mean", {0.1, 0.6, 1}}, {"max", {0.1, 0.8, 1.2}}}});
  }
}

MeasuredHeights measured_in(std::uint64_t first, std::uint64_t last, const std::string& property,
                            double height_m) {
  MeasuredHeights measured{.file = "ruler.csv", .id_column = "plot_number"};
  for (std::uint64_t id = first; id <= last; ++id) measured.plots_m[id][property] = height_m;
  return measured;
}

std::string refusal(const MeasuredHeights& measured, Estimate estimate) {
  return message_of<InputError>([&] { agree_with(measured, estimate); });
}

TEST(Agree, ScalesTheMeasuredHeightOfEveryPlotAndNoOther) {
  Estimate estimate{.method = "lattice"};
  add_plots(0, 20, estimate);
  agree_with(measured_in(15, 24, "height_mean_m", 0.72), estimate);
  for (const estimate::PlotEstimate& plot : estimate.plots) {
    EXPECT_NEAR(plot.heights_m.at("mean"), 0.72, 0.003);
    EXPECT_LT(plot.errors.at("mean").high95_m - plot.errors.at("mean").low95_m, 0.2);
    EXPECT_EQ(plot.heights_m.at("max"), 1);
    EXPECT_EQ(plot.errors.at("max").low95_m, 0.8);
  }
  const estimate::GivenMeasured given = estimate.diagnostics.measured.value();
  EXPECT_THAT(given.not_found, ElementsAre(PlotId(21), PlotId(22), PlotId(23), PlotId(24)));
  ASSERT_EQ(given.heights.size(), 1U);
  EXPECT_EQ(given.heights[0].plots, 6U);
  EXPECT_NEAR(given.heights[0].factor, 0.9, 0.004);
  EXPECT_EQ(to_json(estimate.diagnostics)["measured"]["heights"][0]["height"], "mean");
}

// 80 and 85 cm as millimetres, a digit too many, and metres.
TEST(Agree, RefusesHeightsThatCanNotBeThePlots) {
  Estimate estimate{.method = "lattice"};
  add_plots(0, 20, estimate);
  for (estimate::PlotEstimate& plot : estimate.plots) plot.errors["mean"] = {0.03, 0.74, 0.86};
  EXPECT_THAT(refusal(measured_in(1, 9, "height_mean_m", 0.08), estimate),
              HasSubstr("ruler.csv: plot 1 has mean 0.08 m, and 0.800 m by the cloud"));
  MeasuredHeights typed = measured_in(1, 9, "height_mean_m", 0.85);
  typed.plots_m[4]["height_mean_m"] = 8.5;
  EXPECT_THAT(refusal(typed, estimate), HasSubstr("plot 4 has mean 8.5 m"));
  EXPECT_THAT(refusal(measured_in(1, 9, "height_mean_m", 80), estimate), HasSubstr("mistyped"));
  for (estimate::PlotEstimate& plot : estimate.plots) plot.errors["mean"] = {0.2, 0.4, 1.2};
  EXPECT_NO_THROW(agree_with(measured_in(1, 9, "height_mean_m", 0.35), estimate));
}

// The flag of unsure heights is that of the new errors.
TEST(Agree, FlagsAreThoseOfTheNewErrors) {
  Estimate estimate{.method = "lattice"};
  add_plots(0, 20, estimate);
  for (estimate::PlotEstimate& plot : estimate.plots)
    plot.flags = {"too few returns", "mean height is unsure by centimetres",
                  "p50 height is unsure by centimetres"};
  for (estimate::PlotEstimate& plot : estimate.plots) plot.errors["mean"] = {0.03, 0.74, 0.86};
  Estimate scattered = estimate;
  agree_with(measured_in(1, 12, "height_mean_m", 0.8), estimate);
  EXPECT_LT(estimate.plots[0].errors.at("mean").standard_error_m, 0.025);
  EXPECT_THAT(estimate.plots[0].flags,
              ElementsAre("too few returns", "p50 height is unsure by centimetres"));
  MeasuredHeights uneven = measured_in(1, 12, "height_mean_m", 0.6);
  for (std::uint64_t id = 1; id <= 6; ++id) uneven.plots_m[id]["height_mean_m"] = 1;
  agree_with(uneven, scattered);
  EXPECT_THAT(scattered.plots[0].flags,
              ElementsAre("too few returns", "p50 height is unsure by centimetres",
                          "mean height is unsure by centimetres"));
}

TEST(Agree, FlagsHeightsThatAreOutOfOrderThen) {
  Estimate estimate{.method = "lattice"};
  add_plots(0, 8, estimate);
  Estimate higher = estimate;
  agree_with(measured_in(1, 8, "height_mean_m", 0.9), estimate);
  EXPECT_THAT(estimate.plots[0].flags, Not(Contains(HasSubstr("out of order"))));
  agree_with(measured_in(1, 8, "height_mean_m", 1.2), higher);
  EXPECT_GT(higher.plots[0].heights_m.at("mean"), 1);
  EXPECT_THAT(higher.plots[0].flags, Contains(HasSubstr("out of order")));
}

// Another trial has another crop, whose error is another one.
TEST(Agree, LeavesTrialsAloneOfWhichTooFewPlotsWereMeasured) {
  Estimate estimate{.method = "lattice"};
  add_plots(1, 8, estimate);
  add_plots(2, 8, estimate);
  agree_with(measured_in(1, 10, "height_max_m", 1.1), estimate);
  EXPECT_NEAR(estimate.plots[7].heights_m.at("max"), 1.1, 0.01);
  EXPECT_EQ(estimate.plots[8].heights_m.at("max"), 1);
  EXPECT_EQ(estimate.diagnostics.measured.value().heights[0].trial, 1);
}

TEST(Agree, SaysWhatATableLacks) {
  Estimate estimate{.method = "lattice"};
  add_plots(0, 20, estimate);
  EXPECT_THAT(refusal(measured_in(1, 4, "height_mean_m", 0.7), estimate), HasSubstr("at least 5"));
  EXPECT_THAT(refusal(measured_in(1, 9, "height_hand_m", 0.7), estimate),
              ::testing::AllOf(HasSubstr("does not say which height"),
                               HasSubstr("such as height_mean_cm")));
  EXPECT_THAT(refusal(measured_in(1, 9, "height_raw-p99_m", 0.7), estimate),
              HasSubstr("with a standard error: max, mean"));
  EXPECT_THAT(refusal(measured_in(301, 309, "height_mean_m", 0.7), estimate),
              HasSubstr("ruler.csv: has plot 301 and others"));
}

}  // namespace
}  // namespace plotscan::methods
