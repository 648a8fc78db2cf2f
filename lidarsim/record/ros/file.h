// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "record/ros/codec.h"

// Files of ROS messages: bags of ROS 1 and MCAP of ROS 2. They are read and written here rather
// than by librosbag-storage, which reads beyond its buffers where a bag is broken.
namespace plotscan::record::ros {

struct Topic {
  std::string name;  // "/tf"
  std::string type;  // "tf2_msgs/TFMessage", as ROS 1 has it, in both kinds of file
  // Kept by its publisher for those who listen later, as /tf_static is.
  bool latched = false;
};

// A file being written: topics are given once, messages in the order of time.
class FileWriter {
 public:
  virtual ~FileWriter() = default;

  virtual Version version() const = 0;
  // `message` as encode() makes it, `topic` counts from 0 in the order given. Throws
  // std::runtime_error when the disk is full.
  virtual void write(std::size_t topic, Time time, std::string_view message) = 0;
  // Finishes the file; without it the file is not whole.
  virtual void close() = 0;
};

// ROS bag format 2.0 (wiki.ros.org/Bags/Format/2.0), chunks not compressed. Throws
// std::runtime_error when the file cannot be created, as below.
std::unique_ptr<FileWriter> create_bag(const std::filesystem::path& file,
                                       std::vector<Topic> topics);
// MCAP (mcap.dev/spec) of profile ros2, as rosbag2 writes it; chunks not compressed.
std::unique_ptr<FileWriter> create_mcap(const std::filesystem::path& file,
                                        std::vector<Topic> topics);

struct Message {
  const Topic& topic;
  Version version = Version::ros1;
  Time time;                    // when it was recorded
  std::span<const char> bytes;  // until the next message is read
};
using MessageSink = std::function<void(const Message&)>;

// Every message in the file's order. Chunks may be compressed by LZ4 or, in MCAP, by Zstandard.
// Throws InputError when the file is missing, foreign, truncated or broken, or compressed
// otherwise, and names the file in what the sink throws of this kind.
void read_messages(const std::filesystem::path& file, const MessageSink& sink);

// Private to file.cpp: read_messages of either kind.
void read_bag(const std::filesystem::path& file, const MessageSink& sink);
void read_mcap(const std::filesystem::path& file, const MessageSink& sink);

}  // namespace plotscan::record::ros
