// SPDX-License-Identifier: Apache-2.0
#include "plots/layout/axis_fit.h"

#include <gtest/gtest.h>

#include "estimator/plots/known_trial.h"

namespace plotscan::plots {
namespace {

// 12 m of ground, 2 m wide, with bands of full canopy of one size along it. Every second strip of
// half a metre is a little denser, so that the profile's error is known.
CanopyRaster striped(const std::vector<double>& begins_m, double size_m) {
  return raster_of(12, 2, [&](double a_m, double b_m) {
    for (const double begin_m : begins_m)
      if (a_m > begin_m && a_m < begin_m + size_m) return b_m < 1 ? 0.9 : 0.8;
    return 0.05;
  });
}

Line line_along(const CanopyRaster& raster, const AxisHint& hint = {}) {
  const RowView view{.raster = &raster};
  return line_of(view, {{{0, view.c_cells()}}}, hint);
}

TEST(LineOf, AParameterCostsWhatSchwarzAsks) {
  const CanopyRaster raster = striped({1, 3}, 1.2);
  const RowView view{.raster = &raster};
  const std::vector<Band> whole = {{0, view.c_cells()}};
  const Line line = line_along(raster);
  EXPECT_NEAR(line.price, std::log(profile_along_r(view, whole).independent), 1e-12);
}

TEST(FitAxis, FindsBandsOfOneSize) {
  const CanopyRaster raster = striped({1, 3, 5, 7, 9}, 1.2);
  const AxisFit fit = fit_axis(line_along(raster), true);
  ASSERT_EQ(fit.begins.size(), 1U);
  ASSERT_EQ(fit.begins.front().size(), 5U);
  EXPECT_NEAR(fit.shape.size, 24, 1);
  for (std::size_t i = 0; i < 5; ++i)
    EXPECT_NEAR(fit.begins.front()[i], 20 + 40 * static_cast<int>(i), 1);
}

// Strips of a farm, 36 m long.
TEST(FitAxis, FindsBandsOfAnyLength) {
  const CanopyRaster raster = raster_of(120, 2, [](double a_m, double b_m) {
    return std::fmod(a_m - 3 + 38, 38) < 36 && a_m > 3 && a_m < 116 ? (b_m < 1 ? 0.9 : 0.8) : 0.05;
  });
  const AxisFit fit = fit_axis(line_along(raster), true);
  ASSERT_EQ(fit.begins.size(), 1U);
  ASSERT_EQ(fit.begins.front().size(), 3U);
  EXPECT_NEAR(fit.shape.size, 36 / 0.05, 8);
}

// Each of two rows has its own begins where they are not shared.
TEST(FitAxis, FindsEachRowsOwnBands) {
  const CanopyRaster raster = raster_of(12, 4, [](double a_m, double b_m) {
    const double step_m = std::fmod(a_m - (b_m < 2 ? 0.7 : 1.4) + 2, 2);
    return a_m > 1.4 && a_m < 10.6 && step_m < 1.2 ? (std::fmod(b_m, 2) < 1 ? 0.9 : 0.8) : 0.05;
  });
  const Line line = line_of({.raster = &raster}, {{{0, 40}}, {{40, 80}}}, {});
  const AxisFit fit = fit_axis(line, false);
  ASSERT_EQ(fit.begins.size(), 2U);
  const int off = (fit.begins[1][1] - fit.begins[0][1] + 40) % 40;
  EXPECT_NEAR(off, 14, 1);  // 0.7 m
}

// Two drill rows 0.6 m apart, then 1.4 m to the next plot: sown widths of 1.2 m.
TEST(PutTogether, MakesPlotsOfDrillRows) {
  std::vector<double> begins_m;
  for (int plot = 0; plot < 5; ++plot)
    for (const double row_m : {0.1, 0.7}) begins_m.push_back(1 + 2 * plot + row_m);
  const CanopyRaster raster = striped(begins_m, 0.4);
  const Line line = line_along(raster);
  const AxisFit rows = fit_axis(line, true), plots = put_together(line, rows);
  EXPECT_NEAR(plots.row_spacing, 12, 1);
  EXPECT_NEAR(plots.shape.size, 24, 2);
  EXPECT_EQ(plots.band_size, rows.shape.size);
  EXPECT_EQ(rows.begins.front().size(), 10U);
  ASSERT_EQ(plots.begins.front().size(), 5U);
  for (int plot = 0; plot < 5; ++plot)
    EXPECT_NEAR(plots.begins.front()[static_cast<std::size_t>(plot)], 20 + 40 * plot, 1);
  const Line told = line_along(raster, {.side_m = 0.4});
  EXPECT_EQ(put_together(told, fit_axis(told, true)).row_spacing, 0);
}

constexpr double kOfBand = 3;  // parameters: its begin, its level, that of the gap before it

// Three plots, the third behind an alley: of two steps one is not the usual one.
TEST(FitAxis, AnAlleyAddsItsSizeAndItsPlace) {
  EXPECT_EQ(fit_axis(line_along(striped({1, 3, 5}, 1.2)), true).parameters, 3 * kOfBand);
  EXPECT_EQ(fit_axis(line_along(striped({1, 3, 6.2}, 1.2)), true).parameters, 3 * kOfBand + 2);
}

// The gaps are 0.3 and 0.55 m wide in turn, the narrow ones half closed.
TEST(FitAxis, FindsPlotsBetweenGapsThatAlternate) {
  const std::vector<double> begins_m = {1, 2.5, 4.25, 5.75, 7.5, 9};
  const CanopyRaster raster = raster_of(12, 2, [&](double a_m, double b_m) {
    double canopy = 0.05;
    for (const double begin_m : begins_m) {
      if (a_m > begin_m && a_m < begin_m + 1.2) return b_m < 1 ? 0.9 : 0.8;
      if (begin_m - a_m > 0 && begin_m - a_m < 0.3 && std::fmod(begin_m - 1, 3.25) > 1)
        canopy = 0.4;
    }
    return canopy;
  });
  const AxisFit fit = fit_axis(line_along(raster), true);
  ASSERT_EQ(fit.begins.front().size(), begins_m.size());
  for (std::size_t i = 0; i < begins_m.size(); ++i)
    EXPECT_NEAR(0.05 * fit.begins.front()[i], begins_m[i], 0.06);
  // One place of the period more, however often it repeats.
  EXPECT_EQ(fit.parameters, 6 * kOfBand + 2);
}

// Drill rows repeat too, but the gaps between plots are as wide as they are.
TEST(FitAxis, DrillRowsOfPlotsAreIrregular) {
  const AxisFit fit =
      fit_axis(line_along(striped({1, 1.6, 2.2, 3.7, 4.3, 4.9, 6.4, 7, 7.6}, 0.4)), true);
  const auto bands = static_cast<double>(fit.begins.front().size());
  EXPECT_GE(bands, 7);  // the outer ones may be something else
  EXPECT_EQ(fit.parameters, bands * kOfBand + 2 * 2);
}

// Rows 0.36 m apart, as soybeans are sown (15 in: 0.38 m), and 0.2 m between the sown widths.
TEST(PutTogether, SeesRowsThatAreClose) {
  std::vector<double> begins_m;
  for (int plot = 0; plot < 5; ++plot)
    for (int row = 0; row < 5; ++row) begins_m.push_back(1 + 2 * plot + 0.36 * row + 0.08);
  const Line line = line_along(striped(begins_m, 0.2));
  const AxisFit plots = put_together(line, fit_axis(line, true));
  EXPECT_NEAR(plots.row_spacing, 7.2, 0.2);
  EXPECT_NEAR(plots.shape.size, 36, 1);
  ASSERT_EQ(plots.begins.front().size(), 5U);
  for (int plot = 0; plot < 5; ++plot)
    EXPECT_NEAR(plots.begins.front()[static_cast<std::size_t>(plot)], 20 + 40 * plot, 1);
}

// The third plot is lodged and the fourth of five is low: no band shows them.
TEST(PutTogether, FillsInWhereABandIsNotSeen) {
  const CanopyRaster raster = striped({1, 3, 9}, 1.2);
  const Line line = line_along(raster);
  const AxisFit seen = fit_axis(line, true), plots = put_together(line, seen);
  ASSERT_EQ(seen.begins.front().size(), 3U);
  ASSERT_EQ(plots.begins.front().size(), 5U);
  for (std::size_t i = 0; i < 5; ++i)
    EXPECT_NEAR(plots.begins.front()[i], 20 + 40 * static_cast<int>(i), 1);
}

TEST(FitAxis, HasTheSideAndTheCountThatWereTold) {
  const CanopyRaster raster = striped({1, 3, 5, 7, 9}, 1.2);
  EXPECT_EQ(fit_axis(line_along(raster, {.side_m = 1.2}), true).shape.size, 24);
  EXPECT_EQ(fit_axis(line_along(raster, {.count = 5}), true).begins.front().size(), 5U);
  EXPECT_TRUE(std::isinf(fit_axis(line_along(raster, {.count = 9}), true).misfit));
}

}  // namespace
}  // namespace plotscan::plots
