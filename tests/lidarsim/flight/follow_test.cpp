// SPDX-License-Identifier: Apache-2.0
#include "flight/follow.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace plotscan::flight {
namespace {

constexpr double kDrag_1_m = 0.12 / 1.477;  // over mass

double tilt(const Eigen::Quaterniond& attitude) {
  return std::acos(std::clamp((attitude * Eigen::Vector3d::UnitZ()).z(), -1.0, 1.0));
}

Route hover(double duration_s) {
  return Route(Quadrotor(),
               {{.position_m = {0, 0, 10}, .hold_s = duration_s}, {.position_m = {0, 0, 11}}}, 2);
}

// Four strips of 40 m.
Route strips(double speed_m_s, double wind_m_s) {
  return Route(Quadrotor(),
               waypoints_at({{-20, -9, 8},
                             {20, -9, 8},
                             {20, -3, 8},
                             {-20, -3, 8},
                             {-20, 3, 8},
                             {20, 3, 8},
                             {20, 9, 8},
                             {-20, 9, 8}}),
               speed_m_s, wind_m_s);
}

scan::Trajectory in_wind(const Route& route, const WindOptions& options) {
  const Wind wind(options, route.duration_s());
  return follow(Quadrotor(), route,
                {.velocity_m_s = [&](double time_s) { return wind.velocity_m_s(time_s); },
                 .expected_m_s = wind.mean_m_s()});
}

Air steady(const Eigen::Vector3d& wind, const Eigen::Vector3d& expected) {
  return {.velocity_m_s = [wind](double) { return wind; }, .expected_m_s = expected};
}

// The linear loop about hovering, along x: position, velocity, thrust and integral, as follow.h's
// autopilot has them, in a wind of `mean` along x that rises by a little.
Eigen::Matrix4d linear_loop(double mean) {
  constexpr double kP = 0.95;
  constexpr double kV = 1.8;
  constexpr double kI = 0.4;
  constexpr double kD = 0.2;
  constexpr double kLag = 1 / 6.5;
  const double damping = 2 * kDrag_1_m * mean;
  Eigen::Matrix4d loop;
  loop << 0, 1, 0, 0,                                                            //
      0, -damping, 1, 0,                                                         //
      -kV * kP / kLag, (-kV + kD * damping) / kLag, (-1 - kD) / kLag, 1 / kLag,  //
      -kI * kP, -kI, 0, 0;
  return loop;
}

// x(t) of x' = A x + b from rest: its power series, sum of A^(k-1) b t^k / k!, over 100
// short pieces one after the other.
Eigen::Vector4d after(const Eigen::Matrix4d& a, const Eigen::Vector4d& b, double time_s) {
  constexpr int kPieces = 100;
  Eigen::Vector4d state = Eigen::Vector4d::Zero();
  for (int piece = 0; piece < kPieces; ++piece) {
    Eigen::Vector4d term = a * state + b;
    for (int k = 1; k < 25; ++k) {
      term *= time_s / kPieces / k;
      state += term;
      term = a * term;
    }
  }
  return state;
}

TEST(Follow, HoldsItsPlaceInAnExpectedWindLeaningByTheClosedForm) {
  const Eigen::Vector3d wind(3, -4, 0);
  const scan::Trajectory flown = follow(Quadrotor(), hover(5), steady(wind, wind));
  for (const scan::StampedPose& pose : flown.poses()) {
    if (pose.time_s > 5) break;
    ASSERT_LT((pose.position_m - Eigen::Vector3d(0, 0, 10)).norm(), 1e-9);
    ASSERT_NEAR(tilt(pose.attitude), std::atan(kDrag_1_m * 25 / 9.80665), 1e-9);
    // Into the wind.
    ASSERT_LT((pose.attitude * Eigen::Vector3d::UnitZ()).dot(wind), 0);
  }
}

// The integral finds what the autopilot does not know. The slowest mode of the linear loop decays
// with about 0.2 /s.
TEST(Follow, AnUnexpectedSteadyWindLeavesNoOffset) {
  const scan::Trajectory flown =
      follow(Quadrotor(), hover(60), steady({4, 0, 0}, Eigen::Vector3d::Zero()));
  double furthest = 0;
  for (const scan::StampedPose& pose : flown.poses()) {
    if (pose.time_s < 30) continue;
    if (pose.time_s > 60) break;
    furthest = std::max(furthest, (pose.position_m - Eigen::Vector3d(0, 0, 10)).norm());
    ASSERT_NEAR(tilt(pose.attitude), std::atan(kDrag_1_m * 16 / 9.80665), 1e-4);
  }
  EXPECT_LT(furthest, 1e-3);
  EXPECT_GT(furthest, 0);
}

// A gust of 1 cm/s steps in at 5 s; the loop is linear then.
TEST(Follow, AnswersASmallGustAsTheLinearLoopDoes) {
  const Eigen::Vector3d mean(3, 0, 0);
  constexpr double kGust = 0.01;
  const Air air{.velocity_m_s =
                    [&](double time_s) {
                      return time_s < 5 ? mean : Eigen::Vector3d(mean.x() + kGust, 0, 0);
                    },
                .expected_m_s = mean};
  const scan::Trajectory flown = follow(Quadrotor(), hover(15), air);
  const Eigen::Matrix4d loop = linear_loop(3);
  const double push = 2 * kDrag_1_m * 3 * kGust;
  // The derivative's term sees the push, too.
  const Eigen::Vector4d gust(0, push, -0.2 * 6.5 * push, 0);
  double largest = 0;
  for (const double after_s : {0.1, 0.3, 1.0, 2.0, 4.0, 9.0}) {
    const Eigen::Vector4d state = after(loop, gust, after_s);
    const double x = flown.world_from_body(5 + after_s).translation().x();
    EXPECT_NEAR(x, state[0], 5e-3 * 2e-3) << after_s << " s";
    largest = std::max(largest, std::abs(x));
  }
  EXPECT_GT(largest, 1e-3);
}

// Without wind the loop needs not be run; run, it is off by no more than the lag of its thrust.
TEST(Follow, StillAirIsTheRouteBarTheLag) {
  const Route route = strips(2, 0);
  const scan::Trajectory exact = fly_exactly(Quadrotor(), route);
  const scan::Trajectory flown =
      follow(Quadrotor(), route, steady(Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()));
  ASSERT_EQ(flown.poses().size(), exact.poses().size());
  double furthest = 0;
  for (std::size_t i = 0; i < exact.poses().size(); ++i) {
    furthest =
        std::max(furthest, (flown.poses()[i].position_m - exact.poses()[i].position_m).norm());
  }
  EXPECT_LT(furthest, 0.3);
}

// 4 m/s with gusts of 0.8 m/s, any direction: strips are flown within decimetres, and the thrust
// never leans further than the quadrotor may.
TEST(Follow, StaysNearTheStripsInWind) {
  const Route route = strips(2, 4);
  const scan::Trajectory exact = fly_exactly(Quadrotor(), route);
  double squares = 0;
  int count = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const scan::Trajectory flown =
        in_wind(route, {.mean_m_s = 4, .from_deg = 45.0 * static_cast<double>(seed), .seed = seed});
    for (std::size_t i = 0; i < flown.poses().size(); ++i, ++count) {
      const scan::StampedPose& pose = flown.poses()[i];
      const double off = (pose.position_m - exact.poses()[i].position_m).norm();
      squares += off * off;
      ASSERT_LT(off, 1.5) << "seed " << seed << ", " << pose.time_s << " s";
      ASSERT_LE(tilt(pose.attitude), 0.5 + 1e-9);
    }
  }
  const double rms = std::sqrt(squares / count);
  RecordProperty("rms_m", std::to_string(rms));
  EXPECT_LT(rms, 0.5);
  EXPECT_GT(rms, 0.02);
}

// What nobody holds: the tilt stays at its limit, the drone drifts, nothing breaks.
TEST(Follow, NeverLeansFurtherThanItsLimit) {
  const scan::Trajectory flown =
      follow(Quadrotor(), hover(20), steady({14, 0, 0}, Eigen::Vector3d::Zero()));
  double most = 0;
  for (const scan::StampedPose& pose : flown.poses()) {
    ASSERT_LE(tilt(pose.attitude), 0.5 + 1e-9);
    most = std::max(most, tilt(pose.attitude));
  }
  EXPECT_NEAR(most, 0.5, 1e-3);
  EXPECT_GT(flown.poses().back().position_m.x(), 10);
}

TEST(Follow, IsTheSameFlightForTheSameSeed) {
  const Route route = strips(3, 3);
  const WindOptions wind{.mean_m_s = 3, .seed = 5};
  const scan::Trajectory one = in_wind(route, wind);
  const scan::Trajectory two = in_wind(route, wind);
  WindOptions other = wind;
  other.seed = 6;
  const scan::Trajectory three = in_wind(route, other);
  for (std::size_t i = 0; i < one.poses().size(); ++i) {
    ASSERT_EQ(one.poses()[i].position_m, two.poses()[i].position_m);
    ASSERT_EQ(one.poses()[i].attitude.coeffs(), two.poses()[i].attitude.coeffs());
  }
  EXPECT_NE(one.poses()[100].position_m, three.poses()[100].position_m);
}

// g tan(0.5) = 5.357 m/s^2 less 0.5 is drag at 7.73 m/s.
TEST(Follow, TheWindItHoldsFollowsFromItsTilt) {
  const double airspeed = std::sqrt((9.80665 * std::tan(0.5) - 0.5) / kDrag_1_m);
  EXPECT_NEAR(holdable_wind_m_s(Quadrotor(), 2, 0), airspeed - 2, 1e-12);
  EXPECT_NEAR(holdable_wind_m_s(Quadrotor(), 2, 0.2), (airspeed - 2) / 1.4, 1e-12);
  EXPECT_EQ(holdable_wind_m_s({.max_tilt_rad = 0.01}, 2, 0.2), 0);
}

}  // namespace
}  // namespace plotscan::flight
