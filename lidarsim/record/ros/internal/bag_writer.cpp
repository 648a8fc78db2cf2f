// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <map>

#include "record/ros/internal/bag_format.h"
#include "record/ros/internal/binary_file.h"
#include "record/ros/internal/message_definitions.h"
#include "record/ros/message_file.h"
#include "scan/record_file.h"

namespace plotscan::record::ros {
namespace {

// The same size as rosbag uses.
constexpr std::size_t kFileHeaderSize = 4096;
constexpr std::uint32_t kIndexVersion = 1;

// The "name=value" fields of a record's header.
class Fields {
 public:
  explicit Fields(BagOp op) { add("op", op); }
  Fields() = default;

  template <class Value>
  Fields& add(std::string_view name, Value value) {
    return add_text(name, bytes_of(value));
  }
  Fields& add_text(std::string_view name, std::string_view value) {
    bytes_ += bytes_of(std::string(name).append("=").append(value));
    return *this;
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

void append_record(std::string& bytes, const Fields& header, std::string_view data) {
  bytes += bytes_of(header.bytes(), data);
}

void append_connection(std::string& bytes, std::uint32_t id, const Topic& topic) {
  Fields data;
  data.add_text("topic", topic.name)
      .add_text("type", topic.type)
      .add_text("md5sum", md5_sum(topic.type))
      .add_text("message_definition", message_definition(topic.type, Version::ros1));
  if (topic.latched) data.add_text("callerid", "/plotscan").add_text("latching", "1");
  append_record(bytes, Fields(BagOp::connection).add("conn", id).add_text("topic", topic.name),
                data.bytes());
}

// Where and when the messages of a topic lie in a chunk.
struct TopicIndex {
  std::uint32_t count = 0;
  std::string entries;
};

struct ChunkInfo {
  std::uint64_t offset = 0;
  Time first;
  Time last;
  std::map<std::uint32_t, std::uint32_t> counts;  // messages by topic
};

class BagWriter : public FileWriter {
 public:
  BagWriter(const std::filesystem::path& file, std::vector<Topic> topics)
      : out_(file), topics_(std::move(topics)), seen_(topics_.size()) {
    out_.append(beginning(0));
  }

  Version version() const override { return Version::ros1; }

  void write(std::size_t topic, Time time, std::string_view message) override {
    const auto id = static_cast<std::uint32_t>(topic);
    if (chunk_.empty()) info_ = {.offset = out_.size(), .first = time, .last = time, .counts{}};
    if (!seen_[topic]) append_connection(chunk_, id, topics_[topic]);
    seen_[topic] = true;
    TopicIndex& index = index_[id];
    ++index.count;
    index.entries += bytes_of(time, static_cast<std::uint32_t>(chunk_.size()));
    info_.last = time;
    append_record(chunk_, Fields(BagOp::message).add("conn", id).add("time", time), message);
    if (chunk_.size() > kChunkSize) end_chunk();
  }

  void close() override {
    end_chunk();
    const std::uint64_t index_at = out_.size();
    std::string tail;
    for (std::size_t topic = 0; topic < topics_.size(); ++topic)
      if (seen_[topic]) append_connection(tail, static_cast<std::uint32_t>(topic), topics_[topic]);
    for (const ChunkInfo& chunk : chunks_) append_chunk_info(tail, chunk);
    out_.append(tail);
    out_.close(beginning(index_at));
  }

 private:
  std::string beginning(std::uint64_t index_at) const {
    const auto topics = static_cast<std::uint32_t>(std::ranges::count(seen_, true));
    const Fields header = Fields(BagOp::file_header)
                              .add("index_pos", index_at)
                              .add("conn_count", topics)
                              .add("chunk_count", static_cast<std::uint32_t>(chunks_.size()));
    std::string bytes(kBagMagic);
    const std::size_t lengths = 2 * sizeof(std::uint32_t);
    append_record(bytes, header,
                  std::string(kFileHeaderSize - header.bytes().size() - lengths, ' '));
    return bytes;
  }

  void end_chunk() {
    if (chunk_.empty()) return;
    std::string bytes;
    append_record(bytes,
                  Fields(BagOp::chunk)
                      .add_text("compression", "none")
                      .add("size", static_cast<std::uint32_t>(chunk_.size())),
                  chunk_);
    for (const auto& [id, index] : index_) {
      append_record(
          bytes,
          Fields(BagOp::index).add("ver", kIndexVersion).add("conn", id).add("count", index.count),
          index.entries);
      info_.counts[id] = index.count;
    }
    out_.append(bytes);
    chunks_.push_back(std::move(info_));
    chunk_.clear();
    index_.clear();
  }

  static void append_chunk_info(std::string& bytes, const ChunkInfo& chunk) {
    std::string counts;
    for (const auto& [id, count] : chunk.counts) counts += bytes_of(id, count);
    append_record(bytes,
                  Fields(BagOp::chunk_info)
                      .add("ver", kIndexVersion)
                      .add("chunk_pos", chunk.offset)
                      .add("start_time", chunk.first)
                      .add("end_time", chunk.last)
                      .add("count", static_cast<std::uint32_t>(chunk.counts.size())),
                  counts);
  }

  scan::RecordFile out_;
  std::vector<Topic> topics_;
  std::vector<bool> seen_;
  std::string chunk_;
  ChunkInfo info_;
  std::map<std::uint32_t, TopicIndex> index_;  // of the chunk, by topic
  std::vector<ChunkInfo> chunks_;
};

}  // namespace

std::unique_ptr<FileWriter> create_bag(const std::filesystem::path& file,
                                       std::vector<Topic> topics) {
  return std::make_unique<BagWriter>(file, std::move(topics));
}

}  // namespace plotscan::record::ros
