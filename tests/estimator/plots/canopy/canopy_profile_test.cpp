// SPDX-License-Identifier: Apache-2.0
#include "plots/canopy/canopy_profile.h"

#include <limits>

#include <gtest/gtest.h>

#include "core/random.h"
#include "core/statistics.h"
#include "estimator/plots/known_trial.h"

namespace plotscan::plots {
namespace {

// 30 x 10 m of canopy drawn evenly from 0 to 1, for stretches of so many cells along r.
CanopyRaster noise_raster(int stretch) {
  return raster_of(30, 10, [&](double a_m, double b_m) {
    const auto a = static_cast<std::uint64_t>(a_m / 0.05) / static_cast<std::uint64_t>(stretch);
    const auto b = static_cast<std::uint64_t>(b_m / 0.05);
    return RandomStream(4, random_purpose("test/profile"), 1000 * a + b).uniform();
  });
}

CanopyProfile profile_of(const CanopyRaster& raster) {
  const RowView view{.raster = &raster};
  return profile_along_r(view, std::vector<Band>{{0, view.c_cells()}});
}

TEST(CanopyProfile, IsTheMeanAcrossTheLine) {
  const CanopyRaster raster = noise_raster(1);
  const CanopyProfile profile = profile_of(raster);
  ASSERT_EQ(profile.mean.size(), 600U);
  for (const int a : {0, 17, 599}) {
    double sum = 0;
    for (int b = 0; b < 200; ++b) sum += raster.cover(a, a + 1, b, b + 1);
    EXPECT_NEAR(profile.mean[static_cast<std::size_t>(a)], sum / 200, 1e-12);
  }
}

// A mean of 200 numbers drawn evenly has the variance 1 / 12 / 200; no mean is taken to be better
// than 2 % of the greatest.
TEST(CanopyProfile, WeighsByTheVarianceOfAMean) {
  const CanopyProfile profile = profile_of(noise_raster(1));
  const double least = 0.02 * *std::ranges::max_element(profile.mean);
  EXPECT_NEAR(mean(profile.weight) * (1 / 12.0 / 200 + least * least), 1, 0.15);
  EXPECT_NEAR(profile.independent, 600, 60);
}

// Where six cells in a row are alike, six are worth one.
TEST(CanopyProfile, CountsCellsOfOneLeafOnce) {
  EXPECT_NEAR(profile_of(noise_raster(6)).independent, 100, 15);
}

TEST(CanopyProfile, GivesUnseenCellsNoWeight) {
  std::vector<std::uint32_t> cover(40 * 30, 0);
  for (std::size_t i = 0; i < 30; ++i) cover[20 * 30 + i] = kUnseen;
  const CanopyProfile profile = profile_of({{}, 0.05, 40, 30, cover});
  EXPECT_EQ(profile.weight[20], 0);
  EXPECT_GT(profile.weight[19], 0);
}

// A triangle's middle lies at two thirds of its length.
TEST(ProfileSums, CentroidOfATriangleLiesAtTwoThirds) {
  CanopyProfile ramp;
  for (int i = 0; i < 300; ++i) {
    ramp.mean.push_back(i + 0.5);
    ramp.weight.push_back(1);
  }
  EXPECT_NEAR(ProfileSums(ramp).centroid(0, 300), 200, 0.01);
}

// The least that pieces with levels of their own leave of the cells [begin, end), all ways to break
// them at multiples of eight tried one by one.
double least_of_pieces(const ProfileSums& sums, int begin, int end, double price) {
  std::vector<int> places;
  for (int at = 8; at < end; at += 8)
    if (at > begin) places.push_back(at);
  double least = std::numeric_limits<double>::infinity();
  for (unsigned chosen = 0; chosen < 1U << places.size(); ++chosen) {
    double misfit = 0;
    int from = begin;
    for (std::size_t i = 0; i < places.size(); ++i) {
      if ((chosen >> i & 1) == 0) continue;
      misfit += sums.squares(from, places[i], sums.mean(from, places[i])) + price;
      from = places[i];
    }
    least = std::min(least, misfit + sums.squares(from, end, sums.mean(from, end)));
  }
  return least;
}

TEST(ProfileSums, FreeEndsAreTheBestOfAllPieces) {
  CanopyProfile profile;
  for (int i = 0; i < 70; ++i) {
    RandomStream random(6, random_purpose("test/free_ends"), static_cast<std::uint64_t>(i));
    profile.mean.push_back((i > 15 && i < 40 ? 0.6 : 0.1) + 0.1 * random.normal());
    profile.weight.push_back(50 + 50 * random.uniform());
  }
  constexpr double kPrice = 3;
  ProfileSums sums(profile);
  EXPECT_NEAR(sums.until(30).misfit, sums.squares(0, 30, sums.mean(0, 30)), 1e-9);
  EXPECT_EQ(sums.from(30).level, sums.mean(30, 70));
  sums.free_ends(kPrice);
  for (const int cell : {0, 3, 8, 21, 30, 62, 70}) {
    EXPECT_NEAR(sums.until(cell).misfit, least_of_pieces(sums, 0, cell, kPrice), 1e-9) << cell;
    EXPECT_NEAR(sums.from(cell).misfit, least_of_pieces(sums, cell, 70, kPrice), 1e-9) << cell;
  }
  EXPECT_EQ(sums.until(30).level, sums.mean(26, 30));
  EXPECT_EQ(sums.from(10).level, sums.mean(10, 14));
}

TEST(EqualParts, CoverABandWithoutGaps) {
  const std::vector<Band> parts = equal_parts({3, 20}, 4);
  ASSERT_EQ(parts.size(), 4U);
  EXPECT_EQ(parts.back().end, 20);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    EXPECT_NEAR(parts[i].size(), 17 / 4.0, 1);
    EXPECT_EQ(parts[i].begin, i > 0 ? parts[i - 1].end : 3);
  }
}

}  // namespace
}  // namespace plotscan::plots
