// SPDX-License-Identifier: Apache-2.0
#include "record/velodyne/packet.h"

#include <algorithm>

#include "core/error.h"

namespace plotscan::record {
namespace {

constexpr std::uint16_t kBlockFlag = 0xEEFF;  // the bytes FF EE
constexpr std::size_t kBlockSize = 100;
constexpr std::size_t kTimestampAt = kPacketBlocks * kBlockSize;
constexpr std::size_t kModeAt = 1204;
constexpr std::size_t kProductAt = 1205;

constexpr std::size_t kPositionTimestampAt = 198;
constexpr std::size_t kPpsAt = 202;
constexpr std::size_t kSentenceAt = 206;

void put16(std::uint8_t* at, std::uint16_t value) {
  at[0] = static_cast<std::uint8_t>(value);
  at[1] = static_cast<std::uint8_t>(value >> 8);
}

void put32(std::uint8_t* at, std::uint32_t value) {
  put16(at, static_cast<std::uint16_t>(value));
  put16(at + 2, static_cast<std::uint16_t>(value >> 16));
}

std::uint16_t get16(const std::uint8_t* at) {
  return static_cast<std::uint16_t>(at[0] | at[1] << 8);
}

std::uint32_t get32(const std::uint8_t* at) {
  return get16(at) | static_cast<std::uint32_t>(get16(at + 2)) << 16;
}

}  // namespace

DataPacketBytes encode(const DataPacket& packet) {
  DataPacketBytes bytes{};
  std::uint8_t* at = bytes.data();
  for (const PacketBlock& block : packet.blocks) {
    check(block.azimuth < kAzimuthSteps, "a block's azimuth is below 360 degrees");
    put16(at, kBlockFlag);
    put16(at + 2, block.azimuth);
    at += 4;
    for (const PacketReturn& measured : block.returns) {
      put16(at, measured.distance);
      at[2] = measured.reflectivity;
      at += 3;
    }
  }
  put32(bytes.data() + kTimestampAt, packet.past_hour_us);
  bytes[kModeAt] = static_cast<std::uint8_t>(packet.mode);
  bytes[kProductAt] = packet.product;
  return bytes;
}

std::optional<DataPacket> decode_data_packet(std::span<const std::uint8_t> payload) {
  if (payload.size() != kDataPacketSize) return std::nullopt;
  DataPacket packet;
  const std::uint8_t* at = payload.data();
  for (PacketBlock& block : packet.blocks) {
    block.azimuth = get16(at + 2);
    if (get16(at) != kBlockFlag || block.azimuth >= kAzimuthSteps) return std::nullopt;
    at += 4;
    for (PacketReturn& measured : block.returns) {
      measured = {.distance = get16(at), .reflectivity = at[2]};
      at += 3;
    }
  }
  packet.past_hour_us = get32(payload.data() + kTimestampAt);
  packet.mode = static_cast<ReturnMode>(payload[kModeAt]);
  packet.product = payload[kProductAt];
  if (packet.mode < ReturnMode::strongest || packet.mode > ReturnMode::dual) return std::nullopt;
  return packet;
}

PositionPacketBytes encode(const PositionPacket& packet) {
  check(kSentenceAt + packet.sentence.size() + 2 <= kPositionPacketSize, "the sentence fits");
  PositionPacketBytes bytes{};
  put32(bytes.data() + kPositionTimestampAt, packet.past_hour_us);
  bytes[kPpsAt] = static_cast<std::uint8_t>(packet.pps);
  const auto end = std::ranges::copy(packet.sentence, bytes.begin() + kSentenceAt).out;
  std::ranges::copy(std::array{'\r', '\n'}, end);
  return bytes;
}

std::optional<PositionPacket> decode_position_packet(std::span<const std::uint8_t> payload) {
  if (payload.size() != kPositionPacketSize) return std::nullopt;
  PositionPacket packet{.past_hour_us = get32(payload.data() + kPositionTimestampAt),
                        .pps = static_cast<PpsStatus>(payload[kPpsAt]),
                        .sentence = {}};
  if (packet.pps > PpsStatus::error) return std::nullopt;
  const auto text = payload.subspan(kSentenceAt);
  const auto ends = [](std::uint8_t byte) { return byte == '\r' || byte == '\n' || byte == 0; };
  packet.sentence.assign(text.begin(), std::ranges::find_if(text, ends));
  return packet;
}

}  // namespace plotscan::record
