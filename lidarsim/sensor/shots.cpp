// SPDX-License-Identifier: Apache-2.0
#include "sensor/shots.h"

#include <algorithm>
#include <cmath>

#include "core/angle.h"
#include "core/error.h"
#include "core/random.h"

namespace plotscan::sensor {
namespace {

// Below this angle per firing sequence, rotation is computed to second order: the error, the
// angle's cube over 6, stays below 2e-10.
constexpr double kSmallTurn_rad = 1e-3;
// A smaller turn from pose to pose is only rounding.
constexpr double kNoTurn_rad = 1e-14;

Eigen::Matrix3d rotation(const Eigen::Vector3d& turn_rad) {
  const double angle = turn_rad.norm();
  if (angle == 0) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(angle, turn_rad / angle).toRotationMatrix();
}

// The vector that turns attitude a into b by the shorter way, in a's frame.
Eigen::Vector3d turn_between(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b) {
  const Eigen::AngleAxisd turn = scan::shorter_turn(a, b);
  if (std::abs(turn.angle()) < kNoTurn_rad) return Eigen::Vector3d::Zero();
  return turn.angle() * turn.axis();
}

VectorPerLaser cross(const Eigen::Vector3d& a, const VectorPerLaser& b) {
  return {a.y() * b[2] - a.z() * b[1], a.z() * b[0] - a.x() * b[2], a.x() * b[1] - a.y() * b[0]};
}

// Vectors turned by the rate times each laser's time, to second order.
VectorPerLaser turned(const VectorPerLaser& vectors, const Eigen::Vector3d& rate,
                      const PerLaser& time_s) {
  if (rate.isZero(0)) return vectors;
  const VectorPerLaser first = cross(rate, vectors);
  const VectorPerLaser second = cross(rate, first);
  VectorPerLaser result;
  for (int axis = 0; axis < 3; ++axis)
    result[axis] = vectors[axis] + time_s * (first[axis] + 0.5 * time_s * second[axis]);
  return result;
}

}  // namespace

ShotPlan::ShotPlan(const Sensor& sensor, double spin_hz, const Eigen::Isometry3d& body_from_lidar,
                   const scan::Trajectory& trajectory, const SpinJitter& jitter)
    : sequence_s_(sequence_time_s(sensor, spin_hz)),
      spin_hz_(spin_hz),
      jitter_(jitter),
      jitter_sequences_(std::max<std::uint64_t>(1, kJitterFirings / sensor.lasers.size())) {
  check(sensor.lasers.size() <= kMaxLasers, "the sensor has too many lasers");
  const auto lasers = static_cast<Eigen::Index>(sensor.lasers.size());
  const auto of_each = [&](auto&& value) {
    return PerLaser::NullaryExpr(
        lasers, [&sensor, value](Eigen::Index k) { return value(sensor.lasers[k]); });
  };
  fires_s_ = of_each([](const Laser& laser) { return laser.fires_s; });
  cos_elevation_ = of_each([](const Laser& laser) { return std::cos(laser.elevation_rad); });
  sin_elevation_ = of_each([](const Laser& laser) { return std::sin(laser.elevation_rad); });
  if (sensor.wedges) risley_.emplace(*sensor.wedges, fires_s_);
  const PerLaser head_rad = 2 * kPi * spin_hz * fires_s_;
  const PerLaser advance_rad =
      head_rad + of_each([](const Laser& laser) { return laser.azimuth_rad; });
  cos_advance_ = advance_rad.cos();
  sin_advance_ = advance_rad.sin();
  const PerLaser radius_m = of_each([](const Laser& laser) { return laser.radius_m; });
  if ((radius_m != 0).any()) {
    radius_cos_m_ = radius_m * head_rad.cos();
    radius_sin_m_ = radius_m * head_rad.sin();
  }
  const Eigen::Matrix3d lidar_from_body = body_from_lidar.linear().transpose();
  const Eigen::Vector3d lever = lidar_from_body * body_from_lidar.translation();
  for (int axis = 0; axis < 3; ++axis) lever_m_[axis] = PerLaser::Constant(lasers, lever[axis]);
  lever_m_[2] += of_each([](const Laser& laser) { return laser.offset_m; });
  const auto& poses = trajectory.poses();
  const double start_s = trajectory.start_s();
  for (std::size_t i = 0; i + 1 < poses.size(); ++i) {
    const double duration_s = poses[i + 1].time_s - poses[i].time_s;
    segments_.push_back(
        {.start_s = poses[i].time_s - start_s,
         .end_s = poses[i + 1].time_s - start_s,
         .position_m = poses[i].position_m,
         .velocity_m_s = (poses[i + 1].position_m - poses[i].position_m) / duration_s,
         .world_from_lidar = poses[i].attitude.toRotationMatrix() * body_from_lidar.linear(),
         .turn_rad_s = lidar_from_body * turn_between(poses[i].attitude, poses[i + 1].attitude) /
                       duration_s});
  }
  sequences_ = static_cast<std::uint64_t>((trajectory.end_s() - start_s) / sequence_s_);
}

const ShotPlan::Segment& ShotPlan::segment(double time_s) const {
  const auto after =
      std::upper_bound(segments_.begin() + 1, segments_.end(), time_s,
                       [](double time, const Segment& segment) { return time < segment.start_s; });
  return *(after - 1);
}

void ShotPlan::fire(std::uint64_t sequence, SequenceShots& shots) const {
  const double time_s = static_cast<double>(sequence) * sequence_s_;
  const Segment& motion = segment(time_s);
  const Eigen::Index lasers = fires_s_.size();
  const bool is_steady = time_s + fires_s_[lasers - 1] <= motion.end_s &&
                         motion.turn_rad_s.norm() * sequence_s_ <= kSmallTurn_rad;
  for (int axis = 0; axis < 3; ++axis) {
    shots.origin_m[axis].resize(lasers);
    shots.direction[axis].resize(lasers);
  }
  if (is_steady) {
    fire_lasers(motion, sequence, 0, lasers, shots);
    return;
  }
  for (Eigen::Index k = 0; k < lasers; ++k)
    fire_lasers(segment(time_s + fires_s_[k]), sequence, k, 1, shots);
}

double ShotPlan::jitter_turns(std::uint64_t sequence) const {
  const std::uint64_t block = sequence / jitter_sequences_;
  const auto at = [this](std::uint64_t index) {
    return RandomStream(jitter_.seed, random_purpose("sensor/spin jitter"), index).normal();
  };
  const double share =
      static_cast<double>(sequence % jitter_sequences_) / static_cast<double>(jitter_sequences_);
  return jitter_.sd_rad / (2 * kPi) * std::lerp(at(block), at(block + 1), share);
}

double ShotPlan::head_turns(std::uint64_t sequence) const {
  double turns = spin_hz_ * (static_cast<double>(sequence) * sequence_s_);
  if (jitter_.sd_rad > 0) turns += jitter_turns(sequence);
  return turns - std::floor(turns);
}

// The lasers' directions when the head has this azimuth at the sequence's start.
VectorPerLaser ShotPlan::spun_directions(double cos_azimuth, double sin_azimuth, Eigen::Index begin,
                                         Eigen::Index count) const {
  const auto these = [begin, count](const PerLaser& all) { return all.segment(begin, count); };
  return {these(cos_elevation_) *
              (cos_azimuth * these(cos_advance_) - sin_azimuth * these(sin_advance_)),
          -these(cos_elevation_) *
              (sin_azimuth * these(cos_advance_) + cos_azimuth * these(sin_advance_)),
          these(sin_elevation_)};
}

Eigen::Vector3d ShotPlan::spin_axis(std::uint64_t sequence) const {
  const double time_s = static_cast<double>(sequence) * sequence_s_;
  const Segment& motion = segment(time_s);
  return motion.world_from_lidar * rotation(motion.turn_rad_s * (time_s - motion.start_s)) *
         Eigen::Vector3d::UnitZ();
}

// Fires `count` lasers of the sequence, all within one segment. The attitude is exact when the
// first of them fires; for the others it is turned on from there to second order.
void ShotPlan::fire_lasers(const Segment& motion, std::uint64_t sequence, Eigen::Index begin,
                           Eigen::Index count, SequenceShots& shots) const {
  const double time_s = static_cast<double>(sequence) * sequence_s_;
  const auto these = [begin, count](const PerLaser& all) { return all.segment(begin, count); };
  const double in_segment_s = time_s + fires_s_[begin] - motion.start_s;
  const Eigen::Matrix3d world_from_lidar =
      motion.world_from_lidar * rotation(motion.turn_rad_s * in_segment_s);
  const Eigen::Vector3d position = motion.position_m + motion.velocity_m_s * in_segment_s;
  const PerLaser later_s = these(fires_s_) - fires_s_[begin];

  const double azimuth = 2 * kPi * head_turns(sequence);
  const double cosine = std::cos(azimuth);
  const double sine = std::sin(azimuth);
  const VectorPerLaser direction = turned(risley_ ? risley_->directions(time_s, begin, count)
                                                  : spun_directions(cosine, sine, begin, count),
                                          motion.turn_rad_s, later_s);
  VectorPerLaser arm = {these(lever_m_[0]), these(lever_m_[1]), these(lever_m_[2])};
  if (radius_cos_m_.size() > 0) {
    arm[0] += cosine * these(radius_cos_m_) - sine * these(radius_sin_m_);
    arm[1] -= sine * these(radius_cos_m_) + cosine * these(radius_sin_m_);
  }
  const VectorPerLaser lever = turned(arm, motion.turn_rad_s, later_s);
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::RowVector3d row = world_from_lidar.row(axis);
    shots.direction[axis].segment(begin, count) =
        row[0] * direction[0] + row[1] * direction[1] + row[2] * direction[2];
    shots.origin_m[axis].segment(begin, count) =
        position[axis] + motion.velocity_m_s[axis] * later_s + row[0] * lever[0] +
        row[1] * lever[1] + row[2] * lever[2];
  }
}

}  // namespace plotscan::sensor
