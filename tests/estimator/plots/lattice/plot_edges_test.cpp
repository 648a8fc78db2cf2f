// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/contains.h"
#include "estimator/plots/known_trial.h"
#include "plots/lattice/lattice.h"

namespace plotscan::plots {
namespace {

using testing::Each;

// A trial's canopy with sharp sides, and what else stands at (x, y). Full canopy is 0.9.
CanopyRaster canopy_with(const TrialLayout& trial,
                         const std::function<double(double x, double y)>& canopy_at) {
  const Eigen::Vector2d far = trial.box(trial.places.back()).center;
  return raster_of(far.x() + 3, far.y() + 2.5, canopy_at);
}

bool in_plot(const TrialLayout& trial, double x, double y) {
  return std::ranges::any_of(trial.places, [&](const TrialPlace& place) {
    return trial.box(place).contains({x, y});
  });
}

// The trial's columns (along y) that are marked in every row; others must be marked in none.
std::vector<int> marked_columns(const TrialLayout& trial, const std::vector<bool>& marked) {
  std::vector<int> columns;
  for (std::size_t i = 0; i < marked.size(); ++i)
    if (marked[i] && trial.places[i].row == 1) columns.push_back(trial.places[i].column);
  for (std::size_t i = 0; i < marked.size(); ++i)
    EXPECT_EQ(marked[i], contains(columns, trial.places[i].column));
  return columns;
}

TEST(WithoutEdge, IsNoPlotOfATrial) {
  const TrialLayout trial = known_trial({0, 0, 0});
  const CanopyRaster raster = canopy_of(trial);
  EXPECT_THAT(without_edge(lattice_of(trial, raster)), Each(false));
}

// The first column's plots end 0.5 m before the boxes do, as guard plots of another width.
TEST(WithoutEdge, AreGuardPlotsThatAreNarrower) {
  const TrialLayout trial = known_trial({0, 0, 0});
  const CanopyRaster raster = canopy_with(
      trial, [&](double x, double y) { return y > 1.75 && in_plot(trial, x, y) ? 0.9 : 0.05; });
  EXPECT_EQ(marked_columns(trial, without_edge(lattice_of(trial, raster))), std::vector{1});
}

// The first column's plots are those of a strip that runs on through the gaps between them.
TEST(WithoutEdge, ArePiecesOfAGuardStrip) {
  const TrialLayout trial = known_trial({0, 0, 0});
  const PlotBox first = trial.box(trial.places.front()), last = trial.box(trial.places.back());
  const CanopyRaster raster = canopy_with(trial, [&](double x, double y) {
    const bool in_strip = std::abs(y - first.center.y()) < trial.width_m / 2 &&
                          x > first.center.x() - trial.length_m / 2 &&
                          x < last.center.x() + trial.length_m / 2;
    return in_strip || in_plot(trial, x, y) ? 0.9 : 0.05;
  });
  EXPECT_EQ(marked_columns(trial, without_edge(lattice_of(trial, raster))), std::vector{1});
}

// Another crop stands from the last column's plots on.
TEST(WithoutEdge, ArePlotsThatAnotherCropTouches) {
  const TrialLayout trial = known_trial({0, 0, 0});
  const double from_m = trial.box(trial.places.back()).center.y();
  const CanopyRaster raster = canopy_with(
      trial, [&](double x, double y) { return y > from_m || in_plot(trial, x, y) ? 0.9 : 0.05; });
  EXPECT_EQ(marked_columns(trial, without_edge(lattice_of(trial, raster))), std::vector{5});
}

// Columns follow each other along r where the lattice is turned.
TEST(WithoutEdge, IsTheSameWhicheverAxisIsTheRows) {
  const TrialLayout trial = known_trial({0, 0, 0});
  const CanopyRaster raster = canopy_with(
      trial, [&](double x, double y) { return y > 1.75 && in_plot(trial, x, y) ? 0.9 : 0.05; });
  const Lattice lattice = lattice_of(trial, raster);
  EXPECT_EQ(without_edge(lattice), without_edge(lattice.turned()));
}

// One plot's side may be lodged: what counts is its whole row or column.
TEST(WithoutEdge, IsNoSinglePlotWhoseSideIsLodged) {
  const TrialLayout trial = known_trial({0, 0, 0});
  const PlotBox lodged = trial.box(trial.places.front());
  const CanopyRaster raster = canopy_with(trial, [&](double x, double y) {
    return in_plot(trial, x, y) && !(lodged.contains({x, y}) && y < 1.75) ? 0.9 : 0.05;
  });
  EXPECT_THAT(without_edge(lattice_of(trial, raster)), Each(false));
}

// Drill rows end before the plots' sides do, so that no side shows an edge.
TEST(WithoutEdge, IsNoPlotWhereNoSideShowsOne) {
  const TrialLayout trial = known_trial({0, 0, 0});
  const CanopyRaster raster = sown_canopy(trial, 2, 0.05, 0.1);
  EXPECT_THAT(without_edge(lattice_of(trial, raster)), Each(false));
}

// The last row's plots stand in a closed crop.
TEST(CountEdgeless, CountsPlotsInACropWithoutGaps) {
  const TrialLayout trial = known_trial({0, 0, 0});
  EXPECT_EQ(count_edgeless(lattice_of(trial, canopy_of(trial))), 0u);
  const double from_m = trial.box(trial.places.back()).center.x() - trial.length_m / 2;
  const CanopyRaster raster = canopy_with(
      trial, [&](double x, double y) { return x > from_m || in_plot(trial, x, y) ? 0.9 : 0.05; });
  EXPECT_EQ(count_edgeless(lattice_of(trial, raster)), 5u);
}

}  // namespace
}  // namespace plotscan::plots
