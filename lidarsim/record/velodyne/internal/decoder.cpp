// SPDX-License-Identifier: Apache-2.0
#include "record/velodyne/internal/decoder.h"

#include <cmath>
#include <utility>

#include "core/angle.h"
#include "core/error.h"

namespace plotscan::record {
namespace {

constexpr double kAzimuthStep_rad = 2 * kPi / kAzimuthSteps;

// In dual mode two blocks describe the same shots.
std::size_t blocks_of_shots(const DataPacket& packet) {
  return packet.mode == ReturnMode::dual ? 2 : 1;
}

// From the first firing of a block to that of the next.
double block_time_s(const sensor::Sensor& sensor) {
  const std::size_t sequences = kBlockReturns / sensor.lasers.size();
  return sensor.sequence_s * static_cast<double>(sequences);
}

}  // namespace

double spin_hz(const DataPacket& packet, const sensor::Sensor& sensor) {
  constexpr double kRounded = 0.01;
  const std::size_t stride = blocks_of_shots(packet);
  const std::size_t steps = kPacketBlocks / stride - 1;  // from block to block
  const int turned = packet.blocks[steps * stride].azimuth - packet.blocks[0].azimuth;
  const double turns = (turned < 0 ? turned + kAzimuthSteps : turned) / double{kAzimuthSteps};
  const double measured_hz = turns / (static_cast<double>(steps) * block_time_s(sensor));
  const double whole_hz = std::round(measured_hz);
  return std::abs(measured_hz - whole_hz) < kRounded * whole_hz ? whole_hz : measured_hz;
}

VelodyneDecoder::VelodyneDecoder(const sensor::Sensor& sensor, std::optional<Placement> placement)
    : sensor_(sensor), placement_(std::move(placement)) {
  check(sensor.packets.has_value(), "the sensor sends Velodyne packets");
  distance_step_m_ = sensor.packets->distance_step_m;
}

void VelodyneDecoder::add_return(const Shot& shot, PacketReturn measured, int number, int count,
                                 std::vector<scan::LabelledPoint>& points) const {
  const sensor::Laser& laser = sensor_.lasers[shot.laser];
  const double range_m = distance_step_m_ * measured.distance;
  const double level_m = range_m * std::cos(laser.elevation_rad);
  const double azimuth_rad = shot.head_rad + laser.azimuth_rad;
  Eigen::Vector3d position(
      laser.radius_m * std::cos(shot.head_rad) + level_m * std::cos(azimuth_rad),
      -laser.radius_m * std::sin(shot.head_rad) - level_m * std::sin(azimuth_rad),
      laser.offset_m + range_m * std::sin(laser.elevation_rad));
  if (placement_) {
    const scan::Trajectory& trajectory = placement_->world_from_body;
    position = trajectory.world_from_body(trajectory.start_s() + shot.time_s) *
               (placement_->body_from_lidar * position);
  }
  points.push_back({.x = static_cast<float>(position.x()),
                    .y = static_cast<float>(position.y()),
                    .z = static_cast<float>(position.z()),
                    .intensity = static_cast<float>(measured.reflectivity),
                    .ring = laser.ring,
                    .time = shot.time_s,
                    .return_number = static_cast<std::uint8_t>(number),
                    .return_count = static_cast<std::uint8_t>(count)});
}

void VelodyneDecoder::decode(const DataPacket& packet, double time_s,
                             std::vector<scan::LabelledPoint>& points) {
  const std::size_t lasers = sensor_.lasers.size();
  const bool is_dual = packet.mode == ReturnMode::dual;
  const std::size_t stride = blocks_of_shots(packet);
  const double block_s = block_time_s(sensor_);
  for (std::size_t block = 0; block < kPacketBlocks; block += stride) {
    const std::size_t turn = block / stride;
    const PacketBlock& last = packet.blocks[block];
    const PacketBlock& other = packet.blocks[block + stride - 1];
    // The packet's last block keeps the turn of the block before it.
    if (block + stride < kPacketBlocks) {
      last_turn_ =
          (packet.blocks[block + stride].azimuth + kAzimuthSteps - last.azimuth) % kAzimuthSteps;
    }
    for (std::size_t i = 0; i < kBlockReturns; ++i) {
      PacketReturn near = other.returns[i];
      PacketReturn far = last.returns[i];
      if (near.distance == 0) std::swap(near, far);
      if (near.distance == 0) continue;
      const std::size_t sequence = i / lasers, laser = i % lasers;
      const double in_block_s =
          sensor_.sequence_s * static_cast<double>(sequence) + sensor_.lasers[laser].fires_s;
      const Shot shot{
          .laser = laser,
          .head_rad = kAzimuthStep_rad * (last.azimuth + last_turn_ * in_block_s / block_s),
          .time_s = time_s + block_s * static_cast<double>(turn) + in_block_s};
      const bool are_two = is_dual && far.distance != 0 && near != far;
      if (are_two && near.distance > far.distance) std::swap(near, far);
      add_return(shot, near, 1, are_two ? 2 : 1, points);
      if (are_two) add_return(shot, far, 2, 2, points);
    }
  }
}

}  // namespace plotscan::record
