// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <vector>

#include "core/error.h"
#include "record/ros/codec.h"

namespace plotscan::record {

// The size at which a chunk of messages is written, bytes.
inline constexpr std::size_t kChunkSize = std::size_t{768} << 10;

// Numbers in little endian and texts behind their lengths in 32 bits, as in messages of ROS 1.
template <class... Values>
std::string bytes_of(const Values&... values) {
  return ros::encode(ros::Version::ros1, values...);
}

// Bytes read from their beginning to their end. Throws InputError where they end too early.
class RecordReader {
 public:
  explicit RecordReader(std::span<const char> bytes) : bytes_(bytes) {}

  bool empty() const { return bytes_.empty(); }
  std::size_t left() const { return bytes_.size(); }
  std::span<const char> read(std::uint64_t size) {
    if (size > bytes_.size()) {
      throw InputError("is broken: a record of " + std::to_string(size) + " bytes where " +
                       std::to_string(bytes_.size()) + " are left");
    }
    const auto head = bytes_.first(size);
    bytes_ = bytes_.subspan(size);
    return head;
  }
  template <class Number>
  Number number() {
    Number value;
    std::memcpy(&value, read(sizeof value).data(), sizeof value);
    return value;
  }
  // Reads a text that is preceded by its length in 32 bits.
  std::string text() {
    const auto bytes = read(number<std::uint32_t>());
    return {bytes.begin(), bytes.end()};
  }

 private:
  std::span<const char> bytes_;
};

// A file read from its beginning to its end. Throws InputError where it ends too early.
class BinaryInput {
 public:
  explicit BinaryInput(const std::filesystem::path& path) : path_(path) {
    require_file(path);
    in_.open(path, std::ios::binary);
    left_ = std::filesystem::file_size(path);
  }

  std::uint64_t left() const { return left_; }
  // The next bytes; valid until the next call.
  std::span<const char> read(std::uint64_t size) {
    if (size > left_) {
      fail("is truncated or broken: " + std::to_string(size) + " bytes are promised, " +
           std::to_string(left_) + " are left");
    }
    buffer_.resize(size);
    in_.read(buffer_.data(), static_cast<std::streamsize>(size));
    if (!in_) fail("cannot be read to its end");
    left_ -= size;
    return buffer_;
  }
  template <class Number>
  Number number() {
    return RecordReader(read(sizeof(Number))).number<Number>();
  }
  [[noreturn]] void fail(const std::string& what) const { throw InputError(path_, what); }

 private:
  std::filesystem::path path_;
  std::ifstream in_;
  std::uint64_t left_ = 0;
  std::vector<char> buffer_;
};

}  // namespace plotscan::record
