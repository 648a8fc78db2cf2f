// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "estimator/plots/known_trial.h"
#include "plots/lattice/lattice.h"

namespace plotscan::plots {
namespace {

// The size where the depth falls through half is the box's, however wide its edges are blurred;
// places within a raster's cells are rounded.
TEST(FitEdges, FindsTheSizeAndTheBlurOfKnownPlots) {
  const TrialLayout trial = known_trial({0, 0});
  for (const double blur_m : {0.06, 0.12}) {
    const CanopyRaster raster = canopy_of(trial, 1.2, blur_m);
    Lattice lattice = lattice_of(trial, raster);
    lattice.r.size_m += 0.12;
    lattice.c.size_m -= 0.1;
    fit_edges(lattice);
    EXPECT_NEAR(lattice.r.size_m, 3, 0.02);
    EXPECT_NEAR(lattice.c.size_m, 1.5, 0.02);
    EXPECT_NEAR(lattice.r.blur_m, blur_m, 0.025);
    EXPECT_NEAR(lattice.c.blur_m, blur_m, 0.025);
  }
}

// Plots so near each other that their leaves meet: the canopy does not fall to half in the gap.
TEST(FitEdges, TellsAPlotsLeavesFromItsNeighbours) {
  TrialLayout trial = known_trial({0, 0});
  trial.column_pitch_m = 1.65;
  for (TrialPlace& place : trial.places)
    place.position_m.x() = 2 + (place.column - 1) * trial.column_pitch_m;
  const CanopyRaster raster = canopy_of(trial, 1.2, 0.15);
  Lattice lattice = lattice_of(trial, raster);
  fit_edges(lattice);
  EXPECT_NEAR(lattice.c.size_m, 1.5, 0.03);
}

TEST(FitEdges, StaysNearTheLayoutsBands) {
  const TrialLayout trial = known_trial({0, 0});
  const CanopyRaster raster = canopy_of(trial);
  Lattice lattice = lattice_of(trial, raster);
  lattice.r.band_m = 2.5;
  fit_edges(lattice);
  EXPECT_NEAR(lattice.r.size_m, 2.8, 1e-9);
}

}  // namespace
}  // namespace plotscan::plots
