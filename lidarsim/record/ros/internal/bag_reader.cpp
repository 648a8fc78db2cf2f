// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <map>

#include "record/ros/internal/bag_format.h"
#include "record/ros/internal/binary_file.h"
#include "record/ros/internal/unpack.h"
#include "record/ros/message_file.h"

namespace plotscan::record::ros {
namespace {

// The "name=value" fields of a record's header.
class HeaderFields {
 public:
  explicit HeaderFields(std::span<const char> bytes) {
    for (RecordReader reader(bytes); !reader.empty();) {
      const std::string field = reader.text();
      const auto equals = field.find('=');
      if (equals == std::string::npos) throw InputError("is broken: a header field has no value");
      values_[field.substr(0, equals)] = field.substr(equals + 1);
    }
  }

  std::string text(const std::string& name) const {
    const auto found = values_.find(name);
    if (found == values_.end())
      throw InputError("is broken: a record's header has no field \"" + name + "\"");
    return found->second;
  }
  std::string text_or(const std::string& name, const std::string& otherwise) const {
    return values_.contains(name) ? values_.at(name) : otherwise;
  }
  template <class Number>
  Number number(const std::string& name) const {
    const std::string bytes = text(name);
    if (bytes.size() != sizeof(Number))
      throw InputError("is broken: the header field \"" + name + "\" has a wrong size");
    return RecordReader(bytes).number<Number>();
  }

 private:
  std::map<std::string, std::string> values_;
};

class BagReader {
 public:
  BagReader(const std::filesystem::path& file, const MessageSink& sink) : in_(file), sink_(sink) {}

  void run() {
    const auto magic = in_.read(std::min<std::uint64_t>(in_.left(), kBagMagic.size()));
    if (std::string_view(magic.data(), magic.size()) != kBagMagic)
      throw InputError("is no ROS bag of format 2.0");
    while (in_.left() > 0) {
      const HeaderFields header(in_.read(in_.number<std::uint32_t>()));
      const auto size = in_.number<std::uint32_t>();
      const auto data = in_.read(size);
      const auto op = header.number<BagOp>("op");
      if (op == BagOp::file_header)
        require_finished(header);
      else if (op == BagOp::chunk)
        read_chunk(
            unpacked(header.text("compression"), data, header.number<std::uint32_t>("size")));
      else if (op != BagOp::connection && op != BagOp::index && op != BagOp::chunk_info)
        throw InputError("is broken: unknown record " + std::to_string(static_cast<int>(op)));
    }
  }

 private:
  void require_finished(const HeaderFields& header) const {
    if (!header.text_or("encryptor", "").empty())
      throw InputError("is encrypted; `rosbag decrypt` makes a bag that can be read");
    const auto index_at = header.number<std::uint64_t>("index_pos");
    if (index_at == 0) throw InputError("was not closed; `rosbag reindex` mends it");
  }

  void read_chunk(const std::vector<char>& chunk) {
    for (RecordReader reader(chunk); !reader.empty();) {
      const HeaderFields header(reader.read(reader.number<std::uint32_t>()));
      const auto data = reader.read(reader.number<std::uint32_t>());
      const auto op = header.number<BagOp>("op");
      if (op == BagOp::connection)
        add_topic(header, HeaderFields(data));
      else if (op == BagOp::message)
        hand_on(header, data);
      else
        throw InputError("is broken: a chunk holds record " + std::to_string(static_cast<int>(op)));
    }
  }

  void add_topic(const HeaderFields& header, const HeaderFields& data) {
    topics_.insert_or_assign(header.number<std::uint32_t>("conn"),
                             Topic{.name = header.text("topic"),
                                   .type = data.text("type"),
                                   .latched = data.text_or("latching", "0") == "1"});
  }

  void hand_on(const HeaderFields& header, std::span<const char> data) const {
    const auto topic = topics_.find(header.number<std::uint32_t>("conn"));
    if (topic == topics_.end()) throw InputError("is broken: a message of an unknown connection");
    const auto time = header.text("time");
    sink_({.topic = topic->second,
           .version = Version::ros1,
           .time = decode<Time>(Version::ros1, time),
           .bytes = data});
  }

  BinaryInput in_;
  const MessageSink& sink_;
  std::map<std::uint32_t, Topic> topics_;
};

}  // namespace

void read_bag(const std::filesystem::path& file, const MessageSink& sink) {
  BagReader(file, sink).run();
}

}  // namespace plotscan::record::ros
