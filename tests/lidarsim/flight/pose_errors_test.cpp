// SPDX-License-Identifier: Apache-2.0
#include "flight/pose_errors.h"

#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "core/angle.h"

namespace plotscan::flight {
namespace {

// East at 2 m/s, turning left at 0.1 rad/s; poses every `gap_s`.
scan::Trajectory curve(double duration_s, double gap_s) {
  std::vector<scan::StampedPose> poses;
  for (int i = 0; i * gap_s <= duration_s; ++i) {
    const double t = i * gap_s;
    poses.push_back(
        {.time_s = t,
         .position_m = {20 * std::sin(0.1 * t), 20 - 20 * std::cos(0.1 * t), 8},
         .attitude = Eigen::Quaterniond(Eigen::AngleAxisd(0.1 * t, Eigen::Vector3d::UnitZ()))});
  }
  return scan::Trajectory(std::move(poses));
}

scan::Trajectory hovering(double duration_s) {
  return scan::Trajectory({{.time_s = 0}, {.time_s = duration_s}});
}

// Errors of a hovering at the instants of its fixes.
std::vector<double> errors_at_fixes(const PoseErrors& errors, double duration_s,
                                    const std::function<double(const Eigen::Isometry3d&)>& error) {
  const scan::Trajectory reported = reported_trajectory(hovering(duration_s), errors, 7);
  std::vector<double> values;
  for (int fix = 0; 0.1 * fix < duration_s; ++fix)
    values.push_back(error(reported.world_from_body(0.1 * fix)));
  return values;
}

double variance(const std::vector<double>& values) {
  double squares = 0;
  for (const double value : values) squares += value * value;
  return squares / static_cast<double>(values.size());
}

double autocorrelation(const std::vector<double>& values, std::size_t lag) {
  double products = 0;
  for (std::size_t i = 0; i + lag < values.size(); ++i) products += values[i] * values[i + lag];
  return products / static_cast<double>(values.size() - lag) / variance(values);
}

double east(const Eigen::Isometry3d& pose) { return pose.translation().x(); }
double up(const Eigen::Isometry3d& pose) { return pose.translation().z(); }
double heading(const Eigen::Isometry3d& pose) {
  return std::atan2(pose.linear()(1, 0), pose.linear()(0, 0));
}
double roll(const Eigen::Isometry3d& pose) { return pose.linear()(2, 1); }  // small angles

TEST(PoseErrors, NoneLeavesTheTrajectoryAsItIs) {
  const scan::Trajectory truth = curve(20, 0.37);
  const scan::Trajectory reported = reported_trajectory(truth, pose_error_preset("none"), 1);
  ASSERT_EQ(reported.poses().size(), truth.poses().size());
  for (std::size_t i = 0; i < truth.poses().size(); ++i) {
    EXPECT_EQ(reported.poses()[i].position_m, truth.poses()[i].position_m);
    EXPECT_EQ(reported.poses()[i].attitude.coeffs(), truth.poses()[i].attitude.coeffs());
  }
}

TEST(PoseErrors, NoiseIsWhiteWithItsStandardDeviations) {
  const PoseErrors errors{.position_noise_m = 0.02,
                          .height_noise_m = 0.05,
                          .tilt_noise_deg = 0.1,
                          .heading_noise_deg = 0.3};
  const double n = 20'000;
  const double tolerance = 4 * std::sqrt(2 / n);
  const auto ratio = [&](auto error, double sigma) {
    return variance(errors_at_fixes(errors, 0.1 * n, error)) / (sigma * sigma);
  };
  EXPECT_NEAR(ratio(east, 0.02), 1, tolerance);
  EXPECT_NEAR(ratio(up, 0.05), 1, tolerance);
  EXPECT_NEAR(ratio(roll, 0.1 * kDegrees), 1, tolerance);
  EXPECT_NEAR(ratio(heading, 0.3 * kDegrees), 1, tolerance);
  EXPECT_NEAR(autocorrelation(errors_at_fixes(errors, 0.1 * n, east), 1), 0, 4 / std::sqrt(n));
}

// Gauss-Markov: the autocorrelation after t is exp(-t / T).
TEST(PoseErrors, DriftFadesAsItsCorrelationTimeSays) {
  const PoseErrors errors{.position_drift_m = 0.5, .position_drift_s = 3};
  const std::vector<double> drift = errors_at_fixes(errors, 20'000, east);
  EXPECT_NEAR(variance(drift) / 0.25, 1, 0.1);  // about 3300 independent stretches
  for (const std::size_t lag : {5u, 30u, 60u})
    EXPECT_NEAR(autocorrelation(drift, lag), std::exp(-0.1 * static_cast<double>(lag) / 3), 0.05);
}

TEST(PoseErrors, AxesErrIndependently) {
  const scan::Trajectory reported =
      reported_trajectory(hovering(2000), {.position_noise_m = 1, .height_noise_m = 1}, 3);
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (int fix = 0; fix < 20'000; ++fix) {
    const Eigen::Vector3d error = reported.world_from_body(0.1 * fix).translation();
    covariance += error * error.transpose() / 20'000;
  }
  EXPECT_TRUE(covariance.isApprox(Eigen::Matrix3d::Identity(), 0.05)) << covariance;
}

// On a straight way at constant speed, a late pose is a pose further along.
TEST(PoseErrors, ClockOffsetMovesAlongTheTrack) {
  const scan::Trajectory truth(
      {{.time_s = 0, .position_m = {0, 0, 8}}, {.time_s = 10, .position_m = {20, 0, 8}}});
  const scan::Trajectory reported = reported_trajectory(truth, {.clock_offset_s = 0.05}, 1);
  for (const double t : {0.0, 1.234, 5.5, 9.9})
    EXPECT_NEAR(reported.world_from_body(t).translation().x(), 2 * (t + 0.05), 1e-9);
}

TEST(PoseErrors, AreTheSameHoweverTheTruthIsSampled) {
  const PoseErrors errors = pose_error_preset("gps");
  const scan::Trajectory dense = reported_trajectory(curve(10, 0.01), errors, 9);
  const scan::Trajectory sparse = reported_trajectory(curve(10, 0.5), errors, 9);
  for (const double t : {0.0, 0.5, 3.0, 9.5}) {
    EXPECT_TRUE(dense.world_from_body(t).isApprox(sparse.world_from_body(t), 1e-9));
    EXPECT_FALSE(dense.world_from_body(t).isApprox(
        reported_trajectory(curve(10, 0.5), errors, 10).world_from_body(t), 1e-3));
  }
}

TEST(PoseErrors, MountTurnsAboutTheBodysAxes) {
  const Eigen::Isometry3d stated(Eigen::AngleAxisd(90 * kDegrees, Eigen::Vector3d::UnitY()));
  const Eigen::Isometry3d truth =
      true_mount(stated, {.boresight_rpy_deg = {0, 0, 90}, .lever_arm_m = {0.1, 0.2, 0.3}});
  // The stated mount turns lidar x to body -z and lidar z to body x; a yaw of 90 degrees turns x to
  // y.
  EXPECT_TRUE((truth.linear() * Eigen::Vector3d::UnitX()).isApprox(-Eigen::Vector3d::UnitZ()));
  EXPECT_TRUE((truth.linear() * Eigen::Vector3d::UnitZ()).isApprox(Eigen::Vector3d::UnitY()));
  EXPECT_TRUE(truth.translation().isApprox(Eigen::Vector3d(0.1, 0.2, 0.3)));
}

TEST(PoseErrors, ComeOnTopOfThePreset) {
  const PoseErrors errors =
      combined(pose_error_preset("rtk"),
               {.position_drift_m = 0.02, .position_drift_s = 5, .clock_offset_s = 1e-3});
  EXPECT_NEAR(errors.position_drift_m, std::hypot(0.01, 0.02), 1e-15);
  EXPECT_EQ(errors.position_drift_s, 5);
  EXPECT_EQ(errors.heading_drift_deg, 0.18);
  EXPECT_EQ(errors.clock_offset_s, 1e-3);
  EXPECT_TRUE(combined(pose_error_preset("none"), {}).none());
  for (const std::string& name : pose_error_presets())
    EXPECT_EQ(pose_error_preset(name).none(), name == "none");
}

}  // namespace
}  // namespace plotscan::flight
