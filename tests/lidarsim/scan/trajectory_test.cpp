// SPDX-License-Identifier: Apache-2.0
#include "scan/trajectory.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "temporary_folder.h"

namespace plotscan::scan {
namespace {

using ::testing::HasSubstr;
using testing::message_of;
using testing::TemporaryFolder;

Eigen::Quaterniond about_z(double angle_rad) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle_rad, Eigen::Vector3d::UnitZ()));
}

TEST(Trajectory, IsLinearInPositionAndTurnsEvenly) {
  const Trajectory trajectory({{.time_s = 1, .position_m = {0, 0, 8}, .attitude = about_z(0.2)},
                               {.time_s = 3, .position_m = {4, -2, 9}, .attitude = about_z(1.4)},
                               {.time_s = 4, .position_m = {4, 0, 9}, .attitude = about_z(1.4)}});
  for (const double share : {0.0, 0.1, 0.5, 0.75}) {
    const Eigen::Isometry3d pose = trajectory.world_from_body(1 + 2 * share);
    EXPECT_LT((pose.translation() - Eigen::Vector3d(4 * share, -2 * share, 8 + share)).norm(),
              1e-12);
    const double angle = 0.2 + 1.2 * share;  // slerp about one axis is even in the angle
    EXPECT_LT((pose.linear() - about_z(angle).toRotationMatrix()).norm(), 1e-12);
  }
  EXPECT_LT((trajectory.world_from_body(3.5).translation() - Eigen::Vector3d(4, -1, 9)).norm(),
            1e-12);
}

TEST(Trajectory, TurnsTheShorterWay) {
  Eigen::Quaterniond opposite = about_z(0.4);
  opposite.coeffs() *= -1;  // the same attitude by the other sign
  const Trajectory trajectory({{.time_s = 0}, {.time_s = 1, .attitude = opposite}});
  EXPECT_LT((trajectory.world_from_body(0.5).linear() - about_z(0.2).toRotationMatrix()).norm(),
            1e-12);
}

TEST(Trajectory, IsHeldAtItsEnds) {
  const Trajectory trajectory(
      {{.time_s = 1, .position_m = {1, 0, 0}}, {.time_s = 2, .position_m = {2, 0, 0}}});
  EXPECT_EQ(trajectory.world_from_body(-5).translation().x(), 1);
  EXPECT_EQ(trajectory.world_from_body(50).translation().x(), 2);
  EXPECT_EQ(trajectory.segment(-5), 0u);
  EXPECT_EQ(trajectory.segment(2), 0u);
}

TEST(Trajectory, ReadsTum) {
  const TemporaryFolder folder;
  const auto file = folder.write("flight.tum",
                                 "# t x y z qx qy qz qw\n\n"
                                 "0 1 2 3 0 0 0.70711 0.70711\n"
                                 "  0.5\t-1 2e1 +3 0 0 0 1\r\n");
  const Trajectory trajectory = read_trajectory(file);
  ASSERT_EQ(trajectory.poses().size(), 2u);
  EXPECT_EQ(trajectory.poses()[1].position_m, Eigen::Vector3d(-1, 20, 3));
  const Eigen::Isometry3d first = trajectory.world_from_body(0);
  EXPECT_LT((first.linear() - about_z(std::numbers::pi / 2).toRotationMatrix()).norm(), 1e-12);
}

// Editors of Windows put it there, and nobody sees it.
TEST(Trajectory, AByteOrderMarkIsPassedOver) {
  const TemporaryFolder folder;
  const std::string poses = "0 1 2 3 0 0 0 1\n1 1 2 4 0 0 0 1\n";
  for (const std::string head : {"", "# t, x, y, z\n"}) {
    const auto file = folder.write("flight.tum", "\xef\xbb\xbf" + head + poses);
    EXPECT_EQ(read_trajectory(file).poses().back().position_m, Eigen::Vector3d(1, 2, 4)) << head;
  }
}

TEST(Trajectory, WhatIsWrittenReadsBackTheSame) {
  const TemporaryFolder folder;
  const Trajectory written({{.time_s = 0.1, .position_m = {1.0 / 3, -1e-9, 1e5}},
                            {.time_s = 0.11, .attitude = about_z(1)}});
  const auto file = folder.path() / "trajectory.csv";
  write_trajectory(file, written);
  const Trajectory read = read_trajectory(file);
  ASSERT_EQ(read.poses().size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(read.poses()[i].time_s, written.poses()[i].time_s);
    EXPECT_EQ(read.poses()[i].position_m, written.poses()[i].position_m);
    EXPECT_LT((read.poses()[i].attitude.coeffs() - written.poses()[i].attitude.coeffs()).norm(),
              1e-15);
  }
}

std::string trajectory_refusal(const std::string& text) {
  const TemporaryFolder folder;
  const auto file = folder.write("flight", text);
  return message_of<InputError>([&] { read_trajectory(file); });
}

TEST(Trajectory, BrokenFilesAreRefusedByLine) {
  const std::string first = "0 0 0 8 0 0 0 1\n";
  EXPECT_THAT(trajectory_refusal(""), HasSubstr("at least two poses; the file has 0"));
  EXPECT_THAT(trajectory_refusal(first), HasSubstr("the file has 1"));
  EXPECT_THAT(trajectory_refusal(first + first), HasSubstr("flight:2: time 0 s is not after"));
  EXPECT_THAT(trajectory_refusal(first + "1 0 0 8 0 0 1\n"), HasSubstr("flight:2: has 7 numbers"));
  EXPECT_THAT(trajectory_refusal(first + "1 0 0 8 0 0 0 1 9\n"), HasSubstr("has 9 numbers"));
  EXPECT_THAT(trajectory_refusal(first + "1 0 0 up 0 0 0 1\n"),
              HasSubstr("\"up\" is not a number"));
  EXPECT_THAT(trajectory_refusal(first + "1 0 0 nan 0 0 0 1\n"), HasSubstr("not finite"));
  EXPECT_THAT(trajectory_refusal("inf 0 0 8 0 0 0 1\n"), HasSubstr("not finite"));
  EXPECT_THAT(trajectory_refusal(first + "1 1e300 0 8 0 0 0 1\n"), HasSubstr("from the origin"));
  EXPECT_THAT(trajectory_refusal(first + "1 0 0 8 0 0 0 0\n"),
              HasSubstr("quaternion norm 0 is not 1"));
  EXPECT_THAT(trajectory_refusal(first + "1 0 0 8 1 0 0 1\n"),
              HasSubstr("flight:2: quaternion norm 1.41"));
  const std::string header = "t_s,x_m,y_m,z_m,qx,qy,qz,qw\n";
  EXPECT_THAT(trajectory_refusal(header + "0,0,0,8,0,0,0,1\n0,0,0,8,0,0,0,1\n"),
              HasSubstr("flight:3: "));
  EXPECT_THAT(trajectory_refusal(header + "0,0,0,8,0,0,0\n"), HasSubstr("flight:2: has 7 fields"));
}

// Nanoseconds that were taken for seconds.
TEST(Trajectory, FlightsOfMoreThanADayAreRefused) {
  const Trajectory day({{.time_s = 5}, {.time_s = 5 + kLongestFlight_s}});
  EXPECT_NO_THROW(require_flight_time("flight.tum", day));
  const Trajectory longer({{.time_s = 5}, {.time_s = 1e11}});
  EXPECT_THAT(message_of<InputError>([&] { require_flight_time("flight.tum", longer); }),
              HasSubstr("flight.tum: the flight takes"));
}

TEST(Trajectory, BrokenPosesAreRefused) {
  EXPECT_THROW(Trajectory(std::vector<StampedPose>(1)), InputError);
  EXPECT_THROW(Trajectory({{.time_s = 1}, {.time_s = 0}}), InputError);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(Trajectory({{.time_s = 0}, {.time_s = nan}}), InputError);
  EXPECT_THROW(Trajectory({{.time_s = 0}, {.time_s = 1, .position_m = {0, nan, 0}}}), InputError);
}

}  // namespace
}  // namespace plotscan::scan
