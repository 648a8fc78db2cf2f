// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <gtest/gtest.h>

#include "core/random.h"
#include "estimator/plots/known_trial.h"

namespace plotscan::plots {
namespace {

// Every place lies up to 6 cm off its plot; what straightens them has the canopy to go by.
void expect_straightened(const TrialLayout& trial, bool aligned) {
  const CanopyRaster raster = canopy_of(trial);
  Lattice lattice = lattice_of(trial, raster);
  lattice.aligned = aligned;
  for (std::size_t i = 0; i < lattice.places.size(); ++i) {
    RandomStream random(6, random_purpose("test/straighten"), i);
    lattice.places[i].r_m += random.uniform(-0.06, 0.06);
    lattice.places[i].c_m += random.uniform(-0.06, 0.06);
  }
  lattice.r.pitch_m += 0.03;  // of bands that were seen in cells of 5 cm
  straighten(lattice);
  EXPECT_NEAR(lattice.r.pitch_m, trial.row_pitch_m, 0.01);
  for (std::size_t i = 0; i < trial.places.size(); ++i) {
    const Eigen::Vector2d truth = trial.box(trial.places[i]).center;
    EXPECT_NEAR(lattice.places[i].r_m, truth.x(), 0.012) << i;
    EXPECT_NEAR(lattice.places[i].c_m, truth.y(), 0.012) << i;
  }
  EXPECT_LT(std::max(lattice.r.rms_m, lattice.c.rms_m), 0.02);
}

TEST(Straighten, PutsPlacesOnTheRowsAndColumns) {
  expect_straightened(known_trial({0, 0, 0}), true);
}

TEST(Straighten, KeepsTheRowsOffsets) {
  expect_straightened(known_trial({0.5, 0, 0.3}), false);
  expect_straightened(known_trial({0, 0.15, 0}), true);
}

TEST(Straighten, KeepsAnAlleyThatIsWider) {
  TrialLayout trial = known_trial({0, 0, 0});
  for (TrialPlace& place : trial.places)
    if (place.column > 2) place.position_m.x() += 0.3;
  expect_straightened(trial, true);
}

// As a planter that sows two plots a pass leaves them.
TEST(Straighten, KeepsWideAndNarrowGapsInTurn) {
  TrialLayout trial = known_trial({0, 0, 0});
  for (TrialPlace& place : trial.places)
    if (place.column % 2 == 0) place.position_m.x() += 0.12;
  expect_straightened(trial, true);
}

// Lodged plots, whose canopy leans towards the next ones.
TEST(Straighten, PutsAColumnBetweenAWideAndANarrowGapBack) {
  const TrialLayout sown = known_trial({0, 0, 0}, 6);
  TrialLayout leaning = sown;
  for (TrialPlace& place : leaning.places)
    if (place.column == 3) place.position_m.x() += 0.25;
  const CanopyRaster raster = canopy_of(leaning);
  Lattice lattice = lattice_of(leaning, raster);
  lattice.aligned = true;
  straighten(lattice);
  for (std::size_t i = 0; i < sown.places.size(); ++i)
    EXPECT_NEAR(lattice.places[i].c_m, sown.box(sown.places[i]).center.y(), 0.012) << i;
}

// Plots that touch; the leaves of the outer ones hang 0.2 m over, and there is an alley.
TEST(Straighten, KeepsTheStepsOfPlotsThatTouch) {
  constexpr double kAlley_m = 2;
  TrialLayout trial = known_trial({0, 0, 0}, 6);
  for (TrialPlace& place : trial.places)
    place.position_m.x() = 2 + 1.5 * (place.column - 1) + (place.column > 4 ? kAlley_m : 0);
  const CanopyRaster raster = raster_of(14, 14, [&](double x, double y) {
    const auto covers = [&](const TrialPlace& place) {
      PlotBox box = trial.box(place);
      if (place.column == 1 || place.column >= 4) box.width_m += 0.4;
      return box.contains({x, y});
    };
    return std::ranges::any_of(trial.places, covers) ? 0.8 : 0.0;
  });
  Lattice lattice = lattice_of(trial, raster);
  lattice.c.touching_m = 1.5;
  straighten(lattice);
  const auto c_m = [&](int column) {
    return lattice.places[static_cast<std::size_t>(column - 1)].c_m;
  };
  for (const int column : {2, 3, 4, 6}) EXPECT_NEAR(c_m(column) - c_m(column - 1), 1.5, 1e-9);
  EXPECT_NEAR(c_m(5) - c_m(4), 1.5 + kAlley_m, 0.02);
  EXPECT_NEAR(c_m(1), 2, 0.02);
}

TEST(Straighten, KeepsAnAlleyBesideANarrowGap) {
  TrialLayout trial = known_trial({0, 0, 0}, 8);
  for (TrialPlace& place : trial.places) {
    if (place.column > 3) place.position_m.x() += 1.9;
    if (place.column > 4) place.position_m.x() -= 0.12;
  }
  expect_straightened(trial, true);
}

// Plots that are turned by 0.01 about the view's axes.
TEST(Straighten, MeasuresHowTheRowsRun) {
  constexpr double kTurn = 0.01;
  TrialLayout trial = known_trial({0, 0, 0});
  trial.column_axis = Eigen::Vector2d(1, kTurn).normalized();
  trial.row_axis = Eigen::Vector2d(-kTurn, 1).normalized();
  const CanopyRaster raster = canopy_of(trial);
  Lattice lattice = lattice_of(trial, raster);
  straighten(lattice);
  EXPECT_NEAR(lattice.r_per_c, -kTurn, 0.001);
  EXPECT_NEAR(lattice.c_per_r, kTurn, 0.001);
}

}  // namespace
}  // namespace plotscan::plots
