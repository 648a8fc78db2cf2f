// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <map>

#include <zlib.h>

#include "record/ros/internal/binary_file.h"
#include "record/ros/internal/mcap_format.h"
#include "record/ros/internal/unpack.h"
#include "record/ros/message_file.h"

namespace plotscan::record::ros {
namespace {

constexpr std::uint64_t kLatest_ns = 4'294'967'296'000'000'000;  // 32 bits of seconds, as ROS has

// "sensor_msgs/Imu" of "sensor_msgs/msg/Imu".
std::string ros1_name(std::string type) {
  const auto at = type.find("/msg/");
  return at == std::string::npos ? type : type.replace(at, 5, "/");
}

struct Channel {
  Topic topic;
  std::string encoding;
};

class McapReader {
 public:
  McapReader(const std::filesystem::path& file, const MessageSink& sink) : in_(file), sink_(sink) {}

  void run() {
    require_magic();
    for (;;) {
      const auto op = in_.number<McapOp>();
      const auto content = in_.read(in_.number<std::uint64_t>());
      if (op == McapOp::footer) break;
      // The summary that follows only repeats earlier records.
      if (op == McapOp::data_end) in_summary_ = true;
      if (in_summary_) continue;
      if (op == McapOp::chunk)
        read_chunk(RecordReader(content));
      else
        read_record(op, RecordReader(content));
    }
    require_magic();
  }

 private:
  void require_magic() {
    const auto magic = in_.read(std::min<std::uint64_t>(in_.left(), kMcapMagic.size()));
    if (std::string_view(magic.data(), magic.size()) != kMcapMagic)
      throw InputError("is no MCAP file, or is truncated");
  }

  void read_chunk(RecordReader content) {
    content.read(2 * sizeof(std::uint64_t));  // first and last time
    const auto size = content.number<std::uint64_t>();
    const auto crc = content.number<std::uint32_t>();
    const std::string compression = content.text();
    const std::vector<char> records =
        unpacked(compression, content.read(content.number<std::uint64_t>()), size);
    if (crc != 0 && crc != mcap_crc({records.data(), records.size()}))
      throw InputError("is broken: the checksum of a chunk does not fit");
    for (RecordReader reader(records); !reader.empty();) {
      const auto op = reader.number<McapOp>();
      read_record(op, RecordReader(reader.read(reader.number<std::uint64_t>())));
    }
  }

  void read_record(McapOp op, RecordReader content) {
    if (op == McapOp::schema) {
      const auto id = content.number<std::uint16_t>();
      types_[id] = ros1_name(content.text());
    } else if (op == McapOp::channel) {
      const auto id = content.number<std::uint16_t>();
      Channel& channel = channels_[id];
      channel.topic.type = types_[content.number<std::uint16_t>()];
      channel.topic.name = content.text();
      channel.encoding = content.text();
    } else if (op == McapOp::message) {
      hand_on(content);
    }
  }

  // Messages that are neither of ROS 2 nor of ROS 1 are skipped.
  void hand_on(RecordReader content) const {
    const auto channel = channels_.find(content.number<std::uint16_t>());
    if (channel == channels_.end()) throw InputError("is broken: a message of an unknown channel");
    content.number<std::uint32_t>();  // sequence
    const auto logged_ns = content.number<std::uint64_t>();
    if (logged_ns >= kLatest_ns) throw InputError("is broken: a message of a time beyond 2106");
    const Time time{static_cast<std::int64_t>(logged_ns)};
    content.number<std::int64_t>();  // publish time
    const bool is_ros1 = channel->second.encoding == "ros1";
    if (!is_ros1 && channel->second.encoding != "cdr") return;
    sink_({.topic = channel->second.topic,
           .version = is_ros1 ? Version::ros1 : Version::ros2,
           .time = time,
           .bytes = content.read(content.left())});
  }

  BinaryInput in_;
  const MessageSink& sink_;
  bool in_summary_ = false;
  std::map<std::uint16_t, std::string> types_;  // by schema
  std::map<std::uint16_t, Channel> channels_;
};

}  // namespace

std::uint32_t mcap_crc(std::string_view bytes, std::uint32_t before) {
  return static_cast<std::uint32_t>(
      crc32_z(before, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

void read_mcap(const std::filesystem::path& file, const MessageSink& sink) {
  McapReader(file, sink).run();
}

}  // namespace plotscan::record::ros
