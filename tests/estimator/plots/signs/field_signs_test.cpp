// SPDX-License-Identifier: Apache-2.0
#include "plots/signs/field_signs.h"

#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/random.h"
#include "estimator/plots/trial_cloud.h"
#include "plots/search/find_trials.h"

namespace plotscan::plots {
namespace {

// Height of what stands at a place from the middle of its lattice cell; 0 for ground.
using Standing = std::function<double(double x, double y, RandomStream& random)>;

// The same thing on every place of a lattice of 5 x 5 m steps, turned by 20 degrees, on 30 x 30 m.
// What stands farther than half_m along the lattice's second axis is cut off.
PlotField field_of(const Standing& standing, double step_x_m = 5, double step_y_m = 5,
                   double half_m = 11, const Hints& hints = {}) {
  constexpr double kTurn_rad = 0.35, kHalf_m = 15, kScatter_m = 0.02;
  std::vector<Eigen::Vector3f> points;
  for (std::uint64_t i = 0; i < 300000; ++i) {
    RandomStream random(3, random_purpose("test/signs"), i);
    const double x = random.uniform(-kHalf_m, kHalf_m), y = random.uniform(-kHalf_m, kHalf_m);
    const double a = std::cos(kTurn_rad) * x + std::sin(kTurn_rad) * y;
    const double b = -std::sin(kTurn_rad) * x + std::cos(kTurn_rad) * y;
    const bool in_field = std::abs(a) < 11 && std::abs(b) < half_m;
    const double height =
        in_field ? standing(std::remainder(a, step_x_m), std::remainder(b, step_y_m), random) : 0;
    points.emplace_back(static_cast<float>(x), static_cast<float>(y),
                        static_cast<float>(height + kScatter_m * random.normal()));
  }
  return find_plots(points, kScatter_m, hints, 2);
}

std::string why_none_of(const Standing& standing, double step_x_m = 5, double step_y_m = 5) {
  return field_of(standing, step_x_m, step_y_m).why_none;
}

bool in_box(double x, double y, double width_m, double length_m) {
  return std::abs(x) < width_m / 2 && std::abs(y) < length_m / 2;
}

const Standing kPlots = [](double x, double y, RandomStream& random) {
  return in_box(x, y, 2, 4) ? random.uniform(0, 1) : 0;
};

// What the others are held against: the same lattice, with canopy in boxes.
TEST(FieldSigns, LetPlotsBePlots) {
  const PlotField field = field_of(kPlots, 5, 5, 12);
  EXPECT_EQ(field.why_none, "");
  EXPECT_EQ(field.plots.size(), 25u);
}

TEST(FieldSigns, TellCrowns) {
  EXPECT_THAT(why_none_of([](double x, double y, RandomStream& random) {
                return std::hypot(x, y) < 1.6 ? random.uniform(0, 3) : 0;
              }),
              ::testing::HasSubstr("round crowns"));
}

// What is told is not refused; that it would be is said.
TEST(FieldSigns, DoubtWhatIsTold) {
  const Standing crowns = [](double x, double y, RandomStream& random) {
    return std::hypot(x, y) < 1.6 ? random.uniform(0, 3) : 0;
  };
  const PlotField told = field_of(crowns, 5, 5, 12, {.width_m = 3, .length_m = 3});
  EXPECT_FALSE(told.plots.empty());
  EXPECT_THAT(told.doubt, ::testing::HasSubstr("round crowns"));
  EXPECT_EQ(field_of(kPlots, 5, 5, 12, {.width_m = 2, .length_m = 4}).doubt, "");
}

TEST(FieldSigns, TellRoofs) {
  EXPECT_NE(
      why_none_of([](double x, double y, RandomStream&) { return in_box(x, y, 2, 4) ? 1.4 : 0; }),
      "");
}

TEST(FieldSigns, TellTables) {
  EXPECT_THAT(why_none_of([](double x, double y,
                             RandomStream&) { return in_box(x, y, 0.7, 1.5) ? 0.75 : 0; },
                          2, 2.5),
              ::testing::HasSubstr("smooth"));
}

// Heights drawn evenly from 0 to 1 m: the upper half of 0 to 0.95 m, the 95th percentile, is even
// from 0.475 to 1 m.
TEST(FieldSigns, MeasureRoughness) {
  const PlotField field = field_of(kPlots, 5, 5, 12);
  ASSERT_TRUE(field.signs);
  EXPECT_NEAR(field.signs->roughness, (1 - 0.475) / std::sqrt(12) / 0.95, 0.005);
}

// Canopy of 0.56 x 5.7 m: where leaves spread its sides, it may be sown wider than it looks.
TEST(FieldSigns, AllowForTheErrorOfNarrowPlotsWidth) {
  const auto aspect_of = [](double spread_m) {
    const PlotField field = field_of(
        [&](double x, double y, RandomStream& random) {
          const bool inside = std::abs(x) + spread_m * random.normal() < 0.28;
          return inside && std::abs(y) < 2.85 ? random.uniform(0, 1) : 0;
        },
        1.6, 6.6);
    return field.signs ? field.signs->aspect : NAN;
  };
  EXPECT_NEAR(aspect_of(0), 5.7 / 0.56, 0.3);
  EXPECT_LT(aspect_of(0.2), 9.5);
}

// Signs of wrong plots on a field whose leaves close the gaps, and of right ones on such a field.
TEST(FieldSigns, RefuseSeveralThatAreEachJustGoodEnough) {
  FieldSigns signs{.plots = 67,
                   .held_share = 0.71,
                   .filled_share = 0.86,
                   .squareness = 0.98,
                   .straightness = 1.52,
                   .roughness = 0.129,
                   .unevenness = 0.04,
                   .aspect = 1,
                   .least_gap_m = 0.25,
                   .evidence = 558};
  EXPECT_NE(no_plots_because(signs), "");
  signs.held_share = 0.82;
  signs.squareness = 1.03;
  EXPECT_EQ(no_plots_because(signs), "");
}

// Signs of bushes of which boxes of 4 x 7 m hold most by chance, and of plots of few plants.
TEST(FieldSigns, TellBushesThatBoxesHoldByChance) {
  FieldSigns signs{.plots = 17,
                   .held_share = 0.86,
                   .filled_share = 1,
                   .squareness = 0.97,
                   .straightness = 1.26,
                   .roughness = 0.186,
                   .unevenness = 1.45,
                   .mean_unevenness = 0.3,
                   .aspect = 1.8,
                   .least_gap_m = 0.1,
                   .evidence = 155};
  EXPECT_THAT(no_plots_because(signs), ::testing::HasSubstr("single bushes"));
  signs.unevenness = 0.5;
  EXPECT_EQ(no_plots_because(signs), "");
}

// Signs of a vineyard whose rows were cut into 21 pieces, and of plots whose leaves close the gaps;
// gaps as full as those of the fields that came nearest to each other.
TEST(FieldSigns, TellRowsCutIntoPieces) {
  FieldSigns signs{.plots = 21,
                   .held_share = 0.82,
                   .filled_share = 1,
                   .squareness = 1.2,
                   .straightness = 2,
                   .roughness = 0.2,
                   .unevenness = 0.2,
                   .aspect = 5.6,
                   .least_gap_m = 1.1,
                   .gap_cover = 0.965,
                   .evidence = 51};
  EXPECT_THAT(no_plots_because(signs), ::testing::HasSubstr("vineyard"));
  EXPECT_TRUE(may_be_beside_others(signs));  // another trial may stand in the gaps
  signs.gap_cover = 0.937;
  EXPECT_EQ(no_plots_because(signs), "");
}

// The signs of a torn sheet on the ground: most are just good enough, and it is smoother than a
// crop.
TEST(FieldSigns, RefuseATornSheet) {
  FieldSigns signs{.plots = 14,
                   .held_share = 0.71,
                   .filled_share = 0.74,
                   .squareness = 1.2,
                   .straightness = 1.2,
                   .roughness = 0.092,
                   .unevenness = 0.37,
                   .mean_unevenness = 0.05,
                   .aspect = 1.6,
                   .least_gap_m = 0.052,
                   .evidence = 50};
  EXPECT_NE(no_plots_because(signs), "");
  signs.roughness = 0.115;
  EXPECT_EQ(no_plots_because(signs), "");
}

// Signs of a trial in a survey of 4 ha, and of one that photogrammetry smoothed.
TEST(FieldSigns, LetClearPlotsBePlotsWhateverStandsAround) {
  FieldSigns signs{.plots = 24,
                   .held_share = 0.02,
                   .filled_share = 1,
                   .squareness = 1.9,
                   .straightness = 3.47,
                   .roughness = 0.14,
                   .unevenness = 0.03,
                   .mean_unevenness = 0.01,
                   .aspect = 3.85,
                   .least_gap_m = 0.37,
                   .gap_cover = 0.24,
                   .evidence = 64};
  EXPECT_EQ(no_plots_because(signs), "");
  EXPECT_NEAR(field_confidence(signs), 0.5, 1e-9);
  signs.plots = 6;
  EXPECT_THAT(no_plots_because(signs), ::testing::HasSubstr("holds 2 % of the canopy"));
  signs.plots = 24;
  signs.squareness = 1.3;
  EXPECT_NE(no_plots_because(signs), "");
  signs.squareness = 3.4;
  signs.held_share = 0.98;
  signs.roughness = 0.0805;
  EXPECT_EQ(no_plots_because(signs), "");
  signs.evidence = 12;
  EXPECT_THAT(no_plots_because(signs), ::testing::HasSubstr("photogrammetry"));
}

// Of plots with too few returns the roughness is not known; the other signs decide.
TEST(FieldSigns, DecideWithoutRoughness) {
  FieldSigns signs{.plots = 5,
                   .held_share = 0.001,
                   .filled_share = 0.62,
                   .squareness = 0.99,
                   .straightness = 1.03,
                   .roughness = std::numeric_limits<double>::quiet_NaN(),
                   .aspect = 2.4,
                   .least_gap_m = 0.56,
                   .evidence = -3.7};
  EXPECT_EQ(field_confidence(signs), 0);
  EXPECT_NE(no_plots_because(signs), "");
  signs.held_share = 0.95;
  signs.squareness = 1.2;
  signs.evidence = 100;
  EXPECT_EQ(no_plots_because(signs), "");
}

// Parked cars have steps, as crops are rough; but on their roofs there is no more than noise.
TEST(FieldSigns, TellCarsFromPlots) {
  FieldSigns signs{.plots = 36,
                   .held_share = 0.94,
                   .filled_share = 0.97,
                   .surface_share = 0.05,
                   .squareness = 1.19,
                   .straightness = 14,
                   .roughness = 0.128,
                   .unevenness = 0.3,
                   .mean_unevenness = 0.16,
                   .aspect = 2.4,
                   .least_gap_m = 0.6,
                   .evidence = 156};
  EXPECT_EQ(no_plots_because(signs), "") << "where it is not known";
  signs.patch_scatter = 1.7;
  EXPECT_EQ(no_plots_because(signs), "");
  signs.patch_scatter = 1.0;
  EXPECT_THAT(no_plots_because(signs), ::testing::HasSubstr("smooth surfaces"));
}

// What would be rows of a crop may be plots that touch, if they hold the canopy.
TEST(FieldSigns, AllowPlotsThatTouch) {
  FieldSigns signs{.plots = 40,
                   .held_share = 0.9,
                   .filled_share = 1,
                   .squareness = 1.3,
                   .straightness = 4,
                   .roughness = 0.25,
                   .unevenness = 0.2,
                   .mean_unevenness = 0.1,
                   .aspect = 3.3,
                   .least_gap_m = 0,
                   .evidence = 100};
  EXPECT_THAT(no_plots_because(signs), ::testing::HasSubstr("rows of a crop"));
  EXPECT_EQ(no_touching_plots_because(signs, 0), "");
  signs.held_share = 0.8;
  EXPECT_THAT(no_touching_plots_because(signs, 0), ::testing::HasSubstr("without gaps"));
  EXPECT_EQ(no_touching_plots_because(signs, 0.1), "") << "as leaves hang into the other gaps";
  signs.held_share = 0.9;
  signs.aspect = 15;
  EXPECT_THAT(no_touching_plots_because(signs, 0), ::testing::HasSubstr("rows of a crop"));
}

// Plots of a drill and a combine, 1.5 x 18 m, are as long as rows, but lie as plots do.
TEST(FieldSigns, TellLongPlotsFromRows) {
  const auto rows_of = [](double width_m, double pitch_m) {
    const PlotField field = field_of(
        [&](double x, double y, RandomStream& random) {
          return in_box(x, y, width_m, 18) ? random.uniform(0, 1) : 0;
        },
        pitch_m, 19, 9.5);
    return field.plots.empty() ? field.why_none : "";
  };
  EXPECT_EQ(rows_of(1.5, 2), "");
  EXPECT_THAT(rows_of(0.6, 0.9), ::testing::HasSubstr("rows of a crop"));
  EXPECT_THAT(rows_of(1.5, 3), ::testing::HasSubstr("rows of a crop"));
}

TEST(FieldSigns, TellLongRows) {
  EXPECT_NE(why_none_of(
                [](double x, double, RandomStream& random) {
                  return std::abs(x) < 0.3 ? random.uniform(0, 1.8) : 0;
                },
                2.5, 1000),
            "");
}

}  // namespace
}  // namespace plotscan::plots
