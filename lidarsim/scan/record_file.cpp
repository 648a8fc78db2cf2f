// SPDX-License-Identifier: Apache-2.0
#include "scan/record_file.h"

#include <cerrno>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

#include "core/error.h"

namespace plotscan::scan {
namespace {

constexpr std::size_t kBufferSize = std::size_t{1} << 18;

}  // namespace

RecordFile::RecordFile(const std::filesystem::path& path)
    : path_(path),
      file_(open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666)),
      buffer_(kBufferSize) {
  if (file_ < 0) fail();
}

RecordFile::~RecordFile() {
  if (file_ >= 0) ::close(file_);
}

void RecordFile::append(std::span<const char> bytes) {
  if (bytes.size() > buffer_.size()) {
    flush();
    return write_bytes(bytes);
  }
  std::memcpy(room(bytes.size()), bytes.data(), bytes.size());
  used(bytes.size());
}

char* RecordFile::room(std::size_t most) {
  if (buffered_ + most > buffer_.size()) flush();
  return buffer_.data() + buffered_;
}

void RecordFile::flush() {
  write_bytes(std::span(buffer_).first(buffered_));
  buffered_ = 0;
}

void RecordFile::close(std::span<const char> beginning) {
  flush();
  if (lseek(file_, 0, SEEK_SET) != 0) fail();
  write_bytes(beginning);
  const int file = std::exchange(file_, -1);
  if (::close(file) != 0) fail();
}

void RecordFile::write_bytes(std::span<const char> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail();
    bytes = bytes.subspan(static_cast<std::size_t>(written));
    written_ += static_cast<std::size_t>(written);
  }
}

void RecordFile::fail() const { throw WriteError(path_, errno); }

}  // namespace plotscan::scan
