// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "record/ros/codec.h"

// Files of ROS messages: ROS 1 bags and ROS 2 MCAP files. They are read and written here, not by
// librosbag-storage, which reads beyond its buffers when a bag is broken.
namespace plotscan::record::ros {

struct Topic {
  std::string name;  // "/tf"
  std::string type;  // "tf2_msgs/TFMessage", in the style of ROS 1, in both kinds of file
  // Whether the publisher keeps the last message for late subscribers, as for /tf_static.
  bool latched = false;
};

// Writes a file. Topics are given at its creation, messages in the order of time. All of this
// throws WriteError when the file cannot be written.
class FileWriter {
 public:
  virtual ~FileWriter() = default;

  virtual Version version() const = 0;
  // `message` is what encode() makes; `topic` is the topic's index in the order given, from 0.
  virtual void write(std::size_t topic, Time time, std::string_view message) = 0;
  // Finishes the file, which is incomplete without it.
  virtual void close() = 0;
};

// ROS bag format 2.0 (wiki.ros.org/Bags/Format/2.0), chunks not compressed.
std::unique_ptr<FileWriter> create_bag(const std::filesystem::path& file,
                                       std::vector<Topic> topics);
// MCAP (mcap.dev/spec) with profile ros2, as rosbag2 writes it; chunks not compressed.
std::unique_ptr<FileWriter> create_mcap(const std::filesystem::path& file,
                                        std::vector<Topic> topics);

struct Message {
  const Topic& topic;
  Version version = Version::ros1;
  Time time;                    // when it was recorded
  std::span<const char> bytes;  // valid until the next message is read
};
using MessageSink = std::function<void(const Message&)>;

// Passes every message to the sink, in the file's order. Chunks may be compressed with LZ4 or, in
// MCAP, with Zstandard. Throws InputError when the file is missing, foreign, truncated, broken or
// compressed otherwise. An InputError of the sink is thrown again with the file's name.
void read_messages(const std::filesystem::path& file, const MessageSink& sink);

}  // namespace plotscan::record::ros
