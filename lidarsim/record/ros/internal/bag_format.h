// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>

#include "record/ros/message_file.h"

// What the writer and the reader of bags share (wiki.ros.org/Bags/Format/2.0).
namespace plotscan::record::ros {

inline constexpr std::string_view kBagMagic = "#ROSBAG V2.0\n";

enum class BagOp : std::uint8_t {
  message = 2,
  file_header = 3,
  index = 4,
  chunk = 5,
  chunk_info = 6,
  connection = 7
};

// read_messages of a bag.
void read_bag(const std::filesystem::path& file, const MessageSink& sink);

}  // namespace plotscan::record::ros
