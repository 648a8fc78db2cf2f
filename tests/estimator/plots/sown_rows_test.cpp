// SPDX-License-Identifier: Apache-2.0
#include "plots/internal/sown_rows.h"

#include <cmath>

#include "known_trial.h"
#include <gtest/gtest.h>

namespace plotscan::plots {
namespace {

// Stems near their row and blades farther off, of an optical depth that adds up between rows.
double leaves(double off_m, double stems_m, double blades_m) {
  return 1.2 * std::exp(-0.5 * std::pow(off_m / stems_m, 2)) +
         0.8 * std::exp(-0.5 * std::pow(off_m / blades_m, 2));
}

// The trial's plots sown in rows along their length, evenly spaced across the width.
CanopyRaster sown_canopy(const TrialLayout& trial, int rows, double stems_m, double blades_m) {
  const Eigen::Vector2d far = trial.box(trial.places.back()).center;
  const double spacing_m = trial.width_m / rows;
  return raster_of(far.x() + 3, far.y() + 2.5, [&](double x, double y) {
    double depth = 0;
    for (const TrialPlace& place : trial.places) {
      const Eigen::Vector2d off = trial.box(place).box_from_world({x, y});
      if (std::abs(off.x()) > 0.5 * trial.length_m) continue;
      for (int row = 0; row < rows; ++row)
        depth += leaves(off.y() - (row + 0.5) * spacing_m + 0.5 * trial.width_m, stems_m, blades_m);
    }
    return 1 - std::exp(-depth);
  });
}

struct SownField {
  int rows;
  double stems_m, blades_m;
};

// The blades of the last ones close every gap: only the stems between them tell rows apart.
TEST(SownRows, AreFoundWithTheirSpacing) {
  const TrialLayout trial = known_trial({0, 0});
  for (const auto& [rows, stems_m, blades_m] : {SownField{2, 0.12, 0.2}, SownField{3, 0.08, 0.15},
                                                SownField{5, 0.06, 0.1}, SownField{3, 0.12, 0.3}}) {
    const CanopyRaster raster = sown_canopy(trial, rows, stems_m, blades_m);
    Lattice lattice = lattice_of(trial, raster);
    lattice.c.size_m -= 0.2;  // what an outline by half the depth may miss
    const std::optional<SownRows> found = sown_rows_along(lattice.turned());
    ASSERT_TRUE(found) << rows << " rows, blades " << blades_m;
    EXPECT_EQ(found->rows, rows) << blades_m;
    EXPECT_NEAR(found->extent_m(), trial.width_m, 0.03) << rows << " rows, blades " << blades_m;
    EXPECT_FALSE(sown_rows_along(lattice)) << rows;  // along the rows the canopy is even
  }
}

TEST(SownRows, AreNoneInAnEvenCanopy) {
  const TrialLayout trial = known_trial({0, 0});
  for (const double blur_m : {0.05, 0.12, 0.3}) {
    const CanopyRaster raster = canopy_of(trial, 1.5, blur_m);
    const Lattice lattice = lattice_of(trial, raster);
    EXPECT_FALSE(sown_rows_along(lattice)) << blur_m;
    EXPECT_FALSE(sown_rows_along(lattice.turned())) << blur_m;
  }
}

}  // namespace
}  // namespace plotscan::plots
