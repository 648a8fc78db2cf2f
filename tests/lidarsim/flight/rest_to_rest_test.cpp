// SPDX-License-Identifier: Apache-2.0
#include "flight/rest_to_rest.h"

#include <cmath>

#include <gtest/gtest.h>

namespace plotscan::flight {
namespace {

// Long, without cruise, without steady acceleration, and none at all.
class RestToRestOver : public ::testing::TestWithParam<double> {};

constexpr MotionLimits kLimits = {.speed = 3, .acceleration = 2, .jerk = 5};

TEST_P(RestToRestOver, StartsAndEndsAtRest) {
  const RestToRest motion(GetParam(), kLimits);
  for (const double time_s : {-1.0, 0.0}) {
    EXPECT_EQ(motion.at(time_s).distance, 0);
    EXPECT_EQ(motion.at(time_s).speed, 0);
  }
  for (const double after_s : {0.0, 1.0}) {
    EXPECT_NEAR(motion.at(motion.duration_s() + after_s).distance, GetParam(), 1e-12);
    EXPECT_NEAR(motion.at(motion.duration_s() + after_s).speed, 0, 1e-12);
  }
}

// Speed is the derivative of distance, acceleration of speed, and the jerk is within its limit.
TEST_P(RestToRestOver, StatesAreDerivativesWithinTheLimits) {
  const RestToRest motion(GetParam(), kLimits);
  constexpr double kShort_s = 1e-4;
  for (double t = kShort_s; t < motion.duration_s() - kShort_s; t += 7 * kShort_s) {
    const auto before = motion.at(t - kShort_s);
    const auto now = motion.at(t);
    const auto after = motion.at(t + kShort_s);
    ASSERT_NEAR((after.distance - before.distance) / (2 * kShort_s), now.speed, 1e-6);
    ASSERT_NEAR((after.speed - before.speed) / (2 * kShort_s), now.acceleration, 1e-3);
    ASSERT_LE(std::abs(after.acceleration - before.acceleration) / (2 * kShort_s),
              kLimits.jerk * (1 + 1e-6));
    ASSERT_LE(now.speed, kLimits.speed * (1 + 1e-12));
    ASSERT_LE(std::abs(now.acceleration), kLimits.acceleration * (1 + 1e-12));
  }
}

INSTANTIATE_TEST_SUITE_P(Distances, RestToRestOver, ::testing::Values(50.0, 3.0, 0.2, 1e-3, 0.0));

TEST(RestToRest, UsesItsLimitsInFull) {
  const RestToRest motion(50, kLimits);
  EXPECT_DOUBLE_EQ(motion.at(5).speed, 3);
  // From rest: 0.4 s of jerk, 1.1 s at 2 m/s^2, 0.4 s of jerk, on average at half the speed.
  EXPECT_NEAR(RestToRest::run_up(3, kLimits), 1.9 * 1.5, 1e-12);
  EXPECT_NEAR(motion.duration_s(), 50.0 / 3 + 1.9, 1e-12);
  EXPECT_NEAR(motion.at(1.9).distance, 1.9 * 1.5, 1e-12);
}

}  // namespace
}  // namespace plotscan::flight
