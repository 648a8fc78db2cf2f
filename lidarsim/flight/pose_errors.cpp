// SPDX-License-Identifier: Apache-2.0
#include "flight/pose_errors.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/angle.h"
#include "core/error.h"
#include "core/random.h"

namespace plotscan::flight {
namespace {

constexpr double kFix_s = 0.1;
constexpr double kPose_s = 0.01;

// One component of the errors over time: white noise at every fix plus a Gauss-Markov drift, both
// linear from fix to fix.
class ErrorSeries {
 public:
  ErrorSeries(double noise, double drift, double drift_s, double duration_s, std::uint64_t seed,
              std::string_view what) {
    const auto fixes = static_cast<std::size_t>(std::ceil(duration_s / kFix_s)) + 1;
    const double kept = std::exp(-kFix_s / drift_s);
    const double renewed = std::sqrt(1 - kept * kept);
    double drifted = 0;
    for (std::size_t fix = 0; fix < fixes; ++fix) {
      const auto [for_noise, for_drift] =
          RandomStream(seed, random_purpose(what), fix).normal_pair();
      drifted = fix == 0 ? drift * for_drift : kept * drifted + renewed * drift * for_drift;
      values_.push_back(noise * for_noise + drifted);
    }
  }

  double at(double time_s) const {
    const double fixes = std::clamp(time_s / kFix_s, 0.0, static_cast<double>(values_.size() - 1));
    const auto fix = std::min(static_cast<std::size_t>(fixes), values_.size() - 1);
    const std::size_t next = std::min(fix + 1, values_.size() - 1);
    return std::lerp(values_[fix], values_[next], fixes - static_cast<double>(fix));
  }

 private:
  std::vector<double> values_;
};

// In the trajectory's time: the times of its poses and, between these, at least one every kPose_s.
std::vector<double> report_times(const scan::Trajectory& truth) {
  std::vector<double> times;
  for (const scan::StampedPose& pose : truth.poses()) {
    const double before = times.empty() ? pose.time_s : times.back();
    const double gaps = std::ceil((pose.time_s - before) / kPose_s * (1 - 1e-9));
    for (std::int64_t gap = 1; static_cast<double>(gap) < gaps; ++gap)
      times.push_back(std::lerp(before, pose.time_s, static_cast<double>(gap) / gaps));
    times.push_back(pose.time_s);
  }
  return times;
}

}  // namespace

bool PoseErrors::poses_are_exact() const {
  return position_noise_m == 0 && height_noise_m == 0 && position_drift_m == 0 &&
         height_drift_m == 0 && tilt_noise_deg == 0 && heading_noise_deg == 0 &&
         tilt_drift_deg == 0 && heading_drift_deg == 0 && clock_offset_s == 0;
}

const std::vector<std::string>& pose_error_presets() {
  static const std::vector<std::string> names = {"none", "rtk", "ppk", "gps"};
  return names;
}

PoseErrors pose_error_preset(const std::string& name) {
  static const std::map<std::string, PoseErrors> presets = {
      {"none", {}},
      {"rtk",
       {.position_noise_m = 0.005,
        .height_noise_m = 0.01,
        .position_drift_m = 0.01,
        .height_drift_m = 0.02,
        .tilt_noise_deg = 0.01,
        .heading_noise_deg = 0.02,
        .tilt_drift_deg = 0.03,
        .heading_drift_deg = 0.18}},
      {"ppk",
       {.position_noise_m = 0.003,
        .height_noise_m = 0.006,
        .position_drift_m = 0.01,
        .height_drift_m = 0.02,
        .tilt_noise_deg = 0.005,
        .heading_noise_deg = 0.01,
        .tilt_drift_deg = 0.025,
        .heading_drift_deg = 0.08}},
      {"gps",
       {.position_noise_m = 0.02,
        .height_noise_m = 0.04,
        .position_drift_m = 1.0,
        .height_drift_m = 1.5,
        .tilt_noise_deg = 0.02,
        .heading_noise_deg = 0.05,
        .tilt_drift_deg = 0.04,
        .heading_drift_deg = 0.30}},
  };
  const auto preset = presets.find(name);
  check(preset != presets.end(), "there is a preset of pose errors called " + name);
  return preset->second;
}

PoseErrors combined(const PoseErrors& preset, const PoseErrors& own) {
  return {.position_noise_m = std::hypot(preset.position_noise_m, own.position_noise_m),
          .height_noise_m = std::hypot(preset.height_noise_m, own.height_noise_m),
          .position_drift_m = std::hypot(preset.position_drift_m, own.position_drift_m),
          .height_drift_m = std::hypot(preset.height_drift_m, own.height_drift_m),
          .position_drift_s = own.position_drift_s,
          .tilt_noise_deg = std::hypot(preset.tilt_noise_deg, own.tilt_noise_deg),
          .heading_noise_deg = std::hypot(preset.heading_noise_deg, own.heading_noise_deg),
          .tilt_drift_deg = std::hypot(preset.tilt_drift_deg, own.tilt_drift_deg),
          .heading_drift_deg = std::hypot(preset.heading_drift_deg, own.heading_drift_deg),
          .attitude_drift_s = own.attitude_drift_s,
          .boresight_rpy_deg = preset.boresight_rpy_deg + own.boresight_rpy_deg,
          .lever_arm_m = preset.lever_arm_m + own.lever_arm_m,
          .clock_offset_s = preset.clock_offset_s + own.clock_offset_s};
}

scan::Trajectory reported_trajectory(const scan::Trajectory& truth, const PoseErrors& errors,
                                     std::uint64_t seed) {
  if (errors.poses_are_exact()) return truth;
  const double start_s = truth.start_s();
  const auto series = [&](double noise, double drift, double drift_s, std::string_view what) {
    return ErrorSeries(noise, drift, drift_s, truth.end_s() - start_s, seed, what);
  };
  const auto place = [&](double noise, double drift, std::string_view what) {
    return series(noise, drift, errors.position_drift_s, what);
  };
  const auto angle = [&](double noise_deg, double drift_deg, std::string_view what) {
    return series(radians(noise_deg), radians(drift_deg), errors.attitude_drift_s, what);
  };
  const ErrorSeries east = place(errors.position_noise_m, errors.position_drift_m, "error/east");
  const ErrorSeries north = place(errors.position_noise_m, errors.position_drift_m, "error/north");
  const ErrorSeries up = place(errors.height_noise_m, errors.height_drift_m, "error/up");
  const ErrorSeries roll = angle(errors.tilt_noise_deg, errors.tilt_drift_deg, "error/roll");
  const ErrorSeries pitch = angle(errors.tilt_noise_deg, errors.tilt_drift_deg, "error/pitch");
  const ErrorSeries heading =
      angle(errors.heading_noise_deg, errors.heading_drift_deg, "error/heading");

  std::vector<scan::StampedPose> poses;
  for (const double time_s : report_times(truth)) {
    const Eigen::Isometry3d pose = truth.world_from_body(time_s + errors.clock_offset_s);
    const double t = time_s - start_s;
    poses.push_back(
        {.time_s = time_s,
         .position_m = pose.translation() + Eigen::Vector3d(east.at(t), north.at(t), up.at(t)),
         .attitude = Eigen::AngleAxisd(heading.at(t), Eigen::Vector3d::UnitZ()) *
                     Eigen::Quaterniond(pose.linear()) *
                     Eigen::AngleAxisd(pitch.at(t), Eigen::Vector3d::UnitY()) *
                     Eigen::AngleAxisd(roll.at(t), Eigen::Vector3d::UnitX())});
  }
  return scan::Trajectory(std::move(poses));
}

Eigen::Isometry3d true_mount(const Eigen::Isometry3d& stated_body_from_lidar,
                             const PoseErrors& errors) {
  using Eigen::AngleAxisd;
  using Eigen::Vector3d;
  const Vector3d rpy = errors.boresight_rpy_deg.unaryExpr(&radians);
  Eigen::Isometry3d body_from_lidar = stated_body_from_lidar;
  body_from_lidar.linear() = AngleAxisd(rpy.z(), Vector3d::UnitZ()) *
                             AngleAxisd(rpy.y(), Vector3d::UnitY()) *
                             AngleAxisd(rpy.x(), Vector3d::UnitX()) * body_from_lidar.linear();
  body_from_lidar.pretranslate(errors.lever_arm_m);
  return body_from_lidar;
}

}  // namespace plotscan::flight
