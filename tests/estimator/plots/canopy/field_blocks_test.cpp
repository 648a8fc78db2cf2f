// SPDX-License-Identifier: Apache-2.0
#include "plots/canopy/field_blocks.h"

#include <cmath>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/random.h"

namespace plotscan::plots {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;

constexpr double kSigma_m = 0.01;

// 200 returns a square metre over 20 x 20 m: those of a crop on the southern half, up to crop_m; of
// what is up to beside_m high on squares of side_m in the north; else of the ground.
std::vector<Eigen::Vector3f> field_of(double crop_m, double beside_m = 0, double side_m = 0) {
  std::vector<Eigen::Vector3f> points;
  for (std::uint64_t i = 0; i < 80000; ++i) {
    RandomStream random(6, random_purpose("test/blocks"), i);
    const double x = random.uniform(0, 20), y = random.uniform(0, 20);
    double height_m = 0;
    if (y < 10) height_m = random.uniform(0, crop_m);
    if (y > 12 && y < 12 + side_m && x < side_m) height_m = random.uniform(0, beside_m);
    points.emplace_back(static_cast<float>(x), static_cast<float>(y),
                        static_cast<float>(height_m + kSigma_m * random.normal()));
  }
  return points;
}

std::vector<double> crop_tops_m(const std::vector<Eigen::Vector3f>& points) {
  return FieldBlocks(points, kSigma_m, 2).crop_tops_m();
}

// Bins of heights are 10 % wide.
TEST(FieldBlocks, TheCropsHeightIsThatOfHalfTheVolume) {
  EXPECT_THAT(crop_tops_m(field_of(0.6)), ElementsAre(DoubleNear(0.55, 0.04)));
  EXPECT_THAT(crop_tops_m(field_of(0.6, 3, 3)), ElementsAre(DoubleNear(0.55, 0.04)));
}

// Leaves are 6 % of the returns from the plots' blocks, none of those from the ground's.
TEST(FieldBlocks, SeedlingsStandOut) {
  std::vector<Eigen::Vector3f> points = field_of(0.6);
  for (std::size_t i = 0; i < points.size(); ++i)
    if (RandomStream(6, random_purpose("test/leaf"), i).uniform() > 0.08) points[i].z() = 0;
  const FieldBlocks blocks(points, kSigma_m, 2);
  for (std::size_t number = 0; number < blocks.facts().size(); ++number) {
    const double y = blocks.middle_of(number).y();
    EXPECT_EQ(blocks.facts()[number].stands_out, y < 10) << y;
  }
}

// Trees on 49 m2 are more than half of the volume, beside a crop on 200 m2.
TEST(FieldBlocks, BelowTreesTheCropMayBeLower) {
  EXPECT_THAT(crop_tops_m(field_of(0.6, 5, 7)),
              ElementsAre(DoubleNear(4.5, 0.4), DoubleNear(0.55, 0.04)));
}

// In the south a crop without gaps, in the north plots of 2 m with gaps of 1 m.
// Returns over a rectangle from (0, 0); where plants are sown they scatter.
template <class Sown>
std::vector<Eigen::Vector3f> returns_over(double x_m, double y_m, const Sown& sown) {
  std::vector<Eigen::Vector3f> points;
  for (std::uint64_t i = 0; i < 80000; ++i) {
    RandomStream random(7, random_purpose("test/blocks"), i);
    const double x = random.uniform(0, x_m), y = random.uniform(0, y_m);
    points.emplace_back(static_cast<float>(x), static_cast<float>(y),
                        static_cast<float>(sown(x, y) ? random.uniform(0.1, 0.6) : 0));
  }
  return points;
}

TEST(FieldBlocks, ClosedIsACropWithoutGaps) {
  const FieldBlocks blocks(
      returns_over(20, 20,
                   [](double x, double y) { return y < 8 || (y > 10 && std::fmod(x, 3) < 2); }),
      kSigma_m, 2);
  const std::vector<std::vector<bool>> closed = blocks.closed();
  ASSERT_EQ(closed.size(), 2U);
  for (std::size_t number = 0; number < blocks.facts().size(); ++number) {
    const double y = blocks.middle_of(number).y();
    if (std::abs(y - 9) < 1) continue;  // beside the closed crop, where blocks may hold both
    EXPECT_EQ(closed[0][number], y < 9) << y;
    EXPECT_EQ(closed[1][number], y < 9) << y;
  }
  EXPECT_NEAR(blocks.covered_m2(closed[0]), 20 * 8, 20);
}

// Two plots of 6 m: each is a closed square, none is another crop.
TEST(FieldBlocks, ClosedIsNoPlot) {
  const auto points = returns_over(26, 6, [](double x, double) { return x < 6 || x > 20; });
  EXPECT_TRUE(FieldBlocks(points, kSigma_m, 2).closed().empty());
}

// A strip 3 m wide runs from a closed crop: no square, but the crop goes on in it.
TEST(FieldBlocks, ClosedFollowsOn) {
  const auto is_strip = [](double x) { return x > 6 && x < 9; };
  const FieldBlocks blocks(
      returns_over(20, 20, [&](double x, double y) { return y < 8 || is_strip(x); }), kSigma_m, 2);
  const std::vector<std::vector<bool>> closed = blocks.closed();
  ASSERT_EQ(closed.size(), 2U);
  for (std::size_t number = 0; number < blocks.facts().size(); ++number) {
    const Eigen::Vector2d at = blocks.middle_of(number);
    if (at.y() < 10 || std::abs(at.x() - 6) < 1 || std::abs(at.x() - 9) < 1) continue;
    EXPECT_FALSE(closed[0][number]) << at.transpose();
    EXPECT_EQ(closed[1][number], is_strip(at.x())) << at.transpose();
  }
}

// A crop of 20 x 9 m, and south of it 10 x 9 m of plots whose gaps leaves close.
TEST(FieldBlocks, ClosedIsTheLargestPatchAloneToo) {
  const FieldBlocks blocks(
      returns_over(20, 24, [](double x, double y) { return y > 15 || (y < 9 && x < 10); }),
      kSigma_m, 2);
  const std::vector<std::vector<bool>> closed = blocks.closed();
  ASSERT_EQ(closed.size(), 4U);
  const auto in_plots = [](const Eigen::Vector2d& at) { return at.y() < 9 && at.x() < 10; };
  const auto in_crop = [](const Eigen::Vector2d& at) { return at.y() > 15; };
  for (std::size_t number = 0; number < blocks.facts().size(); ++number) {
    const Eigen::Vector2d at = blocks.middle_of(number);
    if (!in_plots(at) && !in_crop(at)) continue;
    EXPECT_TRUE(closed[0][number] && closed[1][number]) << at.transpose();
    EXPECT_EQ(closed[2][number], in_crop(at)) << at.transpose();
    EXPECT_EQ(closed[3][number], in_crop(at)) << at.transpose();
  }
}

TEST(FieldBlocks, BareGroundHasNoCrop) {
  EXPECT_TRUE(crop_tops_m(field_of(0)).empty());
  EXPECT_TRUE(FieldBlocks({}, kSigma_m, 2).closed().empty());
}

TEST(FieldBlocks, KnowWhatStandsOnThem) {
  const auto points = field_of(0.6, 5, 7);
  const FieldBlocks blocks(points, kSigma_m, 2);
  const BlockFacts crop = blocks.facts()[blocks.number_of({10.5F, 5.5F, 0})];
  const BlockFacts tree = blocks.facts()[blocks.number_of({3.5F, 15.5F, 0})];
  const BlockFacts ground = blocks.facts()[blocks.number_of({15.5F, 15.5F, 0})];
  EXPECT_TRUE(crop.stands_out && tree.stands_out);
  EXPECT_FALSE(ground.stands_out || ground.seldom_seen || crop.surface || tree.surface);
  EXPECT_NEAR(crop.highest_m, 0.6, 0.04);
  EXPECT_NEAR(tree.top_m, 4.5, 0.4);
}

TEST(FieldBlocks, MiddlesLieInTheirBlocks) {
  const auto points = field_of(0.6);
  const FieldBlocks blocks(points, kSigma_m, 2);
  for (const int per_side : {1, 5}) {
    const Eigen::Vector2d middle =
        blocks.middle_of(blocks.number_of({7.3F, 3.1F, 0}, per_side), per_side);
    EXPECT_LT((middle - Eigen::Vector2d(7.3, 3.1)).cwiseAbs().maxCoeff(), 0.5 / per_side + 1e-3);
  }
}

TEST(LeastCover, IsATenthOrOfSeedlingsAQuarterOfTheUsual) {
  EXPECT_DOUBLE_EQ(least_cover({0, 0.3, 0.6, 0.7}), 0.1);
  EXPECT_DOUBLE_EQ(least_cover({0, 0.01, 0.2, 0.2, 0.2}), 0.05);
  EXPECT_DOUBLE_EQ(least_cover({0.001, 0.002, 0.001}), 0.02);
}

}  // namespace
}  // namespace plotscan::plots
