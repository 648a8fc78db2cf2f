// SPDX-License-Identifier: Apache-2.0
#include "core/plot_box.h"

#include <gtest/gtest.h>

#include "core/angle.h"
#include "core/random.h"

namespace plotscan {
namespace {

PlotBox random_box(std::uint64_t index) {
  RandomStream stream(5, random_purpose("box"), index);
  return {.center = {stream.uniform(-1, 1), stream.uniform(-1, 1)},
          .width_m = stream.uniform(0.5, 2),
          .length_m = stream.uniform(0.5, 4),
          .heading_rad = stream.uniform(-7, 7)};
}

TEST(PlotBox, HeadingIsTheLengthAxisCounterClockwiseFromEast) {
  const PlotBox box{.center = {1, 2}, .width_m = 1, .length_m = 4, .heading_rad = kPi / 2};
  EXPECT_TRUE(box.contains({1, 3.9}));
  EXPECT_FALSE(box.contains({2, 2}));
  EXPECT_TRUE(box.contains({0.6, 2}));
}

TEST(PlotBox, OverlapOfShiftedEqualBoxesIsKnown) {
  const PlotBox a{.width_m = 1, .length_m = 4, .heading_rad = 0.3};
  PlotBox b = a;
  b.center += a.length_axis() * 1.0;
  EXPECT_NEAR(intersection_area(a, b), 3.0, 1e-12);
  EXPECT_NEAR(intersection_over_union(a, b), 3.0 / 5.0, 1e-12);
  b.heading_rad += kPi;
  EXPECT_NEAR(intersection_over_union(a, b), 3.0 / 5.0, 1e-12);
}

TEST(PlotBox, OverlapIsTheSameFarFromTheOrigin) {
  for (const double heading_rad : {0.0, 0.3, 1.571}) {
    const PlotBox a{.center = {512345.678, 4123456.789},
                    .width_m = 1.5,
                    .length_m = 4,
                    .heading_rad = heading_rad};
    PlotBox b = a;
    EXPECT_NEAR(intersection_over_union(a, b), 1, 1e-12);
    EXPECT_LE(intersection_over_union(a, b), 1);
    b.center += a.length_axis();
    EXPECT_NEAR(intersection_over_union(a, b), 3.0 / 5.0, 1e-8);
  }
}

TEST(PlotBox, CrossOfTwoStripsSharesASquare) {
  const PlotBox a{.width_m = 1, .length_m = 4, .heading_rad = 0.2};
  const PlotBox b{.width_m = 1, .length_m = 4, .heading_rad = 0.2 + kPi / 2};
  EXPECT_NEAR(intersection_area(a, b), 1.0, 1e-12);
}

TEST(PlotBox, IntersectionAgreesWithCountedSamples) {
  for (std::uint64_t pair = 0; pair < 10; ++pair) {
    const PlotBox a = random_box(2 * pair);
    const PlotBox b = random_box(2 * pair + 1);
    constexpr int kSamples = 100'000;
    int shared = 0;
    for (int i = 0; i < kSamples; ++i) {
      RandomStream stream(6, random_purpose("sample"), i);
      const double along = stream.uniform(-0.5, 0.5) * a.length_m;
      const double across = stream.uniform(-0.5, 0.5) * a.width_m;
      shared += b.contains(a.center + along * a.length_axis() + across * a.width_axis());
    }
    EXPECT_NEAR(intersection_area(a, b), a.area_m2() * shared / kSamples, 0.03) << "pair " << pair;
  }
}

TEST(PlotBox, HeadingsWrapToHalfATurn) {
  EXPECT_NEAR(wrap_heading(-0.1), kPi - 0.1, 1e-12);
  EXPECT_NEAR(heading_difference(0.05, kPi - 0.05), 0.1, 1e-12);
  EXPECT_NEAR(heading_difference(0, kPi / 2), kPi / 2, 1e-12);
}

}  // namespace
}  // namespace plotscan
