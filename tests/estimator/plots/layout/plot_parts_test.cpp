// SPDX-License-Identifier: Apache-2.0
#include "plots/layout/internal/plot_parts.h"

#include <gtest/gtest.h>

namespace plotscan::plots {
namespace {

// Levels of a profile's cells, one weight for all.
ProfileSums profile_of(const std::vector<std::pair<int, double>>& stretches) {
  CanopyProfile profile;
  for (const auto& [cells, level] : stretches) {
    profile.mean.insert(profile.mean.end(), static_cast<std::size_t>(cells), level);
    profile.weight.insert(profile.weight.end(), static_cast<std::size_t>(cells), 1);
  }
  return ProfileSums(profile);
}

constexpr int kBand = 9;

// Plots of two bands of 9 cells, with `inside` between them and `gap` after.
struct Line {
  std::vector<std::pair<int, double>> stretches = {{10, 0}};
  std::vector<int> begins = {};
  int cells = 10;

  void add(int width, double level) {
    stretches.emplace_back(width, level);
    cells += width;
  }
  void band() {
    begins.push_back(cells);
    add(kBand, 1);
  }
};

Line pairs(int plots, std::pair<int, double> inside, std::pair<int, double> gap) {
  Line line;
  for (int i = 0; i < plots; ++i) {
    line.band();
    line.add(inside.first, inside.second);
    line.band();
    line.add(gap.first, gap.second);
  }
  return line;
}

std::optional<JoinedParts> joined(const Line& line) {
  return joined_parts(std::vector{profile_of(line.stretches)}, {line.begins}, kBand);
}

// A row stands between two pairs of rows, and none between the plots.
TEST(PlotParts, BandsWithCanopyBetweenThemArePartsOfAPlot) {
  const auto plots = joined(pairs(6, {9, 0.6}, {10, 0}));
  ASSERT_TRUE(plots);
  EXPECT_EQ(plots->size, 27);
  EXPECT_EQ(plots->begins, (std::vector<std::vector<int>>{{10, 47, 84, 121, 158, 195}}));
}

TEST(PlotParts, GapsThatAreAllOpenOrAllClosedAreBetweenPlots) {
  EXPECT_FALSE(joined(pairs(6, {9, 0}, {10, 0})));
  EXPECT_FALSE(joined(pairs(6, {9, 0.1}, {10, 0})));
  EXPECT_FALSE(joined(pairs(6, {9, 0.6}, {10, 0.6})));
}

// Leaves close the narrow gaps of pairs of plots, and not the wide ones.
TEST(PlotParts, NarrowGapsMayCloseWhereWideOnesDoNot) {
  EXPECT_FALSE(joined(pairs(6, {4, 0.6}, {12, 0})));
}

TEST(PlotParts, AnAlleyMakesNoParts) {
  Line line = pairs(3, {4, 0.5}, {4, 0.5});
  line.add(30, 0);
  for (int i = 0; i < 6; ++i) {
    line.band();
    line.add(4, 0.5);
  }
  EXPECT_FALSE(joined(line));
}

// A plot of which one part failed is left out, as long as most have both.
TEST(PlotParts, TakesThePlotsThatHaveAllTheirParts) {
  Line line = pairs(5, {9, 0.6}, {10, 0});
  line.band();
  line.add(10, 0);
  const auto plots = joined(line);
  ASSERT_TRUE(plots);
  EXPECT_EQ(plots->begins.front().size(), 5);
}

TEST(PlotParts, OneBandHasNoGaps) {
  Line line;
  line.band();
  EXPECT_FALSE(joined(line));
}

}  // namespace
}  // namespace plotscan::plots
