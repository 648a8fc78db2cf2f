// SPDX-License-Identifier: Apache-2.0
#include <map>
#include <optional>

#include <fmt/core.h>

#include "record/ros/internal/binary_file.h"
#include "record/ros/internal/mcap_format.h"
#include "record/ros/internal/message_definitions.h"
#include "record/ros/message_file.h"
#include "scan/record_file.h"

namespace plotscan::record::ros {
namespace {

constexpr std::string_view kNotCompressed;  // an empty name

void append_record(std::string& bytes, McapOp op, std::string_view content) {
  bytes += bytes_of(op, static_cast<std::uint64_t>(content.size()));
  bytes += content;
}

// Quality of service as rosbag2 writes it up to version 8 of its metadata: keep the last 10,
// reliable, volatile (transient local if latched), no deadlines. Newer rosbag2 also reads these
// numbers so if there is a metadata record "rosbag2" that states no version.
std::string qos_profiles(bool latched) {
  const std::string forever = "    sec: 9223372036\n    nsec: 854775807\n";
  return fmt::format("- history: 1\n  depth: 10\n  reliability: 1\n  durability: {}\n",
                     latched ? 1 : 2) +
         "  deadline:\n" + forever + "  lifespan:\n" + forever + "  liveliness: 1\n" +
         "  liveliness_lease_duration:\n" + forever + "  avoid_ros_namespace_conventions: false";
}

struct ChunkIndex {
  std::int64_t first_ns = 0;
  std::int64_t last_ns = 0;
  std::uint64_t offset = 0;
  std::uint64_t length = 0;
  std::map<std::uint16_t, std::uint64_t> index_offsets;  // by channel
  std::uint64_t index_length = 0;
  std::uint64_t size = 0;  // of its records
};

std::string content_of(const ChunkIndex& chunk) {
  std::string offsets;
  for (const auto& [channel, offset] : chunk.index_offsets) offsets += bytes_of(channel, offset);
  return bytes_of(chunk.first_ns, chunk.last_ns, chunk.offset, chunk.length, offsets,
                  chunk.index_length, kNotCompressed, chunk.size, chunk.size);
}

class McapWriter : public FileWriter {
 public:
  McapWriter(const std::filesystem::path& file, std::vector<Topic> topics)
      : out_(file), topics_(std::move(topics)), counts_(topics_.size()) {
    for (const Topic& topic : topics_) schemas_.try_emplace(topic.type, 0);
    std::uint16_t next = 0;
    for (auto& [type, id] : schemas_) id = ++next;
    std::string bytes(kMcapMagic);
    append_record(bytes, McapOp::header, bytes_of("ros2", "plotscan"));
    metadata_at_ = bytes.size();
    append_record(bytes, McapOp::metadata, bytes_of("rosbag2", ""));  // an empty map
    metadata_length_ = bytes.size() - metadata_at_;
    bytes += schema_records() + channel_records();
    write_data(bytes);
  }

  Version version() const override { return Version::ros2; }

  void write(std::size_t topic, Time time, std::string_view message) override {
    const auto channel = static_cast<std::uint16_t>(topic + 1);
    if (chunk_.empty()) chunk_first_ = time;
    if (!first_) first_ = time;
    last_ = time;
    index_[channel] += bytes_of(time.ns, static_cast<std::uint64_t>(chunk_.size()));
    const auto sequence = static_cast<std::uint32_t>(counts_[topic]++);
    append_record(chunk_, McapOp::message,
                  bytes_of(channel, sequence, time.ns, time.ns).append(message));
    if (chunk_.size() > kChunkSize) end_chunk();
  }

  void close() override {
    end_chunk();
    std::string bytes;
    append_record(bytes, McapOp::data_end, bytes_of(data_crc_));
    out_.append(bytes);
    write_summary();
    out_.close();
  }

 private:
  // Topics of the same type share a schema.
  std::string schema_records() const {
    std::string records;
    for (const auto& [type, id] : schemas_) {
      append_record(
          records, McapOp::schema,
          bytes_of(id, ros2_name(type), "ros2msg", message_definition(type, Version::ros2)));
    }
    return records;
  }

  std::string channel_records() const {
    std::string records;
    for (std::size_t topic = 0; topic < topics_.size(); ++topic) {
      const std::string metadata =
          bytes_of("offered_qos_profiles", qos_profiles(topics_[topic].latched));
      append_record(
          records, McapOp::channel,
          bytes_of(static_cast<std::uint16_t>(topic + 1), schemas_.at(topics_[topic].type),
                   topics_[topic].name, "cdr", metadata));
    }
    return records;
  }

  void end_chunk() {
    if (chunk_.empty()) return;
    ChunkIndex chunk{.first_ns = chunk_first_.ns,
                     .last_ns = last_.ns,
                     .offset = out_.size(),
                     .index_offsets = {},
                     .size = chunk_.size()};
    std::string bytes;
    append_record(bytes, McapOp::chunk,
                  bytes_of(chunk.first_ns, chunk.last_ns, chunk.size, mcap_crc(chunk_),
                           kNotCompressed, chunk.size)
                      .append(chunk_));
    chunk.length = bytes.size();
    for (const auto& [channel, entries] : index_) {
      chunk.index_offsets[channel] = chunk.offset + bytes.size();
      append_record(bytes, McapOp::message_index, bytes_of(channel, entries));
    }
    chunk.index_length = bytes.size() - chunk.length;
    write_data(bytes);
    chunks_.push_back(std::move(chunk));
    chunk_.clear();
    index_.clear();
  }

  // The summary: schemas, channels, chunk indexes, statistics, where each group lies, the footer.
  void write_summary() {
    const std::uint64_t begin = out_.size();
    std::string bytes;
    std::string offsets;
    const auto group = [&](McapOp op, const std::string& records) {
      append_record(offsets, McapOp::summary_offset,
                    bytes_of(op, begin + bytes.size(), static_cast<std::uint64_t>(records.size())));
      bytes += records;
    };
    group(McapOp::schema, schema_records());
    group(McapOp::channel, channel_records());
    group(McapOp::statistics, statistics_record());
    group(McapOp::metadata_index, metadata_index_record());
    std::string chunk_records;
    for (const ChunkIndex& chunk : chunks_)
      append_record(chunk_records, McapOp::chunk_index, content_of(chunk));
    if (!chunks_.empty()) group(McapOp::chunk_index, chunk_records);
    const std::uint64_t offsets_begin = begin + bytes.size();
    bytes += offsets;
    bytes += bytes_of(McapOp::footer, kMcapFooterSize, begin, offsets_begin);
    bytes += bytes_of(mcap_crc(bytes));
    out_.append(bytes + std::string(kMcapMagic));
  }

  std::string statistics_record() const {
    std::uint64_t messages = 0;
    std::string counts;
    for (std::size_t topic = 0; topic < topics_.size(); ++topic) {
      messages += counts_[topic];
      counts += bytes_of(static_cast<std::uint16_t>(topic + 1), counts_[topic]);
    }
    constexpr std::uint32_t kAttachments = 0;
    constexpr std::uint32_t kMetadata = 1;
    std::string record;
    append_record(record, McapOp::statistics,
                  bytes_of(messages, static_cast<std::uint16_t>(schemas_.size()),
                           static_cast<std::uint32_t>(topics_.size()), kAttachments, kMetadata,
                           static_cast<std::uint32_t>(chunks_.size()), first_.value_or(Time{}).ns,
                           last_.ns, counts));
    return record;
  }

  std::string metadata_index_record() const {
    std::string record;
    append_record(record, McapOp::metadata_index,
                  bytes_of(metadata_at_, metadata_length_, "rosbag2"));
    return record;
  }

  void write_data(const std::string& bytes) {
    data_crc_ = mcap_crc(bytes, data_crc_);
    out_.append(bytes);
  }

  scan::RecordFile out_;
  std::vector<Topic> topics_;
  std::map<std::string, std::uint16_t> schemas_;  // id by type
  std::vector<std::uint64_t> counts_;             // messages by topic
  std::uint64_t metadata_at_ = 0;
  std::uint64_t metadata_length_ = 0;
  std::uint32_t data_crc_ = 0;
  std::optional<Time> first_;
  Time last_;
  std::string chunk_;
  Time chunk_first_;
  std::map<std::uint16_t, std::string> index_;  // of the chunk, by channel
  std::vector<ChunkIndex> chunks_;
};

}  // namespace

std::unique_ptr<FileWriter> create_mcap(const std::filesystem::path& file,
                                        std::vector<Topic> topics) {
  return std::make_unique<McapWriter>(file, std::move(topics));
}

}  // namespace plotscan::record::ros
