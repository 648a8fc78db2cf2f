// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>

#include "record/ros/message_file.h"

// What the writer and the reader of MCAP share (mcap.dev/spec).
namespace plotscan::record::ros {

inline constexpr std::string_view kMcapMagic("\x89MCAP0\r\n", 8);
inline constexpr std::uint64_t kMcapFooterSize = 20;

enum class McapOp : std::uint8_t {
  header = 0x01,
  footer = 0x02,
  schema = 0x03,
  channel = 0x04,
  message = 0x05,
  chunk = 0x06,
  message_index = 0x07,
  chunk_index = 0x08,
  statistics = 0x0B,
  metadata = 0x0C,
  metadata_index = 0x0D,
  summary_offset = 0x0E,
  data_end = 0x0F
};

// CRC-32 as in zlib; `before` is the CRC of the bytes that come before these.
std::uint32_t mcap_crc(std::string_view bytes, std::uint32_t before = 0);

// read_messages of an MCAP file.
void read_mcap(const std::filesystem::path& file, const MessageSink& sink);

}  // namespace plotscan::record::ros
