// SPDX-License-Identifier: Apache-2.0
#include "record/ros/recorder.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "core/error.h"
#include "record/ros/internal/cloud_message.h"
#include "record/ros/internal/inertial.h"

namespace plotscan::record {
namespace {

// Names of frames (REP 105). The world frame is ENU and fixed to the Earth: REP 105's "map".
constexpr const char* kWorld = "map";
constexpr const char* kBody = "base_link";
constexpr const char* kSensor = "velodyne";
constexpr const char* kInertial = "imu";
constexpr const char* kReceiver = "gps";

constexpr double kClock_s = 0.01;
constexpr double kInertial_s = 0.01;
constexpr double kFix_s = 0.1;
// The longest interval between poses: those of the flight, with more in between as needed.
constexpr double kPose_s = 0.01;
// The duration of a sweep of a sensor that does not turn.
constexpr double kSweep_s = 0.1;

ros::Transform transform_of(const Eigen::Isometry3d& pose) {
  const Eigen::Vector3d& t = pose.translation();
  const Eigen::Quaterniond q(pose.linear());
  return {.translation = {t.x(), t.y(), t.z()}, .rotation = {q.x(), q.y(), q.z(), q.w()}};
}

ros::Vector3 vector_of(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

// The times of the poses to record, from the flight's start.
std::vector<double> pose_times(const scan::Trajectory& trajectory) {
  const auto& poses = trajectory.poses();
  std::vector<double> times_s;
  for (std::size_t i = 0; i + 1 < poses.size(); ++i) {
    const double begin_s = poses[i].time_s - trajectory.start_s();
    const double gap_s = poses[i + 1].time_s - poses[i].time_s;
    // The tolerance keeps rounding from splitting a gap of exactly kPose_s.
    const double parts = std::max(1.0, std::ceil(gap_s / kPose_s - 1e-6));
    for (std::int64_t part = 0; static_cast<double>(part) < parts; ++part)
      times_s.push_back(begin_s + gap_s * static_cast<double>(part) / parts);
  }
  times_s.push_back(trajectory.end_s() - trajectory.start_s());
  return times_s;
}

// Messages are written as time goes on; the points of a turn of the sensor are one message.
void require_in_order(double time_s, double sweep_begin_s) {
  constexpr double kRounding_s = 1e-6;
  // Only the first turn may begin before the flight does.
  if (sweep_begin_s == 0 || time_s >= sweep_begin_s - kRounding_s) return;
  throw InputError(fmt::format(
      "a point was measured {:.6f} s after the flight's start, and one before it {:.6f} s or more; "
      "a recording needs the cloud in the order of time (sort it by time first)",
      time_s, sweep_begin_s));
}

}  // namespace

RosRecorder::RosRecorder(const FlightRecord& flight, const RosRecorderOptions& options,
                         const CreateFile& create)
    : flight_(flight),
      motion_(options.motion.value_or(flight.reported)),
      origin_m_(options.origin_m),
      topics_{.clock = topic("/clock", ros::Clock::kType),
              .mounts = topic("/tf_static", ros::TFMessage::kType, true),
              .poses = topic("/tf", ros::TFMessage::kType),
              .inertial = topic("/imu", ros::Imu::kType),
              .packets = 0,
              .points = topic("/velodyne_points", ros::PointCloud2::kType),
              .fix = 0},
      start_s_(flight.reported.start_s()),
      duration_s_(flight.reported.end_s() - start_s_),
      sweep_interval_s_(flight.spin_hz > 0 ? 1 / flight.spin_hz : kSweep_s),
      pose_times_s_(pose_times(flight.reported)),
      beats_({{.interval_s = kClock_s, .emit = &RosRecorder::emit_clock},
              {.interval_s = kInertial_s, .emit = &RosRecorder::emit_inertial}}) {
  if (flight.anchor) {
    topics_.fix = topic("/gps/fix", ros::NavSatFix::kType);
    beats_.push_back({.interval_s = kFix_s, .emit = &RosRecorder::emit_fix});
  }
  if (options.packets && flight.sensor.packets) {
    topics_.packets = topic("/velodyne_packets", ros::VelodyneScan::kType);
    encoder_.emplace(flight, [this](const SentPacket& packet) { sent_.push_back(packet); });
  }
  file_ = create(all_topics_);
  emit_mounts();
  sweep_ = labelled_cloud(header(0, kSensor));
}

std::size_t RosRecorder::topic(const char* name, const char* type, bool latched) {
  all_topics_.push_back({.name = name, .type = type, .latched = latched});
  return all_topics_.size() - 1;
}

void RosRecorder::write(std::span<const scan::LabelledPoint> points) {
  const Eigen::Isometry3d lidar_from_body = flight_.body_from_lidar.inverse();
  for (const scan::LabelledPoint& point : points) {
    require_flown(flight_, point.time);
    if (encoder_) encoder_->write({&point, 1});
    while (point.time >= static_cast<double>(sweeps_done_ + 1) * sweep_interval_s_) end_sweep();
    const double begin_s = static_cast<double>(sweeps_done_) * sweep_interval_s_;
    require_in_order(point.time, begin_s);
    // The position as seen from the sensor at that instant: motion within the sweep is not
    // corrected.
    const Eigen::Isometry3d body_from_world =
        flight_.reported.world_from_body(start_s_ + point.time).inverse();
    const Eigen::Vector3d position =
        lidar_from_body * (body_from_world * Eigen::Vector3d(point.x, point.y, point.z));
    add_point(sweep_, point, position.cast<float>(), static_cast<float>(point.time - begin_s));
  }
}

void RosRecorder::close() {
  if (encoder_) encoder_->close();
  // Points may be measured shortly after the trajectory's end.
  while (static_cast<double>(sweeps_done_) * sweep_interval_s_ < duration_s_ || sweep_.width > 0)
    end_sweep();
  advance(duration_s_);
  file_->close();
}

ros::Time RosRecorder::stamp(double time_s) const {
  const std::int64_t start_us = flight_.start.time_since_epoch().count();
  return {1000 * start_us + std::llround(1e9 * time_s)};
}

ros::Header RosRecorder::header(double time_s, const char* frame) const {
  return {.stamp = stamp(time_s), .frame_id = frame};
}

template <class Message>
void RosRecorder::put(std::size_t topic, double time_s, const Message& message) {
  file_->write(topic, stamp(time_s), ros::encode(file_->version(), message));
}

void RosRecorder::advance(double time_s) {
  for (;;) {
    const auto beat = std::ranges::min_element(beats_, {}, &Beat::next_s);
    const bool has_pose = poses_done_ < pose_times_s_.size();
    const double pose_s = has_pose ? pose_times_s_[poses_done_] : beat->next_s() + 1;
    if (std::min(pose_s, beat->next_s()) > time_s) return;
    if (pose_s <= beat->next_s()) {
      emit_pose(pose_s);
      ++poses_done_;
    } else {
      (this->*beat->emit)(beat->next_s());
      ++beat->done;
    }
  }
}

// A sweep is recorded when it ends, but stamped with its beginning, from which its points' times
// count, like velodyne_pointcloud's with timestamp_first_packet.
void RosRecorder::end_sweep() {
  const double end_s =
      std::min(static_cast<double>(sweeps_done_ + 1) * sweep_interval_s_, duration_s_);
  advance(end_s);
  if (encoder_) emit_packets(end_s);
  put(topics_.points, end_s, sweep_);
  ++sweeps_done_;
  sweep_ = labelled_cloud(header(static_cast<double>(sweeps_done_) * sweep_interval_s_, kSensor));
}

// Emits the packets completed since the last sweep. The flight's last packet may extend beyond its
// end.
void RosRecorder::emit_packets(double end_s) {
  const bool is_last = end_s >= duration_s_;
  ros::VelodyneScan scan;
  while (!sent_.empty() && (is_last || sent_.front().sent_s <= end_s)) {
    scan.packets.push_back(
        {.stamp = stamp(sent_.front().fired_s), .data = encode(sent_.front().data)});
    sent_.pop_front();
  }
  if (scan.packets.empty()) return;
  scan.header = {.stamp = scan.packets.front().stamp, .frame_id = kSensor};
  put(topics_.packets, end_s, scan);
}

Eigen::Isometry3d RosRecorder::world_from_body(double time_s) const {
  return Eigen::Translation3d(origin_m_) * flight_.reported.world_from_body(start_s_ + time_s);
}

void RosRecorder::emit_mounts() {
  const Eigen::Isometry3d same = Eigen::Isometry3d::Identity();
  ros::TFMessage message;
  message.transforms = {{header(0, kBody), kSensor, transform_of(flight_.body_from_lidar)},
                        {header(0, kBody), kInertial, transform_of(same)},
                        {header(0, kBody), kReceiver, transform_of(same)}};
  put(topics_.mounts, 0, message);
}

void RosRecorder::emit_clock(double time_s) {
  put(topics_.clock, time_s, ros::Clock{stamp(time_s)});
}

void RosRecorder::emit_pose(double time_s) {
  ros::TFMessage message;
  message.transforms = {{header(time_s, kWorld), kBody, transform_of(world_from_body(time_s))}};
  put(topics_.poses, time_s, message);
}

void RosRecorder::emit_inertial(double time_s) {
  const InertialSample sample = inertial_sample(motion_, motion_.start_s() + time_s, kInertial_s);
  const ros::Imu message{.header = header(time_s, kInertial),
                         .orientation = transform_of(world_from_body(time_s)).rotation,
                         .angular_velocity = vector_of(sample.angular_rate_rad_s),
                         .linear_acceleration = vector_of(sample.specific_force_m_s2)};
  put(topics_.inertial, time_s, message);
}

void RosRecorder::emit_fix(double time_s) {
  const GeodeticPoint place =
      geodetic_from_world(*flight_.anchor, world_from_body(time_s).translation());
  const ros::NavSatFix message{.header = header(time_s, kReceiver),
                               .latitude = place.latitude_deg,
                               .longitude = std::remainder(place.longitude_deg, 360.0),
                               .altitude = place.altitude_m};
  put(topics_.fix, time_s, message);
}

}  // namespace plotscan::record
