// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <numbers>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../../temporary_folder.h"
#include "core/angle.h"
#include "core/error.h"
#include "planting/plot_layout.h"

namespace plotscan::planting {
namespace {

using plotscan::testing::message_of;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

PlotGridDescription three_by_four() {
  return {.width_m = 2,
          .length_m = 5,
          .gap_width_m = 1,
          .gap_length_m = 3,
          .rows = {{.plots = 4}, {.plots = 4}, {.plots = 4}}};
}

const farm::Plot& plot_at(const std::vector<farm::Plot>& plots, int row, int column) {
  for (const farm::Plot& plot : plots) {
    if (plot.row == row && plot.column == column) return plot;
  }
  throw std::logic_error("no such plot");
}

TEST(PlotGrid, SerpentineNumbersTurnRoundAtTheEndOfARow) {
  PlotGridDescription grid = three_by_four();
  const std::vector<farm::Plot> by_rows = grid_plots(grid);
  grid.numbering = PlotNumbering::serpentine;
  grid.first_number = 101;
  const std::vector<farm::Plot> plots = grid_plots(grid);
  for (int row = 1; row <= 3; ++row) {
    for (int column = 1; column <= 4; ++column) {
      const int place = row == 2 ? 4 - column : column - 1;
      const farm::Plot& plot = plot_at(plots, row, column);
      EXPECT_EQ(plot.id, 101u + 4 * (row - 1) + place);
      EXPECT_EQ(plot.box.center, plot_at(by_rows, row, column).box.center) << "the place is kept";
    }
  }
  for (std::size_t i = 1; i < plots.size(); ++i) {
    EXPECT_EQ(plots[i].id, plots[i - 1].id + 1) << "in the order of their numbers";
    const Eigen::Vector2d step = plots[i].box.center - plots[i - 1].box.center;
    EXPECT_NEAR(step.norm(), i % 4 == 0 ? 8 : 3, 1e-12) << "always to a neighbour";
  }
}

TEST(PlotGrid, TheSeedTurnsAGridOfRandomHeading) {
  PlotGridDescription grid = three_by_four();
  EXPECT_EQ(turned(grid, 5).heading_rad, 0) << "not asked for";
  grid.random_heading = true;
  std::array<int, 4> quadrants = {};
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    const double heading = turned(grid, seed).heading_rad;
    ASSERT_GE(heading, 0);
    ASSERT_LT(heading, 2 * std::numbers::pi);
    EXPECT_EQ(turned(grid, seed).heading_rad, heading);
    ++quadrants[static_cast<std::size_t>(heading / (std::numbers::pi / 2))];
  }
  for (const int count : quadrants) EXPECT_NEAR(count, 100, 35);  // 4 standard deviations
}

TEST(PlotGrid, AlleysTakeThePlaceOfGaps) {
  PlotGridDescription grid = three_by_four();
  grid.column_alleys_m = {{2, 2.5}};
  grid.row_alleys_m = {{1, 0.5}, {2, 6}};
  const std::vector<farm::Plot> plots = grid_plots(grid);
  const auto gap_x = [&](int column) {
    return plot_at(plots, 1, column + 1).box.center.x() - plot_at(plots, 1, column).box.center.x() -
           2;
  };
  EXPECT_NEAR(gap_x(1), 1, 1e-12);
  EXPECT_NEAR(gap_x(2), 2.5, 1e-12);
  EXPECT_NEAR(gap_x(3), 1, 1e-12);
  const auto gap_y = [&](int row) {
    return plot_at(plots, row + 1, 4).box.center.y() - plot_at(plots, row, 4).box.center.y() - 5;
  };
  EXPECT_NEAR(gap_y(1), 0.5, 1e-12);
  EXPECT_NEAR(gap_y(2), 6, 1e-12);
  const Eigen::Vector2d middle =
      (plot_at(plots, 1, 1).box.center + plot_at(plots, 3, 4).box.center) / 2;
  EXPECT_NEAR(middle.norm(), 0, 1e-12) << "the grid stays centred";
}

TEST(PlotGrid, SkewTurnsTheAxisFromRowToRow) {
  PlotGridDescription grid = three_by_four();
  grid.heading_rad = 20 * kDegrees;
  grid.skew_rad = 10 * kDegrees;
  const std::vector<farm::Plot> plots = grid_plots(grid);
  const Eigen::Vector2d along = plot_at(plots, 2, 2).box.center - plot_at(plots, 2, 1).box.center;
  const Eigen::Vector2d across = plot_at(plots, 2, 2).box.center - plot_at(plots, 1, 2).box.center;
  EXPECT_NEAR(along.norm(), 3, 1e-12);
  EXPECT_NEAR(across.norm(), 8, 1e-12);
  EXPECT_NEAR(std::atan2(along.y(), along.x()), 20 * kDegrees, 1e-12);
  EXPECT_NEAR(std::atan2(across.y(), across.x()), 120 * kDegrees, 1e-12);
  EXPECT_NEAR(plots[0].box.heading_rad, 120 * kDegrees, 1e-12) << "of the length axis";
}

TEST(PlotGrid, OverlappingPlotsAreFoundAmongMany) {
  PlotGridDescription grid = three_by_four();
  grid.rows = std::vector<PlotRowDescription>(60, {.plots = 60});
  grid.heading_rad = 30 * kDegrees;
  std::vector<farm::Plot> plots = grid_plots(grid);
  EXPECT_FALSE(overlapping_plots(plots));
  plots[1234].box.center += 1.01 * plots[1234].box.width_axis();
  const auto pair = overlapping_plots(plots);
  ASSERT_TRUE(pair);
  EXPECT_TRUE(pair->first == 1235 || pair->second == 1235);
  EXPECT_EQ(pair->second - pair->first, 1u) << "neighbours in a row";
  grid.gap_width_m = 0;
  grid.gap_length_m = 0;
  EXPECT_FALSE(overlapping_plots(grid_plots(grid))) << "plots may touch";
}

// Two triangles side by side, and nothing above the first one's slope.
TEST(PlotGrid, APlotOverAHoleIsNotToldThatTheTerrainIsTooSmall) {
  const terrain::Terrain terrain({{0, 0, 0}, {20, 0, 0}, {0, 20, 0}, {20, 20, 0}, {20, 19, 0}},
                                 {{0, 1, 2}, {4, 3, 2}});
  std::vector<farm::Plot> plots(1);
  plots[0].id = 7;
  plots[0].box = {.center = {14, 10}, .width_m = 1, .length_m = 1};
  const auto refusal = [&] {
    return message_of<InputError>([&] { require_on_terrain(plots, terrain, "f.yaml"); });
  };
  EXPECT_THAT(refusal(), AllOf(HasSubstr("plot 7"), HasSubstr("a hole"),
                               Not(HasSubstr("a square terrain of side"))));
  plots[0].box.center = {30, 5};
  EXPECT_THAT(refusal(), HasSubstr("a square terrain of side"));
}

// The overlay that the authors of the paper laid over their field (28 steps one way, 4 the other).
TEST(PlotGrid, TheKentlandLatticeIsExact) {
  const Eigen::Vector2d column(1.122, 0.956);
  const Eigen::Vector2d row(-3.25, 3.85);
  const PlotGridDescription grid{.width_m = 1.2,
                                 .length_m = 4,
                                 .position_m = {3, -7},
                                 .rows = std::vector<PlotRowDescription>(4, {.plots = 28}),
                                 .pitch = PlotPitch{.column_m = column, .row_m = row}};
  const std::vector<farm::Plot> plots = grid_plots(grid);
  ASSERT_EQ(plots.size(), 112u);
  for (const farm::Plot& plot : plots) {
    const Eigen::Vector2d expected =
        Eigen::Vector2d(3, -7) + (plot.column - 14.5) * column + (plot.row - 2.5) * row;
    EXPECT_NEAR((plot.box.center - expected).norm(), 0, 1e-12);
    EXPECT_NEAR(plot.box.heading_rad, std::atan2(3.85, -3.25), 1e-12);
  }
  const double between = std::acos(column.dot(row) / column.norm() / row.norm());
  EXPECT_NEAR(between / kDegrees, 89.7, 0.1) << "not perpendicular";
}

TEST(PlotGrid, SomePlotsAreMissing) {
  PlotGridDescription grid = three_by_four();
  grid.missing = {3, 12};
  EXPECT_TRUE(is_missing(grid, 3, 1));
  EXPECT_FALSE(is_missing(grid, 4, 1));
  grid.missing_rate = 0.2;
  int missing = 0;
  for (std::uint32_t plot = 101; plot <= 10100; ++plot) missing += is_missing(grid, plot, 5);
  EXPECT_NEAR(missing, 2000, 4 * std::sqrt(10000 * 0.2 * 0.8));
}

}  // namespace
}  // namespace plotscan::planting
