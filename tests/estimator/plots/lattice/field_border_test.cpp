// SPDX-License-Identifier: Apache-2.0
#include "plots/lattice/internal/field_border.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <utility>

#include <gtest/gtest.h>

#include "estimator/plots/known_trial.h"
#include "plots/lattice/internal/place_canopy.h"

namespace plotscan::plots {
namespace {

constexpr double kGapsClosed = 0.2;  // sigma of leaves that close gaps of 0.4 and 0.8 m

// The canopy of the trial's first rows and, from beyond them on, of something else.
CanopyRaster canopy_beside(const TrialLayout& trial, int rows,
                           const std::function<double(double x, double y)>& beyond) {
  TrialLayout sown = trial;
  std::erase_if(sown.places, [&](const TrialPlace& place) { return place.row > rows; });
  const CanopyRaster of_plots = canopy_of(trial, 1.5, kGapsClosed);
  const CanopyRaster canopy = canopy_of(sown, 1.5, kGapsClosed);
  return raster_of(of_plots.a_cells() * 0.05, of_plots.b_cells() * 0.05, [&](double x, double y) {
    const int a = static_cast<int>(x / 0.05), b = static_cast<int>(y / 0.05);
    return std::max(canopy.cover(a, a + 1, b, b + 1), beyond(x, y));
  });
}

// Of the trial's rows on the raster, the lattice has the first ones.
Lattice lattice_of_first(const TrialLayout& trial, int rows, const CanopyRaster& raster) {
  Lattice lattice = lattice_of(trial, raster);
  std::erase_if(lattice.places, [&](const Place& place) { return place.row >= rows; });
  return lattice;
}

std::ptrdiff_t plots_of(const Lattice& lattice) {
  return std::ranges::count_if(lattice.places, &Place::full);
}

// Sides at which plots touch lie in the crop, or in the gap between two of its rows.
TEST(MeanAtGaps, IsThatOfTheSidesWithGapsBesideThem) {
  Lattice lattice;
  const SideContrast contrast{.r = 0.8, .c = -0.2};
  EXPECT_DOUBLE_EQ(mean_at_gaps(lattice, contrast), 0.3);
  lattice.c.touching_m = 1.5;
  EXPECT_EQ(mean_at_gaps(lattice, contrast), 0.8);
  std::swap(lattice.r.touching_m, lattice.c.touching_m);
  EXPECT_EQ(mean_at_gaps(lattice, contrast), -0.2);
  lattice.c.touching_m = 4;
  EXPECT_DOUBLE_EQ(mean_at_gaps(lattice, contrast), 0.3);
}

TEST(GoOnBeyond, FindsTheRowsAndColumnsThatFollow) {
  const TrialLayout trial = known_trial({0, 0, 0, 0});
  const CanopyRaster raster = canopy_of(trial, 1.5, kGapsClosed);
  Lattice lattice = lattice_of_first(trial, 2, raster);
  std::erase_if(lattice.places, [](const Place& place) { return place.column == 0; });
  go_on_beyond(lattice);
  EXPECT_EQ(plots_of(lattice), std::ssize(trial.places));
  for (const Place& place : lattice.places) {
    EXPECT_NEAR(place.r_m, 3 + place.row * trial.row_pitch_m, 1e-9);
    EXPECT_NEAR(place.c_m, 2 + place.column * trial.column_pitch_m, 1e-9);
  }
}

// The middle plot of the row that follows leans over to the next one.
TEST(GoOnBeyond, TakesALodgedPlotBetweenTwoOthers) {
  const TrialLayout trial = known_trial({0, 0, 0});
  TrialLayout grown = trial;
  for (TrialPlace& place : grown.places)
    if (place.row == 3 && place.column == 3) place.position_m.x() += 0.5;
  const CanopyRaster raster = canopy_of(grown, 1.5, kGapsClosed);
  Lattice lattice = lattice_of_first(trial, 2, raster);
  go_on_beyond(lattice);
  EXPECT_EQ(plots_of(lattice), 15);
}

// The last plot of the row that follows is a giant, which closes the gaps beside it.
TEST(GoOnBeyond, TakesAPlotThatClosesItsGapsInARowOfPlots) {
  const TrialLayout trial = known_trial({0, 0, 0});
  const double third_m = 3 + 2 * trial.row_pitch_m, last_m = 2 + 4 * trial.column_pitch_m;
  const CanopyRaster raster = canopy_beside(trial, 3, [&](double x, double y) {
    const bool giant = std::abs(x - third_m) < trial.length_m / 2 &&
                       std::abs(y - last_m) < 0.75 * trial.column_pitch_m;
    return giant ? 0.95 : 0.0;
  });
  Lattice lattice = lattice_of_first(trial, 2, raster);
  go_on_beyond(lattice);
  EXPECT_EQ(plots_of(lattice), 15);
}

TEST(GoOnBeyond, AddsNothingWhereBareGroundAHedgeOrAnotherCropFollows) {
  const TrialLayout trial = known_trial({0, 0, 0});
  const double third_m = 3 + 2 * trial.row_pitch_m;
  const std::function<double(double, double)> beyond[] = {
      [](double, double) { return 0.0; },
      [&](double x, double) { return std::abs(x - third_m) < trial.length_m / 2 ? 0.9 : 0.0; },
      [&](double x, double) { return x > third_m - trial.length_m / 2 ? 0.9 : 0.0; }};
  for (const auto& standing : beyond) {
    const CanopyRaster raster = canopy_beside(trial, 2, standing);
    Lattice lattice = lattice_of_first(trial, 2, raster);
    go_on_beyond(lattice);
    EXPECT_EQ(plots_of(lattice), 10);
  }
}

// Of three rows of places, two are plots. The third was cut out of a crop that goes on behind it;
// or it is plots, and a crop adjoins them.
TEST(LeaveOutCrop, TakesAwayTheRowsThatWereCutOutOfIt) {
  const TrialLayout trial = known_trial({0, 0, 0});
  const double third_m = 3 + 2 * trial.row_pitch_m;
  for (const bool are_plots : {false, true}) {
    const double from_m = third_m + (are_plots ? 0.5 : -0.5) * trial.length_m;
    const CanopyRaster raster = canopy_beside(
        trial, are_plots ? 3 : 2, [&](double x, double) { return x > from_m ? 0.75 : 0.0; });
    Lattice lattice = lattice_of(trial, raster).turned();
    leave_out_crop(lattice);
    EXPECT_EQ(plots_of(lattice), are_plots ? 15 : 10);
    for (const Place& place : lattice.places) EXPECT_TRUE(place.full || place.column == 2);
  }
}

// Leaves close all gaps but for a trace, of which nothing shows at the third row.
TEST(LeaveOutCrop, LeavesPlotsWhoseEdgesHardlyShow) {
  const TrialLayout trial = known_trial({0, 0, 0});
  const CanopyRaster raster = raster_of(14, 12, [&](double x, double y) {
    const bool in_plot = std::ranges::any_of(trial.places, [&](const TrialPlace& place) {
      return place.row < 3 && trial.box(place).contains({x, y});
    });
    return in_plot ? 0.85 : 0.75;
  });
  Lattice lattice = lattice_of(trial, raster);
  leave_out_crop(lattice);
  EXPECT_EQ(plots_of(lattice), 15);
}

// What is left of three rows of five plots of which those at (row, column) show no edges.
Lattice left_of(const std::set<std::pair<int, int>>& edgeless) {
  const TrialLayout trial = known_trial({0, 0, 0});
  const CanopyRaster raster = canopy_of(trial);
  Lattice lattice = lattice_of(trial, raster);
  for (Place& place : lattice.places) {
    place.share = 1;
    place.contrast = edgeless.contains({place.row, place.column}) ? 0.1 : 1;
  }
  leave_out_beside(lattice);
  lattice.view.raster = nullptr;  // it ends here
  return lattice;
}

// Of three rows, the middle plot of the last one and the last plot of the first one are as covered
// as the others and show no edges, as lodged plots. Weeds may be that at a corner.
TEST(LeaveOutBeside, KeepsLodgedPlotsThatStandBetweenOthers) {
  const Lattice lattice = left_of({{2, 2}, {0, 4}});
  for (const Place& place : lattice.places)
    EXPECT_EQ(place.full, place.row != 0 || place.column != 4) << place.row << ' ' << place.column;
}

// Two neighbours that lie half a metre out of line have no edges where the lattice has its own.
TEST(LeaveOutBeside, KeepsTwoNeighboursBetweenOthers) {
  EXPECT_EQ(plots_of(left_of({{2, 2}, {2, 3}})), 15);
}

// As a closed crop is sometimes seen: steps from row to row that are less than a plot.
TEST(GoOnBeyond, LeavesLatticesAloneThatOverlapOrHoldNothing) {
  const TrialLayout trial = known_trial({0, 0, 0});
  const CanopyRaster raster = canopy_of(trial);
  Lattice lattice = lattice_of_first(trial, 2, raster);
  lattice.r.pitch_m = lattice.c.pitch_m = 1e-9;
  go_on_beyond(lattice);
  EXPECT_EQ(plots_of(lattice), 10);
  for (Place& place : lattice.places) place.full = false;
  go_on_beyond(lattice);
  EXPECT_EQ(plots_of(lattice), 0);
}

}  // namespace
}  // namespace plotscan::plots
