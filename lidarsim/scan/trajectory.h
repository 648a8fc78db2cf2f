// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <Eigen/Geometry>

namespace plotscan::scan {

struct StampedPose {
  double time_s = 0;
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();          // world frame
  Eigen::Quaterniond attitude = Eigen::Quaterniond::Identity();  // world_from_body
};

// The turn from attitude a to b by the shorter way, about an axis in a's frame; its angle lies
// within half a turn on either side of 0.
Eigen::AngleAxisd shorter_turn(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b);

// Where the body is at any time: between stamped poses, linear in position and slerp in attitude
// (Shoemake 1985), the shorter way round.
class Trajectory {
 public:
  // Normalises the attitudes. Throws InputError on fewer than two poses, times that do not strictly
  // increase, a number that is not finite, or an attitude whose norm is not 1 within 0.01.
  explicit Trajectory(std::vector<StampedPose> poses);

  const std::vector<StampedPose>& poses() const { return poses_; }
  double start_s() const { return poses_.front().time_s; }
  double end_s() const { return poses_.back().time_s; }
  // The i with poses()[i].time_s <= time_s < poses()[i + 1].time_s; outside the trajectory, that of
  // the first or last segment.
  std::size_t segment(double time_s) const;
  // Outside the trajectory, the first or last pose.
  Eigen::Isometry3d world_from_body(double time_s) const;

 private:
  std::vector<StampedPose> poses_;
};

// The same motion, every position moved by `by_m`.
Trajectory moved(const Trajectory& trajectory, const Eigen::Vector3d& by_m);

// The same motion, every time later by `by_s`.
Trajectory delayed(const Trajectory& trajectory, double by_s);

// What is wrong with a pose that follows one at `previous_s` (-infinity for the first); "" if
// nothing is wrong.
std::string pose_error(const StampedPose& pose, double previous_s);

// Of flights and recordings: messages are made for every 10 ms of them.
inline constexpr double kLongestFlight_s = 24 * 3600;

// Throws InputError naming the file when the trajectory takes longer than that.
void require_flight_time(const std::filesystem::path& file, const Trajectory& trajectory);

// Reads the TUM format (one "t x y z qx qy qz qw" a line, '#' comments; seconds, metres) or a
// scan's trajectory.csv. Throws InputError naming file and line where the constructor above would.
Trajectory read_trajectory(const std::filesystem::path& file);

// Header t_s,x_m,y_m,z_m,qx,qy,qz,qw; every number reads back as the same double.
void write_trajectory(const std::filesystem::path& file, const Trajectory& trajectory);

// Writes the TUM format: a comment line, then one "t x y z qx qy qz qw" a line; the same numbers.
void write_tum(const std::filesystem::path& file, const Trajectory& trajectory);

}  // namespace plotscan::scan
