// SPDX-License-Identifier: Apache-2.0
#include "plots/layout/layout.h"

#include <cmath>
#include <utility>

#include <gtest/gtest.h>

#include "core/random.h"
#include "estimator/plots/known_trial.h"
#include "plots/layout/internal/layout_criterion.h"

namespace plotscan::plots {
namespace {

// Every plot of the trial is one of the layout's, to two cells.
void expect_layout(const Layout& found, const TrialLayout& trial) {
  std::vector<Eigen::Vector2d> centres;
  for (const Row& row : found.rows)
    for (const Band& plot : row.plots)
      centres.push_back(found.view.to_world(row.band.middle() * 0.05, plot.middle() * 0.05));
  ASSERT_EQ(centres.size(), trial.places.size());
  for (const TrialPlace& place : trial.places) {
    double nearest_m = 1e9;
    for (const Eigen::Vector2d& centre : centres)
      nearest_m = std::min(nearest_m, (centre - trial.box(place).center).norm());
    EXPECT_LT(nearest_m, 0.1);
  }
  const int length = std::max(found.r_shape.size, found.c_shape.size);
  const int width = std::min(found.r_shape.size, found.c_shape.size);
  EXPECT_NEAR(length * 0.05, 3, 0.15);
  EXPECT_NEAR(width * 0.05, 1.5, 0.15);
}

TEST(BestLayout, IsTheTrialThatStandsThere) {
  const TrialLayout trial = known_trial({0, 0, 0});
  const CanopyRaster raster = canopy_of(trial);
  const Layout found = best_layout(raster);
  expect_layout(found, trial);
  EXPECT_TRUE(found.aligned);
  const LayoutCriterion criterion(raster);
  EXPECT_NEAR(found.evidence, 0.5 * (criterion({.view = found.view}) - criterion(found)), 1e-9);
}

TEST(BestLayout, FollowsRowsThatStartAtOffsets) {
  const TrialLayout trial = known_trial({0.8, 0, 0.4});
  const CanopyRaster raster = canopy_of(trial);
  const Layout found = best_layout(raster);
  expect_layout(found, trial);
  EXPECT_FALSE(found.aligned);
}

// Rows of three plots, of which one lacks the first and the next the last.
TEST(IsInColumns, WhereRowsOfFewPlotsLackSome) {
  const CanopyRaster raster = canopy_of(known_trial({0}));
  const auto rows_at = [&](int offset) {
    Layout layout{.view = {.raster = &raster}};
    layout.rows = {{{0, 30}, {{0, 90}, {140, 230}, {245, 335}}},
                   {{40, 70}, {{140, 230}, {246, 336}}},
                   {{80, 110}, {{0 + offset, 90 + offset}, {139 + offset, 229 + offset}}}};
    return layout;
  };
  EXPECT_TRUE(is_in_columns(rows_at(0)));
  EXPECT_FALSE(is_in_columns(rows_at(20)));
}

// Leaves move what is seen of each plot: rows that are only off by that have no offsets of their
// own. Offsets of the same size that a row's plots share are the row's.
TEST(IsInColumns, WhereLeavesMoveEachPlotByItself) {
  const CanopyRaster raster = canopy_of(known_trial({0}));
  const auto rows_of = [&](const std::vector<std::vector<int>>& begins) {
    Layout layout{.view = {.raster = &raster}};
    for (std::size_t i = 0; i < begins.size(); ++i) {
      const int at = 40 * static_cast<int>(i);
      layout.rows.push_back({{at, at + 30}});
      for (const int begin : begins[i]) layout.rows.back().plots.push_back({begin, begin + 60});
    }
    return layout;
  };
  EXPECT_TRUE(
      is_in_columns(rows_of({{425, 520, 615}, {422, 520, 615}, {426, 520, 619}, {518, 612}})));
  EXPECT_FALSE(
      is_in_columns(rows_of({{425, 520, 615}, {420, 515, 610}, {425, 520, 615}, {520, 615}})));
}

// Of the second row's plots the gaps were seen beside their place.
TEST(InColumns, HasThePlotsOfMostRows) {
  TrialLayout trial = known_trial({0, 0, 0});
  trial.places.erase(trial.places.begin() + 7);
  const CanopyRaster raster = canopy_of(trial);
  Layout layout{.view = {.raster = &raster}, .r_shape = {.size = 60}, .c_shape = {.size = 30}};
  for (const int r : {30, 106, 182}) {
    layout.rows.push_back({{r, r + 60}});
    for (int column = 0; column < 5; ++column) {
      const int c = 25 + 38 * column + (r == 106 ? 10 : 0);
      layout.rows.back().plots.push_back({c, c + 30});
    }
  }
  const std::optional<Layout> found = in_columns(layout);
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->aligned);
  expect_layout(*found, trial);
  for (Band& plot : layout.rows[1].plots) plot = {plot.begin + 9, plot.end + 9};
  EXPECT_FALSE(in_columns(layout)) << "columns that overlap";
}

// Three drill rows a plot, one or two of them from row to row: they form columns through the field.
TEST(BestLayout, IsThePlotsWhoseDrillRowsFormColumns) {
  constexpr double kSpacing_m = 0.475;  // four of which are a pitch
  const TrialLayout trial = known_trial({0, kSpacing_m, 2 * kSpacing_m});
  for (const double leaves_m : {0.06, 0.08}) {
    const CanopyRaster raster = canopy_in_plots(trial, [&](const Eigen::Vector2d& off) {
      if (std::abs(off.x()) > 2 || std::abs(off.y()) > 1.2) return 0.0;
      double depth = 0;
      for (const double row_m : {-kSpacing_m, 0.0, kSpacing_m})
        depth += blurred_box(off.y() - row_m, 2 * leaves_m, 0.04);
      return depth * blurred_box(off.x(), trial.length_m, 0.08);
    });
    expect_layout(best_layout(raster), trial);
  }
}

TEST(BestLayout, LeavesOutThePlotThatIsMissing) {
  TrialLayout trial = known_trial({0, 0, 0});
  trial.places.erase(trial.places.begin() + 7);
  const CanopyRaster raster = canopy_of(trial);
  expect_layout(best_layout(raster), trial);
}

TEST(BestLayout, HasTheRowsAndColumnsThatWereTold) {
  const TrialLayout trial = known_trial({0, 0, 0});
  const CanopyRaster raster = canopy_of(trial);
  expect_layout(best_layout(raster, {.rows = 3, .columns = 5}), trial);
  EXPECT_TRUE(best_layout(raster, {.rows = 4}).rows.empty());
}

TEST(BestLayout, IsNoneOfALevelCanopy) {
  const CanopyRaster level = raster_of(10, 10, [](double, double) { return 0.5; });
  EXPECT_TRUE(best_layout(level).rows.empty());
}

// Small enough to add up by hand: 40 x 50 cells of 10 cm, two rows of two plots of 1 x 1.2 m whose
// pieces and gaps, of 0.5 m, are each one rectangle.
TEST(Criterion, IsWhatAddingCellByCellGives) {
  std::vector<double> cover(40 * 50);
  const CanopyRaster raster = raster_of(
      4, 5,
      [&](double a, double b) {
        const auto at =
            static_cast<std::size_t>(50 * static_cast<int>(a * 10) + static_cast<int>(b * 10));
        RandomStream random(9, random_purpose("test/criterion"), at);
        return cover[at] = std::round(200 * random.uniform()) / 200;
      },
      0.1);
  Layout layout{.view = {.raster = &raster}};
  for (const int r : {5, 20}) layout.rows.push_back({{r, r + 10}, {{3, 15}, {20, 32}}});
  const auto squares = [&](const auto& belongs) {
    double n = 0, sum = 0, sum2 = 0;
    for (int a = 0; a < 40; ++a) {
      for (int b = 0; b < 50; ++b) {
        if (!belongs(a, b)) continue;
        const double canopy = cover[static_cast<std::size_t>(50 * a + b)];
        n += 1;
        sum += canopy;
        sum2 += canopy * canopy;
      }
    }
    return sum2 - sum * sum / n;
  };
  const std::vector<Band> rows = {{5, 15}, {15, 20}, {20, 30}};  // the second is a gap
  const std::vector<Band> columns = {{3, 15}, {15, 20}, {20, 32}};
  const auto is_in = [](int cell, const Band& band) {
    return cell >= band.begin && cell < band.end;
  };
  double left = squares([&](int a, int b) {
    const bool crossing = is_in(a, rows[1]) && is_in(b, columns[1]);  // four plots' corners
    return crossing || a < 5 || a >= 30 || b < 3 || b >= 32;
  });
  for (std::size_t r = 0; r < 3; ++r)
    for (std::size_t c = 0; c < 3; ++c)
      if (r != 1 || c != 1)
        left += squares([&](int a, int b) { return is_in(a, rows[r]) && is_in(b, columns[c]); });
  const double clumps = 14 * 17;  // squares of three cells
  const double lines = 2 + 2;     // two rows, two columns
  const LayoutCriterion criterion(raster);
  EXPECT_NEAR(criterion(layout), clumps * std::log(left) + std::log(clumps) * lines, 1e-6);
  layout.aligned = false;  // each row's plots have lines of their own
  EXPECT_NEAR(criterion(layout), clumps * std::log(left) + std::log(clumps) * 6, 1e-6);
}

// Bare ground beyond half a metre around the plots says nothing of them.
TEST(Criterion, HasTheSameEvidenceHoweverMuchBareGroundWasScanned) {
  const TrialLayout trial = known_trial({0, 0.1, 0});
  const auto evidence_with = [&](double beyond_m) {
    const CanopyRaster canopy = canopy_of(trial);
    const int around = static_cast<int>(std::lround(beyond_m / canopy.cell_m()));
    const CanopyRaster raster =
        raster_of(canopy.a_cells() * 0.05 + 2 * beyond_m, canopy.b_cells() * 0.05 + 2 * beyond_m,
                  [&](double a, double b) {
                    const int i = static_cast<int>(a / 0.05) - around,
                              k = static_cast<int>(b / 0.05) - around;
                    return canopy.cover(i, i + 1, k, k + 1);
                  });
    const Layout found = best_layout(raster);
    EXPECT_EQ(found.rows.size(), 3u);
    return std::pair(found.evidence, found.evidence_in_outline);
  };
  const auto [near_all, near] = evidence_with(0);
  const auto [far_all, far] = evidence_with(10);
  EXPECT_GT(near, 0);
  EXPECT_NEAR(far / near, 1, 0.05);
  EXPECT_GT(far_all, 2 * near_all);  // as the whole raster has it
}

}  // namespace
}  // namespace plotscan::plots
