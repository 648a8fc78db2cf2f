// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

namespace plotscan::scan {

// A file that is written from start to end through a buffer. At the end its beginning may be
// overwritten, where the number of records is known only then.
class RecordFile {
 public:
  // Throws WriteError, here and below, when the file cannot be created or written.
  explicit RecordFile(const std::filesystem::path& path);
  ~RecordFile();
  RecordFile(const RecordFile&) = delete;
  RecordFile& operator=(const RecordFile&) = delete;

  void append(std::span<const char> bytes);
  // Returns room for a record of up to `most` bytes; call `used` with the number of bytes written
  // there.
  char* room(std::size_t most);
  void used(std::size_t bytes) { buffered_ += bytes; }
  // How many bytes were appended.
  std::uint64_t size() const { return written_ + buffered_; }
  // Writes what is buffered.
  void flush();
  // Writes the bytes, if any, over the file's beginning and closes it.
  void close(std::span<const char> beginning = {});

 private:
  void write_bytes(std::span<const char> bytes);
  [[noreturn]] void fail() const;

  std::filesystem::path path_;
  int file_ = -1;
  std::vector<char> buffer_;
  std::size_t buffered_ = 0;   // bytes of buffer_ not written yet
  std::uint64_t written_ = 0;  // bytes
};

}  // namespace plotscan::scan
