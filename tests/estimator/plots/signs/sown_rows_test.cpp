// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "estimator/plots/known_trial.h"
#include "plots/signs/field_signs.h"

namespace plotscan::plots {
namespace {

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

// Edges that are steep where stems end and drawn out by blades: no one blur of a box is so.
TEST(SownRows, AreNoneInAnEvenCanopyWithTwoKindsOfEdges) {
  const TrialLayout trial = known_trial({0, 0});
  const CanopyRaster raster = canopy_in_plots(trial, [&](const Eigen::Vector2d& off) {
    if (std::abs(off.x()) > 0.5 * trial.length_m) return 0.0;
    return 0.9 * blurred_box(off.y(), trial.width_m, 0.04) +
           0.9 * blurred_box(off.y(), trial.width_m, 0.3);
  });
  EXPECT_FALSE(sown_rows_along(lattice_of(trial, raster).turned()));
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
