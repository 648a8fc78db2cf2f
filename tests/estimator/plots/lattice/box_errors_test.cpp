// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include <gtest/gtest.h>

#include "core/random.h"
#include "estimator/plots/known_trial.h"
#include "plots/lattice/lattice.h"

namespace plotscan::plots {
namespace {

// Every plot of the trial sown so far off its place, independently.
constexpr double kSown_m = 0.03;
TrialLayout sown_off(TrialLayout trial, std::uint64_t draw) {
  RandomStream random(8, random_purpose("test/box errors"), draw);
  for (TrialPlace& place : trial.places)
    place.position_m += kSown_m * Eigen::Vector2d(random.normal(), random.normal());
  return trial;
}

// What is found over many draws, root mean squares: how far the fitted centres lie from the places,
// and the rows' direction from theirs; and what the estimator says of both.
struct Errors {
  double along_m = 0, across_m = 0, heading_rad = 0;
  double said_along_m = 0, said_across_m = 0, said_heading_rad = 0;
};

Errors errors_over_draws(const TrialLayout& trial) {
  constexpr int kDraws = 40;
  Errors squares;
  for (std::uint64_t draw = 0; draw < kDraws; ++draw) {
    const CanopyRaster raster = canopy_of(sown_off(trial, draw));
    Lattice lattice = lattice_of(trial, raster);
    straighten(lattice);
    const PlotBoxError said = box_error(lattice, {});
    const auto plots = static_cast<double>(trial.places.size());
    for (std::size_t i = 0; i < trial.places.size(); ++i) {
      const Eigen::Vector2d truth = trial.box(trial.places[i]).center;
      squares.along_m += std::pow(lattice.places[i].r_m - truth.x(), 2) / plots;
      squares.across_m += std::pow(lattice.places[i].c_m - truth.y(), 2) / plots;
    }
    squares.heading_rad += std::pow(lattice.c_per_r, 2);
    squares.said_along_m += std::pow(said.along_m, 2);
    squares.said_across_m += std::pow(said.across_m, 2);
    squares.said_heading_rad += std::pow(said.heading_rad, 2);
  }
  for (double* square : {&squares.along_m, &squares.across_m, &squares.heading_rad,
                         &squares.said_along_m, &squares.said_across_m, &squares.said_heading_rad})
    *square = std::sqrt(*square / kDraws);
  return squares;
}

// Plots that are sown off independently: what is said is twice the error, as that of real canopies
// is alike from plot to plot.
TEST(BoxErrors, AreTwiceThoseOfIndependentCentres) {
  for (const int columns : {5, 10}) {
    const Errors errors = errors_over_draws(known_trial({0, 0, 0, 0}, columns));
    EXPECT_NEAR(errors.said_along_m / errors.along_m, 2, 0.5) << columns;
    EXPECT_NEAR(errors.said_across_m / errors.across_m, 2, 0.5) << columns;
    EXPECT_NEAR(errors.said_heading_rad / errors.heading_rad, 2, 0.7) << columns;
  }
}

TEST(BoxErrors, OfSidesGrowWithTheLeavesSpread) {
  const TrialLayout trial = known_trial({0, 0, 0});
  const CanopyRaster raster = canopy_of(trial);
  Lattice lattice = lattice_of(trial, raster);
  lattice.r.blur_m = 0.1;
  lattice.c.blur_m = 0.2;
  const PlotBoxError error = box_error(lattice, {});
  EXPECT_GT(error.length_m, 0.03);
  EXPECT_LT(error.length_m, 0.1);
  EXPECT_DOUBLE_EQ(error.width_m, 2 * error.length_m);
}

TEST(BoxErrors, OfSidesThatWereToldAreNone) {
  const TrialLayout trial = known_trial({0, 0, 0});
  const CanopyRaster raster = canopy_of(trial);
  const PlotBoxError error = box_error(lattice_of(trial, raster), {.width_m = 1.5});
  EXPECT_EQ(error.width_m, 0);
  EXPECT_GT(error.length_m, 0);
}

}  // namespace
}  // namespace plotscan::plots
