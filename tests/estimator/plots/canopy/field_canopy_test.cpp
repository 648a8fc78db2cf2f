// SPDX-License-Identifier: Apache-2.0
#include "plots/canopy/field_canopy.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "core/random.h"

namespace plotscan::plots {
namespace {

constexpr double kNoise_m = 0.02;

// 200 returns a square metre over 20 x 20 m of ground; `height` gives what stands there, or NaN.
template <class Height>
std::vector<Eigen::Vector3f> points_over(const Height& height, double noise_m = kNoise_m) {
  std::vector<Eigen::Vector3f> points;
  for (std::uint64_t i = 0; i < 80000; ++i) {
    RandomStream random(5, random_purpose("test/canopy"), i);
    const double x = random.uniform(0, 20), y = random.uniform(0, 20);
    const double standing = height(x, y, random);
    const double z = std::isnan(standing) ? 0 : standing;
    points.emplace_back(static_cast<float>(x), static_cast<float>(y),
                        static_cast<float>(z + noise_m * random.normal()));
  }
  return points;
}

// With the crop that is most likely.
struct Field {
  explicit Field(const std::vector<Eigen::Vector3f>& points, double noise_m = kNoise_m,
                 const GroundError& ground_error = {})
      : blocks(points, noise_m, 2),
        canopy(points, blocks, {.top_m = crop_top_m()}, 2, ground_error) {}

  double crop_top_m() const {
    const std::vector<double> tops_m = blocks.crop_tops_m();
    return tops_m.empty() ? 0 : tops_m.front();
  }

  FieldBlocks blocks;
  FieldCanopy canopy;
};

bool in_middle(double x, double y) { return x > 6 && x < 14 && y > 6 && y < 14; }

TEST(FieldCanopy, LeavesOutRoofsAndWallsButNoCanopy) {
  const Eigen::Vector3f middle(10, 10, 1);
  const std::vector<Eigen::Vector2d> places = {{10, 10}};
  const auto canopy = points_over([](double x, double y, RandomStream& random) {
    return in_middle(x, y) ? random.uniform(0, 0.8) : NAN;
  });
  const auto roof = points_over([](double x, double y, RandomStream&) {
    return in_middle(x, y) ? 1 + 0.4 * (x - 10) / 4 : NAN;
  });
  EXPECT_FALSE(Field(canopy).canopy.leaves_out(middle));
  EXPECT_LT(Field(canopy).canopy.surface_share(places, 5), 0.02);
  EXPECT_TRUE(Field(roof).canopy.leaves_out(middle));
  EXPECT_GT(Field(roof).canopy.surface_share(places, 5), 0.9);
}

// Closed soybeans scatter by 7 cm about their top: more than the noise, if by less than twice as
// much.
TEST(FieldCanopy, TellsCanopyFromRoofsUnderNoiseToo) {
  constexpr double kLoud_m = 0.045;
  const Eigen::Vector3f middle(10, 10, 0.7F);
  const auto canopy = points_over(
      [](double x, double y, RandomStream& random) {
        return in_middle(x, y) ? random.uniform(0.5, 0.8) : NAN;
      },
      kLoud_m);
  const auto roof = points_over(
      [](double x, double y, RandomStream&) { return in_middle(x, y) ? 0.7 : NAN; }, kLoud_m);
  EXPECT_FALSE(Field(canopy, kLoud_m).canopy.leaves_out(middle));
  EXPECT_TRUE(Field(roof, kLoud_m).canopy.leaves_out(middle));
  // Straight below the drone the noise is larger than in the field's usual place.
  EXPECT_TRUE(Field(roof, kLoud_m / 1.25).canopy.leaves_out(middle));
}

// A roof along the southern edge, a crop along the northern one.
TEST(FieldCanopy, ARoofAtAnEdgeLeavesTheCanopyAtTheOtherEdge) {
  const auto points = points_over([](double, double y, RandomStream& random) {
    if (y < 3) return 1 + 0.1 * y;
    return y > 17 ? random.uniform(0, 0.8) : NAN;
  });
  const Field known(points);
  const FieldCanopy& field = known.canopy;
  for (float x = 1; x < 19; x += 0.25F) {
    EXPECT_TRUE(field.leaves_out({x, 0.1F, 1})) << x;
    EXPECT_FALSE(field.leaves_out({x, 19.9F, 0.5F})) << x;
  }
}

// A ridge of 0.4 m that the ground cut off, along x = 2.5, beside a crop.
TEST(FieldCanopy, LeavesOutRidgesOverGroundThatIsUnsure) {
  const auto points = points_over([](double x, double y, RandomStream& random) {
    if (std::abs(x - 2.5) < 0.25) return 0.4 - 1.6 * std::abs(x - 2.5);
    return in_middle(x, y) ? random.uniform(0, 0.4) : NAN;
  });
  const auto error_on_ridge = [](const Eigen::Vector2d& place) {
    return std::abs(place.x() - 2.5) < 0.7 ? 0.04 : 0.002;
  };
  const Eigen::Vector3f crest(2.5F, 10, 0.4F), crop(10, 10, 0.3F), beside(4, 10, 0);
  const Field known(points, kNoise_m, error_on_ridge);
  const FieldCanopy& field = known.canopy;
  EXPECT_TRUE(field.leaves_out(crest));
  EXPECT_FALSE(field.leaves_out(crop));
  EXPECT_FALSE(field.leaves_out(beside));
  EXPECT_FALSE(Field(points).canopy.leaves_out(crest)) << "nothing is known of it";
  // In sparse clouds the ground is no better known under the crop.
  const Field sparse(points, kNoise_m, [](const Eigen::Vector2d&) { return 0.04; });
  EXPECT_FALSE(sparse.canopy.leaves_out(crop));
}

TEST(FieldCanopy, ScaleIsFromTheNoiseToTheCanopysTop) {
  for (const double top_m : {0.3, 0.8, 2.5}) {
    const auto points = points_over([&](double x, double y, RandomStream& random) {
      return in_middle(x, y) ? random.uniform(0, top_m) : NAN;
    });
    const CanopyScale scale = Field(points).canopy.scale();
    EXPECT_NEAR(scale.low_m, 0.05, 1e-9);
    EXPECT_NEAR(scale.high_m / top_m, 0.9, 0.1);
  }
}

TEST(FieldCanopy, TopIsTheCropsHoweverManyWeedsStandAround) {
  const auto points = points_over([](double x, double y, RandomStream& random) {
    return random.uniform(0, in_middle(x, y) ? 0.8 : 0.12);
  });
  EXPECT_NEAR(Field(points).canopy.scale().high_m / 0.8, 0.9, 0.1);
}

// A crop of 0.5 m, and a hedge of 2 m three metres beside it.
TEST(FieldCanopy, WhatIsTwiceAsTallAsTheCropComesLast) {
  const auto points = points_over([](double x, double y, RandomStream& random) {
    if (x > 17.3 && x < 18.6) return random.uniform(0.2, 2);
    return in_middle(x, y) ? random.uniform(0, 0.5) : NAN;
  });
  const FieldBlocks blocks(points, kNoise_m, 2);
  const FieldCanopy field(points, blocks, {.top_m = 0.45}, 2);
  ASSERT_EQ(field.points().size(), points.size());
  const auto is_in_hedge = [](const Eigen::Vector3f& point) {
    return point.x() > 17.3F && point.x() < 18.6F;
  };
  const auto crop = field.points().first(field.crop_points());
  const auto tall = field.points().subspan(field.crop_points());
  EXPECT_TRUE(std::ranges::none_of(crop, is_in_hedge));
  EXPECT_TRUE(std::ranges::all_of(tall, [](const auto& point) { return point.x() > 16.9F; }))
      << "whole blocks";
  // All blocks are the crop's where it may be as tall.
  EXPECT_EQ(FieldCanopy(points, blocks, {.top_m = 1.8}, 2).crop_points(), points.size());
}

TEST(FieldCanopy, AnotherCropComesLast) {
  const auto points = points_over(
      [](double x, double, RandomStream& random) { return x > 9 ? random.uniform(0, 0.5) : NAN; });
  const FieldBlocks blocks(points, kNoise_m, 2);
  Crop crop{.top_m = 0.45};
  for (std::size_t i = 0; i < blocks.facts().size(); ++i)
    crop.others.push_back(blocks.middle_of(i).x() > 14);
  const FieldCanopy field(points, blocks, crop, 2);
  ASSERT_EQ(field.points().size(), points.size());
  const auto last = field.points().subspan(field.crop_points());
  EXPECT_NEAR(static_cast<double>(last.size()), 6 * 20 * 200, 20 * 200);
  EXPECT_TRUE(std::ranges::all_of(last, [](const auto& point) { return point.x() > 13; }));
}

TEST(FieldCanopy, LeavesOutTheSurveysMarginAndWhatIsNotFinite) {
  auto points = points_over([](double, double, RandomStream&) { return NAN; });
  for (int i = 0; i < 50; ++i) points.emplace_back(40.0F + 0.2F * static_cast<float>(i), 5, 0.5F);
  points.emplace_back(5, NAN, 0);
  const Field known(points);
  const FieldCanopy& field = known.canopy;
  EXPECT_TRUE(field.leaves_out({45, 5, 0.5}));
  EXPECT_TRUE(field.leaves_out({5, NAN, 0}));
  EXPECT_FALSE(field.leaves_out({5, 5, 0}));
}

TEST(FieldCanopy, OfNoPointsHasNoneToLeaveOut) {
  EXPECT_TRUE(Field({}).canopy.leaves_out({NAN, 0, 0}));
}

}  // namespace
}  // namespace plotscan::plots
