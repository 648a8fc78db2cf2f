// SPDX-License-Identifier: Apache-2.0
#include "record/velodyne/encoder.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/csv.h"
#include "core/error.h"

namespace plotscan::record {
namespace {

// The most that a point's time may differ from its shot's, by rounding in any file format.
constexpr double kTimeTolerance_s = 0.5e-6;
// The farthest a point may lie off its shot's axis: single precision, 100 km from the origin.
constexpr double kAxisTolerance_m = 0.05;

std::string at_time(double time_s) { return "the point of " + format_number(time_s) + " s "; }

}  // namespace

std::uint32_t past_hour_us(UtcTime time) {
  return static_cast<std::uint32_t>((time - std::chrono::floor<std::chrono::hours>(time)).count());
}

VelodyneEncoder::VelodyneEncoder(const FlightRecord& flight, Sink sink)
    : plan_(flight.placed()),
      start_(flight.start),
      sequence_s_(plan_.time_s(1, 0) - plan_.time_s(0, 0)),
      mode_(flight.returns),
      sink_(std::move(sink)) {
  if (!flight.sensor.packets) {
    throw InputError("sensor " + flight.sensor.name +
                     " sends no Velodyne packets (its description has no `packets`)");
  }
  format_ = *flight.sensor.packets;
  for (const sensor::Laser& laser : flight.sensor.lasers) rings_.push_back(laser.ring);
  start_packet();
}

std::size_t VelodyneEncoder::sequences_a_packet() const {
  const std::size_t blocks = mode_ == ReturnMode::dual ? kPacketBlocks / 2 : kPacketBlocks;
  return blocks * (kBlockReturns / lasers());
}

std::uint64_t VelodyneEncoder::shot_of(const scan::LabelledPoint& point) const {
  for (std::size_t k = 0; k < lasers(); ++k) {
    if (rings_[k] != point.ring) continue;
    const double sequence = std::round((point.time - plan_.time_s(0, k)) / sequence_s_);
    if (!(sequence >= 0 && sequence < static_cast<double>(plan_.sequences()))) continue;
    const auto whole = static_cast<std::uint64_t>(sequence);
    if (std::abs(plan_.time_s(whole, k) - point.time) <= kTimeTolerance_s)
      return whole * lasers() + k;
  }
  throw InputError(at_time(point.time) + "in ring " + std::to_string(point.ring) +
                   " is no shot of the flight: the cloud is another sensor's or another flight's");
}

VelodyneEncoder::Return VelodyneEncoder::measured(const scan::LabelledPoint& point,
                                                  std::uint64_t shot) {
  if (shot / lasers() != fired_sequence_) {
    fired_sequence_ = shot / lasers();
    plan_.fire(fired_sequence_, shots_);
  }
  const auto k = static_cast<Eigen::Index>(shot % lasers());
  const Eigen::Vector3d origin(shots_.origin_m[0][k], shots_.origin_m[1][k], shots_.origin_m[2][k]);
  const Eigen::Vector3d direction(shots_.direction[0][k], shots_.direction[1][k],
                                  shots_.direction[2][k]);
  const Eigen::Vector3d way = Eigen::Vector3d(point.x, point.y, point.z) - origin;
  const double range_m = way.dot(direction);
  if (!((way - range_m * direction).norm() <= kAxisTolerance_m && range_m >= 0 &&
        range_m <= 65'535 * format_.distance_step_m)) {
    throw InputError(at_time(point.time) +
                     "does not lie on its shot: the cloud was not placed by these poses");
  }
  return {.range_m = range_m, .intensity = point.intensity};
}

void VelodyneEncoder::write(std::span<const scan::LabelledPoint> points) {
  for (const scan::LabelledPoint& point : points) {
    const std::uint64_t shot = shot_of(point);
    if (shot < shot_) throw InputError(at_time(point.time) + "is not in the order of firing");
    if (shot != shot_) {
      finish_shot();
      shot_ = shot;
      while (shot / lasers() >= first_sequence_ + sequences_a_packet()) send_packet();
    }
    returns_.push_back(measured(point, shot));
  }
}

void VelodyneEncoder::close() {
  finish_shot();
  while (first_sequence_ < plan_.sequences()) send_packet();
}

PacketReturn VelodyneEncoder::packed(const Return& measured) const {
  return {.distance =
              static_cast<std::uint16_t>(std::lround(measured.range_m / format_.distance_step_m)),
          .reflectivity =
              static_cast<std::uint8_t>(std::clamp(std::round(measured.intensity), 0.0F, 255.0F))};
}

// Puts the shot's returns into the packet as the mode says (manual, section 9.3.2).
void VelodyneEncoder::finish_shot() {
  if (returns_.empty()) return;
  std::ranges::stable_sort(returns_, {}, &Return::range_m);
  const Return last = returns_.back();
  const auto strongest = [this] {
    return *std::ranges::max_element(returns_, {}, &Return::intensity);
  };
  const auto in_packet = static_cast<std::size_t>(shot_ - first_sequence_ * lasers());
  const std::size_t block = in_packet / kBlockReturns;
  const std::size_t place = in_packet % kBlockReturns;
  if (mode_ == ReturnMode::dual) {
    // The strongest of the others: the strongest of all, or, if that is the last, the second
    // strongest.
    if (returns_.size() > 1) returns_.pop_back();
    packet_.data.blocks[2 * block].returns[place] = packed(last);
    packet_.data.blocks[2 * block + 1].returns[place] = packed(strongest());
  } else {
    packet_.data.blocks[block].returns[place] =
        packed(mode_ == ReturnMode::last ? last : strongest());
  }
  returns_.clear();
}

void VelodyneEncoder::start_packet() {
  packet_ = {};
  packet_.data.mode = mode_;
  packet_.data.product = format_.product;
  packet_.fired_s = plan_.time_s(first_sequence_, 0);
  packet_.sent_s = plan_.time_s(first_sequence_ + sequences_a_packet(), 0);
  packet_.data.past_hour_us = past_hour_us(later(start_, packet_.fired_s));
  const std::size_t blocks_a_shot = mode_ == ReturnMode::dual ? 2 : 1;
  for (std::size_t block = 0; block < kPacketBlocks; ++block) {
    const std::uint64_t sequence =
        first_sequence_ + block / blocks_a_shot * (kBlockReturns / lasers());
    const auto steps = std::lround(kAzimuthSteps * plan_.head_turns(sequence));
    packet_.data.blocks[block].azimuth = static_cast<std::uint16_t>(steps % kAzimuthSteps);
  }
}

void VelodyneEncoder::send_packet() {
  sink_(packet_);
  first_sequence_ += sequences_a_packet();
  start_packet();
}

}  // namespace plotscan::record
