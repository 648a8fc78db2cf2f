// SPDX-License-Identifier: Apache-2.0
#include "methods/dhami2020/internal/lattice.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "core/angle.h"
#include "core/random.h"
#include "methods/dhami2020/internal/plot_grid.h"

namespace plotscan::methods::dhami2020 {
namespace {

using Centers = std::vector<Eigen::Vector2d>;

// The grid of the paper's wheat field: 4 rows of 28, the two axes not quite perpendicular.
struct Kentland {
  Eigen::Vector2d column_step{1.122, 0.956};
  Eigen::Vector2d row_step{-3.25, 3.85};
  PlotBox plot{.center = Eigen::Vector2d::Zero(),
               .width_m = 1.2,
               .length_m = 4,
               .heading_rad = std::atan2(3.85, -3.25)};
  Eigen::Vector2d at(int row, int column) const {
    return Eigen::Vector2d(-20, -20) + row * row_step + column * column_step;
  }
  Centers centers() const {
    Centers all;
    for (int row = 0; row < 4; ++row) {
      for (int column = 0; column < 28; ++column) all.push_back(at(row, column));
    }
    return all;
  }
};

void jitter(Centers& centers, double sigma_m) {
  RandomStream random(5, random_purpose("test/jitter"), 0);
  for (auto& center : centers)
    center += sigma_m * Eigen::Vector2d(random.normal(), random.normal());
}

// How far the lattice is from the true grid at the true plots.
double worst_error_m(const Lattice& lattice, const Kentland& field) {
  double worst = 0;
  for (const auto& center : field.centers())
    worst = std::max(worst, (lattice.point(lattice.nearest(center)) - center).norm());
  return worst;
}

TEST(Lattice, IsExactOnExactCenters) {
  const Kentland field;
  const auto lattice = fit_lattice(field.centers(), field.plot);
  ASSERT_TRUE(lattice);
  EXPECT_EQ(lattice->agreeing, 112u);
  EXPECT_LT(worst_error_m(*lattice, field), 1e-3);
  EXPECT_NEAR(lattice->steps.col(1).norm(), field.column_step.norm(), 1e-4);
  EXPECT_NEAR(lattice->steps.col(0).norm(), field.row_step.norm(), 1e-4);
}

// The authors had to turn their voted heading by 0.03 rad by hand.
TEST(Lattice, CorrectsAVotedHeadingThatIsOff) {
  Kentland field;
  field.plot.heading_rad += 0.03;
  Centers centers = field.centers();
  jitter(centers, 0.05);
  const auto lattice = fit_lattice(centers, field.plot);
  ASSERT_TRUE(lattice);
  EXPECT_GE(lattice->agreeing, 110u);
  EXPECT_LT(worst_error_m(*lattice, field), 0.1);
}

TEST(Lattice, StandsHalfOfTheClustersWrong) {
  const Kentland field;
  Centers centers = field.centers();
  jitter(centers, 0.05);
  RandomStream random(6, random_purpose("test/outliers"), 0);
  for (auto& center : centers) {  // half of them strewn over the field's surroundings
    if (random.uniform() < 0.5) center = {random.uniform(-40, 20), random.uniform(-25, 25)};
  }
  const auto lattice = fit_lattice(centers, field.plot);
  ASSERT_TRUE(lattice);
  EXPECT_LT(worst_error_m(*lattice, field), 0.15);
}

// k-means' typical failure: one cluster over two plots, two over one.
TEST(Lattice, StandsMergedAndSplitPlots) {
  const Kentland field;
  Centers centers;
  RandomStream random(8, random_purpose("test/merges"), 0);
  const Eigen::Vector2d quarter = field.plot.length_axis() * field.plot.length_m / 4;
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 28; ++column) {
      const double kind = random.uniform();
      if (kind < 0.15 && column < 27) {
        centers.push_back((field.at(row, column) + field.at(row, column + 1)) / 2);
        ++column;
      } else if (kind < 0.3) {
        centers.push_back(field.at(row, column) - quarter);
        centers.push_back(field.at(row, column) + quarter);
      } else {
        centers.push_back(field.at(row, column));
      }
    }
  }
  const auto lattice = fit_lattice(centers, field.plot);
  ASSERT_TRUE(lattice);
  EXPECT_LT(worst_error_m(*lattice, field), 0.15);
}

TEST(Lattice, DoesNotHalveTheSpacingOfSmallPlots) {
  // Gaps as wide as the plots: the half spacing would hold every centre too.
  const PlotBox plot{.center = {0, 0}, .width_m = 1, .length_m = 2, .heading_rad = 0};
  Centers centers;
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 8; ++column) centers.emplace_back(4.4 * row, 2.2 * column);
  }
  centers.emplace_back(2.2, 1.1);
  const auto lattice = fit_lattice(centers, plot);
  ASSERT_TRUE(lattice);
  EXPECT_NEAR(lattice->steps.col(0).norm(), 4.4, 1e-3);
  EXPECT_NEAR(lattice->steps.col(1).norm(), 2.2, 1e-3);
}

// Steps learnt in a corner are 2 % off: at the other end that is more than half a plot.
TEST(Lattice, IsCarriedOverAFieldByItsCanopy) {
  const Kentland field;
  std::vector<Eigen::Vector3f> canopy;
  RandomStream random(2, random_purpose("test/carry"), 0);
  for (const auto& center : field.centers()) {
    for (int i = 0; i < 500; ++i) {
      const Eigen::Vector2d at = center + random.uniform(-2, 2) * field.plot.length_axis() +
                                 random.uniform(-0.6, 0.6) * field.plot.width_axis();
      canopy.emplace_back(static_cast<float>(at.x()), static_cast<float>(at.y()), 0.5f);
    }
  }
  Lattice learnt{.origin = field.at(0, 0), .many_rows = true, .many_columns = true};
  learnt.steps << 1.01 * field.row_step, 1.02 * field.column_step;
  EXPECT_GT((learnt.point({3, 27}) - field.at(3, 27)).norm(), 0.5);
  const Lattice carried = carried_over(learnt, field.plot, canopy);
  for (const Eigen::Vector2i& corner : {Eigen::Vector2i(0, 27), {3, 0}, {3, 27}}) {
    EXPECT_LT((carried.point(corner) - field.at(corner.x(), corner.y())).norm(), 0.08);
  }
}

TEST(Lattice, KnowsWhichAxesItHasSeen) {
  const PlotBox plot{.center = {0, 0}, .width_m = 1.5, .length_m = 4, .heading_rad = 30 * kDegrees};
  Centers row;
  for (int column = 0; column < 6; ++column)
    row.push_back(Eigen::Vector2d(3, 4) + 2.0 * column * plot.width_axis());
  const auto one_row = fit_lattice(row, plot);
  ASSERT_TRUE(one_row);
  EXPECT_FALSE(one_row->many_rows);
  EXPECT_TRUE(one_row->many_columns);
  EXPECT_NEAR(one_row->steps.col(1).norm(), 2, 1e-3);

  const auto one_plot = fit_lattice(Centers{{7, 8}}, plot);
  ASSERT_TRUE(one_plot);
  EXPECT_FALSE(one_plot->many_rows || one_plot->many_columns);
  EXPECT_LT((one_plot->origin - Eigen::Vector2d(7, 8)).norm(), 1e-9);
  EXPECT_FALSE(fit_lattice({}, plot));
}

TEST(Lattice, DoesNotBreakOnRowsWithOffsets) {
  const PlotBox plot{.center = {0, 0}, .width_m = 1.5, .length_m = 4, .heading_rad = 0};
  Centers centers;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 10; ++column) {
      centers.emplace_back(5.0 * row, 2.0 * column + 0.7 * row * row);
    }
  }
  const auto lattice = fit_lattice(centers, plot);
  ASSERT_TRUE(lattice);
  EXPECT_GE(lattice->agreeing, 10u);
}

}  // namespace
}  // namespace plotscan::methods::dhami2020
