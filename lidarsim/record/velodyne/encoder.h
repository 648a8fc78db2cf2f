// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "record/recording/flight_record.h"
#include "record/velodyne/packet.h"
#include "scan/point.h"
#include "sensor/shots.h"

namespace plotscan::record {

// Microseconds past the UTC hour, which is how Velodyne's packets state the time.
std::uint32_t past_hour_us(UtcTime time);

// A data packet and its times, seconds from the flight's start.
struct SentPacket {
  DataPacket data;
  double fired_s = 0;  // when its first firing was; data.past_hour_us is this, rounded
  double sent_s = 0;   // when it is complete: at the next packet's first firing
};

// Turns the points of a flight back into the data packets that the sensor sent: every point becomes
// a range along its shot (from the laser's own origin: readers add the vertical correction), and
// every shot without a point a distance of 0. The packets follow each other without a gap from the
// flight's start to its end, where the last one is padded with shots without a return.
class VelodyneEncoder {
 public:
  // Receives the packets in the order of time.
  using Sink = std::function<void(const SentPacket&)>;

  // Throws InputError when the sensor sends no Velodyne packets.
  VelodyneEncoder(const FlightRecord& flight, Sink sink);

  // Takes points in the order of firing, world frame. Throws InputError on points out of this
  // order, and on points that are not shots of the flight.
  void write(std::span<const scan::LabelledPoint> points);
  // Sends the remaining packets of the flight.
  void close();

 private:
  // A return of the current shot.
  struct Return {
    double range_m = 0;
    float intensity = 0;
  };

  std::uint64_t shot_of(const scan::LabelledPoint& point) const;
  Return measured(const scan::LabelledPoint& point, std::uint64_t shot);
  void finish_shot();
  void start_packet();
  void send_packet();
  PacketReturn packed(const Return& measured) const;

  std::size_t lasers() const { return plan_.lasers(); }
  std::size_t sequences_a_packet() const;

  sensor::ShotPlan plan_;
  sensor::PacketFormat format_;
  std::vector<std::uint16_t> rings_;
  UtcTime start_;
  double sequence_s_ = 0;
  ReturnMode mode_;
  Sink sink_;

  SentPacket packet_;
  std::uint64_t first_sequence_ = 0;  // of the current packet
  std::uint64_t shot_ = 0;            // the shot whose returns are collected
  std::vector<Return> returns_;
  sensor::SequenceShots shots_;  // of fired_sequence_
  std::uint64_t fired_sequence_ = std::numeric_limits<std::uint64_t>::max();
};

}  // namespace plotscan::record
