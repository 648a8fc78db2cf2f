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
#include "record/ros/file.h"
#include "record/velodyne/encoder.h"
#include "scan/point.h"

namespace plotscan::record {

struct RosRecorderOptions {
  // How the drone truly moved, which is what an inertial unit feels, over the same time; without it
  // the reported poses stand for it.
  std::optional<scan::Trajectory> motion = {};
  // The sensor's raw packets too, where it sends Velodyne's: the points must then be shots of the
  // flight (record/velodyne/encoder.h).
  bool packets = false;
};

// Records a flight as a drone's computer would: sweeps of the sensor, poses, clock, inertial
// measurements and fixes, in the order in which they come up. docs/formats.md, "ROS bags", says
// which topics and in which frames.
class RosRecorder : public scan::PointWriter {
 public:
  // Makes a file of these topics: ros::create_bag or ros::create_mcap of a path.
  using CreateFile = std::function<std::unique_ptr<ros::FileWriter>(std::vector<ros::Topic>)>;

  RosRecorder(const FlightRecord& flight, const RosRecorderOptions& options,
              const CreateFile& create);
  RosRecorder(const RosRecorder&) = delete;
  RosRecorder& operator=(const RosRecorder&) = delete;

  // Points in the order of firing, world frame. Throws InputError as VelodyneEncoder does where
  // there are packets.
  void write(std::span<const scan::LabelledPoint> points) override;
  void close() override;

 private:
  // Something that happens so many times a second.
  struct Beat {
    double interval_s;
    void (RosRecorder::*emit)(double time_s);
    std::uint64_t done = 0;

    double next_s() const { return static_cast<double>(done) * interval_s; }
  };

  // Seconds from the flight's start, in which all times below are.
  ros::Time stamp(double time_s) const;
  ros::Header header(double time_s, const char* frame) const;
  template <class Message>
  void put(std::size_t topic, double time_s, const Message& message);

  // Emits all but sweeps that is due until then.
  void advance(double time_s);
  // The file's number of a topic.
  std::size_t topic(const char* name, const char* type, bool latched = false);
  // Ends the sweep and begins the next one.
  // Throws InputError on a time outside the trajectory.
  void require_flown(double time_s) const;
  void end_sweep();
  void emit_packets(double end_s);
  void emit_mounts();
  void emit_clock(double time_s);
  void emit_pose(double time_s);
  void emit_inertial(double time_s);
  void emit_fix(double time_s);

  struct Topics {
    std::size_t clock, mounts, poses, inertial, packets, points, fix;
  };

  FlightRecord flight_;
  scan::Trajectory motion_;
  std::vector<ros::Topic> all_topics_;
  Topics topics_;
  std::unique_ptr<ros::FileWriter> file_;
  double start_s_ = 0;  // of the trajectory
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
