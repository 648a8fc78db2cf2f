// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "record/recording/flight_record.h"
#include "record/ros/message_file.h"
#include "record/velodyne/encoder.h"
#include "scan/point.h"

namespace plotscan::record {

struct RosRecorderOptions {
  // How the drone truly moved, over the same time: this is what an inertial unit measures. Absent:
  // the reported poses are used.
  std::optional<scan::Trajectory> motion = {};
  // Also record the sensor's raw packets, if it sends Velodyne's. The points must then be shots of
  // the flight (record/velodyne/encoder.h).
  bool packets = false;
  // What the flight's poses and the points count from, in the world frame.
  Eigen::Vector3d origin_m = Eigen::Vector3d::Zero();
};

// Records a flight as a drone's computer would: sweeps of the sensor, poses, clock, inertial
// measurements and fixes, in the order of time. docs/formats.md, "ROS bags", says which topics and
// in which frames.
class RosRecorder : public scan::PointWriter {
 public:
  // Makes a file with these topics: ros::create_bag or ros::create_mcap, bound to a path.
  using CreateFile = std::function<std::unique_ptr<ros::FileWriter>(std::vector<ros::Topic>)>;

  RosRecorder(const FlightRecord& flight, const RosRecorderOptions& options,
              const CreateFile& create);
  RosRecorder(const RosRecorder&) = delete;
  RosRecorder& operator=(const RosRecorder&) = delete;

  // Takes points in the order of firing, relative to the origin. Throws InputError on one from
  // before the sweep that is being recorded; with packets, as VelodyneEncoder does.
  void write(std::span<const scan::LabelledPoint> points) override;
  void close() override;

 private:
  // Something that is recorded at a fixed interval.
  struct Beat {
    double interval_s;
    void (RosRecorder::*emit)(double time_s);
    std::uint64_t done = 0;

    double next_s() const { return static_cast<double>(done) * interval_s; }
  };

  // `time_s`, like all times below, is in seconds from the flight's start.
  ros::Time stamp(double time_s) const;
  ros::Header header(double time_s, const char* frame) const;
  template <class Message>
  void put(std::size_t topic, double time_s, const Message& message);

  // Emits everything that is due until then, except sweeps.
  void advance(double time_s);
  // Adds a topic and returns its number in the file.
  std::size_t topic(const char* name, const char* type, bool latched = false);
  // Ends the sweep and begins the next one.
  void end_sweep();
  void emit_packets(double end_s);
  void emit_mounts();
  void emit_clock(double time_s);
  void emit_pose(double time_s);
  void emit_inertial(double time_s);
  void emit_fix(double time_s);
  // The reported pose of the body.
  Eigen::Isometry3d world_from_body(double time_s) const;

  struct Topics {
    std::size_t clock, mounts, poses, inertial, packets, points, fix;
  };

  FlightRecord flight_;
  scan::Trajectory motion_;
  Eigen::Vector3d origin_m_;
  std::vector<ros::Topic> all_topics_;
  Topics topics_;
  std::unique_ptr<ros::FileWriter> file_;
  double start_s_ = 0;  // of the reported trajectory
  double duration_s_ = 0;
  double sweep_interval_s_ = 0;
  std::vector<double> pose_times_s_;
  std::size_t poses_done_ = 0;
  std::vector<Beat> beats_;
  std::uint64_t sweeps_done_ = 0;
  ros::PointCloud2 sweep_;
  std::optional<VelodyneEncoder> encoder_;
  std::deque<SentPacket> sent_;  // not written yet
};

}  // namespace plotscan::record
