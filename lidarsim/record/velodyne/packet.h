// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "record/recording/flight_record.h"

namespace plotscan::record {

// The UDP payloads of Velodyne's spinning sensors (VLP-16 User Manual 63-9243 Rev. D, section 9.3;
// the same for the Puck Hi-Res, the VLP-32C and the HDL-32E), little endian.
inline constexpr std::size_t kDataPacketSize = 1206;
inline constexpr std::size_t kPositionPacketSize = 512;
inline constexpr std::uint16_t kDataPort = 2368;
inline constexpr std::uint16_t kPositionPort = 8308;
inline constexpr std::size_t kPacketBlocks = 12;
inline constexpr std::size_t kBlockReturns = 32;
inline constexpr std::uint16_t kAzimuthSteps = 36'000;  // of 0.01 degrees, a turn

struct PacketReturn {
  std::uint16_t distance = 0;     // along the beam, in PacketFormat's steps; 0: no return
  std::uint8_t reflectivity = 0;  // percent, over 100 for retroreflectors

  bool operator==(const PacketReturn&) const = default;
};

// One firing sequence of 32 lasers, or two of 16, one after the other; lasers by id. In dual mode
// two blocks describe the same shots: the even one the last return, the odd one the strongest, or
// the second strongest if the strongest is the last. If there was only one return, both hold it
// (manual, section 9.3.2).
struct PacketBlock {
  std::uint16_t azimuth = 0;  // of the first firing, 0.01 degrees, 0..35999
  std::array<PacketReturn, kBlockReturns> returns;

  bool operator==(const PacketBlock&) const = default;
};

struct DataPacket {
  std::array<PacketBlock, kPacketBlocks> blocks;
  std::uint32_t past_hour_us = 0;  // when the first firing was, microseconds past the UTC hour
  ReturnMode mode = ReturnMode::strongest;
  std::uint8_t product = 0;  // 0x21 HDL-32E, 0x22 VLP-16 and Puck LITE, 0x24 Hi-Res, 0x28 VLP-32C

  bool operator==(const DataPacket&) const = default;
};

using DataPacketBytes = std::array<std::uint8_t, kDataPacketSize>;

DataPacketBytes encode(const DataPacket& packet);

// Absent if the bytes are no data packet: another length, block flags other than 0xFFEE (an
// HDL-64E's or VLS-128's among them), an azimuth of 360 degrees and more, or an unknown mode byte.
std::optional<DataPacket> decode_data_packet(std::span<const std::uint8_t> payload);

// Whether the sensor's clock follows a GPS receiver's pulse per second.
enum class PpsStatus : std::uint8_t { absent = 0, synchronising = 1, locked = 2, error = 3 };

// What the sensor passes on from its GPS receiver (manual, section 9.3.3).
struct PositionPacket {
  std::uint32_t past_hour_us = 0;
  PpsStatus pps = PpsStatus::absent;
  std::string sentence;  // NMEA 0183, without the CR LF that ends it

  bool operator==(const PositionPacket&) const = default;
};

using PositionPacketBytes = std::array<std::uint8_t, kPositionPacketSize>;

PositionPacketBytes encode(const PositionPacket& packet);

// Absent if the bytes are no position packet: another length, or an unknown PPS status.
std::optional<PositionPacket> decode_position_packet(std::span<const std::uint8_t> payload);

}  // namespace plotscan::record
