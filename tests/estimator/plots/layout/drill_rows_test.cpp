// SPDX-License-Identifier: Apache-2.0
#include "plots/layout/drill_rows.h"

#include <gtest/gtest.h>

namespace plotscan::plots {
namespace {

// Middles of plots' rows: `rows` at `spacing`, `gap` between the sown widths; the first sown width
// begins at 10.
std::vector<double> rows_of(int plots, int rows, double spacing, double gap) {
  std::vector<double> middles;
  for (int plot = 0; plot < plots; ++plot) {
    for (int row = 0; row < rows; ++row)
      middles.push_back(10 + plot * (rows * spacing + gap) + (row + 0.5) * spacing);
  }
  return middles;
}

TEST(DrilledPlots, AreAsWideAsTheirRowsTimesTheSpacing) {
  for (const int rows : {2, 3, 5, 7}) {
    for (const double gap : {4.0, 10.0, 30.0}) {
      const auto plots = drilled_plots({rows_of(6, rows, 8, gap)}, 22, 3);
      ASSERT_TRUE(plots) << rows << ' ' << gap;
      EXPECT_EQ(plots->rows, rows);
      EXPECT_NEAR(plots->spacing, 8, 1e-9);
      ASSERT_EQ(plots->begins.front().size(), 6U);
      for (int plot = 0; plot < 6; ++plot) {
        EXPECT_NEAR(plots->begins.front()[static_cast<std::size_t>(plot)],
                    10 + plot * (rows * 8 + gap), 1e-9);
      }
    }
  }
}

// Two of 35 steps lead from plot to plot.
TEST(DrilledPlots, MayBeFewOfManyRows) {
  const auto plots = drilled_plots({rows_of(3, 12, 8, 20)}, 22, 3);
  ASSERT_TRUE(plots);
  EXPECT_EQ(plots->rows, 12);
  EXPECT_EQ(plots->begins.front().size(), 3U);
}

TEST(DrilledPlots, AreFilledInWhereTwoRowsWereNotSeen) {
  std::vector<double> middles = rows_of(6, 3, 8, 10);
  middles.erase(middles.begin() + 7, middles.begin() + 9);
  const auto plots = drilled_plots({middles}, 22, 3);
  ASSERT_TRUE(plots);
  ASSERT_EQ(plots->begins.front().size(), 6U);
  EXPECT_NEAR(plots->begins.front()[2], 10 + 2 * 34, 1e-9);
}

// Steps over missing plots are wider than those to the next by more than these than those in a
// plot.
TEST(DrilledPlots, AreToldFromMissingOnes) {
  std::vector<std::vector<double>> lines;
  for (const std::size_t missing : {2U, 5U, 8U}) {
    lines.push_back(rows_of(11, 3, 12, 6));
    for (const std::size_t plot : {missing + 1, missing})
      lines.back().erase(lines.back().begin() + static_cast<std::ptrdiff_t>(3 * plot),
                         lines.back().begin() + static_cast<std::ptrdiff_t>(3 * plot + 3));
  }
  const auto plots = drilled_plots(lines, 22, 3);
  ASSERT_TRUE(plots);
  EXPECT_EQ(plots->rows, 3);
  EXPECT_NEAR(plots->spacing, 12, 1e-9);
}

// Three plots of four rows before an alley, and three behind it.
TEST(DrilledPlots, AreToldFromThoseBetweenAlleys) {
  for (const int rows : {2, 4}) {
    std::vector<double> middles = rows_of(3, rows, 10, 8);
    for (const double middle : rows_of(3, rows, 10, 8)) middles.push_back(middle + 200);
    const auto plots = drilled_plots({middles}, 22, 3);
    ASSERT_TRUE(plots) << rows;
    EXPECT_EQ(plots->rows, rows);
    EXPECT_NEAR(plots->spacing, 10, 1e-9);
  }
}

TEST(DrilledPlots, AreNoneOfPlotsOrOfRowsWithoutAlleys) {
  EXPECT_FALSE(drilled_plots({rows_of(8, 1, 30, 20)}, 22, 3)) << "wide plots";
  EXPECT_FALSE(drilled_plots({rows_of(1, 20, 8, 0)}, 22, 3)) << "rows of one field";
  EXPECT_FALSE(drilled_plots({{}}, 22, 3));
  EXPECT_FALSE(drilled_plots({{5, 9, 30, 33, 60, 64, 68, 72, 90}}, 22, 3)) << "rows anywhere";
}

}  // namespace
}  // namespace plotscan::plots
