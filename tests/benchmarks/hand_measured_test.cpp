// SPDX-License-Identifier: Apache-2.0
#include "strata/hand_measured.h"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>

namespace plotscan::strata {
namespace {

struct Field {
  std::vector<score::TruePlot> truth = {};
  estimate::Estimate estimate = {.method = "lattice"};
};

// Plots of a trial, beside those there are: all 0.8 m in truth, 1 m by the estimate.
void add_trial(int trial, int plots, Field& field) {
  for (int i = 0; i < plots; ++i) {
    const std::size_t number = field.truth.size() + 1;
    const PlotBox box{.center = {3.0 * static_cast<double>(number), 0},
                      .width_m = 1.5,
                      .length_m = 4,
                      .heading_rad = 0};
    field.truth.push_back({.id = number,
                           .trial = trial,
                           .box = box,
                           .heights_m = {{"height_mean_m", 0.8}, {"height_hand3_m", 0.8}}});
    // The estimate numbers its plots in its own way.
    field.estimate.plots.push_back({.id = 1000 - number,
                                    .trial = trial,
                                    .box = box,
                                    .heights_m = {{"mean", 1}},
                                    .errors = {{"mean", {0.1, 0.8, 1.2}}}});
  }
}

std::set<std::size_t> measured(const Field& field) {
  std::set<std::size_t> places;
  for (std::size_t i = 0; i < field.truth.size(); ++i)
    if (!field.truth[i].scored) places.insert(i);
  return places;
}

TEST(AgreeWithHand, SomePlotsOfEachTrialAreMeasuredAndNoLongerScored) {
  Field field;
  add_trial(1, 20, field);
  add_trial(2, 20, field);
  agree_with_hand(6, 0, field.truth, field.estimate);
  const std::set<std::size_t> places = measured(field);
  EXPECT_EQ(std::ranges::count_if(places, [](std::size_t i) { return i < 20; }), 6);
  EXPECT_EQ(places.size(), 12U);
  for (const estimate::PlotEstimate& plot : field.estimate.plots)
    EXPECT_NEAR(plot.heights_m.at("mean"), 0.8, 0.01);
}

TEST(AgreeWithHand, OtherFieldsHaveOtherPlotsMeasured) {
  std::set<std::set<std::size_t>> choices;
  std::set<std::size_t> all;
  for (int index = 0; index < 40; ++index) {
    Field field;
    add_trial(0, 12, field);
    agree_with_hand(5, index, field.truth, field.estimate);
    choices.insert(measured(field));
    all.merge(measured(field));
  }
  EXPECT_GT(choices.size(), 30U);
  EXPECT_EQ(all.size(), 12U) << "every plot may be drawn";
}

// Nothing would be left to score. Plots that are not found can't be told from the estimate.
TEST(AgreeWithHand, SmallTrialsStayAsTheyAre) {
  Field field;
  add_trial(1, 6, field);
  add_trial(2, 9, field);
  for (std::size_t i = 6; i < 10; ++i) field.estimate.plots.at(i).box.center.y() += 100;
  agree_with_hand(6, 0, field.truth, field.estimate);
  EXPECT_TRUE(measured(field).empty());
  for (const estimate::PlotEstimate& plot : field.estimate.plots)
    EXPECT_EQ(plot.heights_m.at("mean"), 1);
}

}  // namespace
}  // namespace plotscan::strata
