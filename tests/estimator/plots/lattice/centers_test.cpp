// SPDX-License-Identifier: Apache-2.0
#include "plots/lattice/internal/centers.h"

#include <gtest/gtest.h>

#include "core/random.h"
#include "estimator/plots/known_trial.h"

namespace plotscan::plots {
namespace {

// Moves the places off the plots by up to 10 cm either way; the canopy tells by how much.
void expect_shifts(Lattice lattice) {
  std::vector<Eigen::Vector2d> moved_m;
  for (Place& place : lattice.places) {
    RandomStream random(5, random_purpose("test/shift"), moved_m.size());
    moved_m.emplace_back(random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1));
    place.r_m += moved_m.back().x();
    place.c_m += moved_m.back().y();
  }
  const auto r = measured_shifts(lattice), c = measured_shifts(lattice.turned());
  ASSERT_EQ(r.size(), moved_m.size());
  for (std::size_t i = 0; i < moved_m.size(); ++i) {
    ASSERT_TRUE(r[i] && c[i]);
    EXPECT_NEAR(*r[i], -moved_m[i].x(), 0.015);
    EXPECT_NEAR(*c[i], -moved_m[i].y(), 0.015);
  }
}

TEST(MeasuredShifts, AreByHowMuchThePlacesWereMoved) {
  const TrialLayout trial = known_trial({0, 0, 0});
  const CanopyRaster raster = canopy_of(trial);
  expect_shifts(lattice_of(trial, raster));
}

// Young plants in two rows 1 m apart: nothing stands at the sides, half a metre from them.
TEST(MeasuredShifts, AreThoseOfRowsFarWithinThePlot) {
  TrialLayout trial = known_trial({0, 0, 0}, 4);
  trial.width_m = 2;
  trial.column_pitch_m = 2.9;
  for (TrialPlace& place : trial.places) place.position_m.x() += place.column - 1;
  const CanopyRaster raster = sown_canopy(trial, 2, 0.05, 0.09);
  expect_shifts(lattice_of(trial, raster));
}

// Leaves of the only neighbour close half the gap of 10 cm: a plot's own canopy stays where it is.
TEST(MeasuredShifts, AreNotThoseOfTheNeighboursCanopy) {
  TrialLayout trial = known_trial({0}, 2);
  trial.column_pitch_m = 1.6;
  trial.places.back().position_m.x() = 2 + 1.6;
  const CanopyRaster raster = canopy_of(trial, 1.5, 0.12);
  Lattice lattice = lattice_of(trial, raster);
  lattice.r.blur_m = lattice.c.blur_m = 0.12;
  for (const std::optional<double>& shift_m : measured_shifts(lattice.turned())) {
    ASSERT_TRUE(shift_m);
    EXPECT_NEAR(*shift_m, 0, 0.005);
  }
}

TEST(MeasuredShifts, AreNoneWhereTheCanopyLiesElsewhere) {
  const TrialLayout trial = known_trial({0}, 1);
  const CanopyRaster raster = canopy_of(trial);
  Lattice lattice = lattice_of(trial, raster);
  lattice.places.front().r_m += 0.5;
  EXPECT_FALSE(measured_shifts(lattice).front());
}

}  // namespace
}  // namespace plotscan::plots
