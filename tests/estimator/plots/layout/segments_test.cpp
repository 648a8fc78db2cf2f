// SPDX-License-Identifier: Apache-2.0
#include "plots/layout/segments.h"

#include <functional>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "core/random.h"

namespace plotscan::plots {
namespace {

// Bands of 0.8 on ground of 0.1, with noise of sd 0.05 and weights that say so.
CanopyProfile profile_with(const std::vector<int>& begins, int size, int cells,
                           std::uint64_t seed) {
  CanopyProfile profile;
  for (int i = 0; i < cells; ++i) {
    RandomStream random(seed, random_purpose("test/segments"), static_cast<std::uint64_t>(i));
    double canopy = 0.1 + 0.05 * random.normal();
    for (const int begin : begins)
      if (i >= begin && i < begin + size) canopy += 0.7;
    profile.mean.push_back(canopy);
    profile.weight.push_back(1 / (0.05 * 0.05));
  }
  profile.independent = cells;
  return profile;
}

TEST(ProfileSums, AreWhatAddingCellByCellGives) {
  CanopyProfile profile = profile_with({5, 14}, 6, 30, 3);
  for (std::size_t i = 0; i < profile.weight.size(); ++i)
    profile.weight[i] = 1 + 0.3 * static_cast<double>(i);
  const ProfileSums sums(profile);
  for (const auto& [begin, end] : std::vector<std::pair<int, int>>{{0, 30}, {4, 17}, {9, 10}}) {
    double weight = 0, mean = 0, level = 0, line = 0;
    for (int i = begin; i < end; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const double w = profile.weight[at], y = profile.mean[at];
      const double on_line = 0.2 + (0.9 - 0.2) * (i + 0.5 - begin) / (end - begin);
      weight += w;
      mean += w * y;
      level += w * (y - 0.3) * (y - 0.3);
      line += w * (y - on_line) * (y - on_line);
    }
    EXPECT_NEAR(sums.mean(begin, end), mean / weight, 1e-9);
    EXPECT_NEAR(sums.squares(begin, end, 0.3), level, 1e-7);
    EXPECT_NEAR(sums.squares(begin, end, 0.2, 0.9), line, 1e-7);
  }
}

// Squares that bands leave on a line: about a level for each band and each gap, and about lines
// from level to level over the blurred edges.
double squares_left(const ProfileSums& line, const BandShape& shape,
                    const std::vector<int>& begins) {
  double squares = 0, before = 0;
  int last = -shape.blur;  // where the gap begins, less the blur
  for (std::size_t i = 0; i <= begins.size(); ++i) {
    const bool at_end = i == begins.size();
    const int from = last + shape.blur, to = at_end ? line.cells() : begins[i] - shape.blur;
    const double gap = line.mean(from, to);
    squares += line.squares(from, to, gap);
    if (i > 0) squares += line.squares(last - shape.blur, from, before, gap);
    if (at_end) break;
    const int low = begins[i] + shape.blur, high = begins[i] + shape.size - shape.blur;
    before = line.mean(low, high);
    squares += line.squares(to, low, gap, before) + line.squares(low, high, before);
    last = begins[i] + shape.size;
  }
  return squares;
}

// All ways to lay bands on a line, tried one by one.
double least_cost(const ProfileSums& line, const BandShape& shape, int least_gap, double price) {
  double least = std::numeric_limits<double>::infinity();
  std::vector<int> begins;
  const std::function<void(int)> extend = [&](int from) {
    if (!begins.empty())
      least = std::min(least, squares_left(line, shape, begins) +
                                  3 * price * static_cast<double>(begins.size()));
    for (int begin = from; begin + shape.size + shape.blur < line.cells(); ++begin) {
      begins.push_back(begin);
      extend(begin + shape.size + least_gap);
      begins.pop_back();
    }
  };
  extend(shape.blur + 1);
  return least;
}

TEST(BestBands, AreTheBestOfAllThatThereAre) {
  for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
    const std::vector<int> truth = {4, 13, 24};
    const std::vector<ProfileSums> profiles = {ProfileSums(profile_with(truth, 5, 34, seed))};
    const BandShape shape{.size = 5, .blur = 1};
    const Segmentation found = best_bands(profiles, shape, 3, 4);
    EXPECT_EQ(found.begins, truth);
    EXPECT_NEAR(found.misfit + 4 * found.parameters, least_cost(profiles.front(), shape, 3, 4),
                1e-6);
  }
}

// Bands of several heights, one of them next to ground that is half covered.
TEST(BestBands, AreTheBestOfAllOnAnUnevenLine) {
  for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
    const std::vector<int> truth = {3, 12, 25};
    CanopyProfile profile = profile_with({}, 5, 34, seed);
    for (int i = 0; i < 5; ++i) {
      profile.mean[static_cast<std::size_t>(3 + i)] += 0.8;
      profile.mean[static_cast<std::size_t>(12 + i)] += 0.5;
      profile.mean[static_cast<std::size_t>(25 + i)] += 0.65;
    }
    for (std::size_t i = 17; i < 25; ++i) profile.mean[i] += 0.25;
    const std::vector<ProfileSums> profiles = {ProfileSums(profile)};
    const BandShape shape{.size = 5, .blur = 1};
    const Segmentation found = best_bands(profiles, shape, 3, 4);
    EXPECT_EQ(found.begins, truth) << seed;
    EXPECT_NEAR(found.misfit + 4 * found.parameters, least_cost(profiles.front(), shape, 3, 4),
                1e-6);
  }
}

TEST(BestBands, AreSharedByAllProfiles) {
  const std::vector<int> truth = {6, 20};
  // The second band is missing on one of the lines.
  const std::vector<ProfileSums> profiles = {ProfileSums(profile_with(truth, 8, 40, 1)),
                                             ProfileSums(profile_with({6}, 8, 40, 2)),
                                             ProfileSums(profile_with(truth, 8, 40, 3))};
  EXPECT_EQ(best_bands(profiles, {.size = 8, .blur = 1}, 3, 4).begins, truth);
}

TEST(BestBands, OfTheRightSizeExplainMost) {
  const std::vector<ProfileSums> profiles = {ProfileSums(profile_with({6, 22, 38, 54}, 10, 80, 7))};
  const auto cost = [&](int size) {
    const Segmentation bands = best_bands(profiles, {.size = size, .blur = 1}, 3, 4);
    return bands.misfit + 4 * bands.parameters;
  };
  for (const int size : {4, 7, 13, 26}) EXPECT_LT(cost(10), cost(size)) << size;
}

TEST(BestBands, AreNoneOnALevelLine) {
  CanopyProfile level{.mean = std::vector<double>(40, 0.5), .weight = std::vector<double>(40, 400)};
  const std::vector<ProfileSums> profiles = {ProfileSums(level)};
  EXPECT_TRUE(best_bands(profiles, {.size = 8, .blur = 1}, 3, 4).begins.empty());
}

}  // namespace
}  // namespace plotscan::plots
