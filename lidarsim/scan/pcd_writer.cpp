// SPDX-License-Identifier: Apache-2.0
#include "scan/pcd_writer.h"

#include <bit>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

#include "core/error.h"

namespace plotscan::scan {
namespace {

static_assert(std::endian::native == std::endian::little, "records are written little-endian");

constexpr std::size_t kHeaderSize = 512;
constexpr std::size_t kBufferSize = std::size_t{1} << 18;

// The header, padded by its comment line to kHeaderSize bytes whatever the number of points.
std::string pcd_header(std::uint64_t points) {
  const std::string count = std::to_string(points);
  const std::string entries =
      "VERSION 0.7\n"
      "FIELDS x y z intensity ring time return_number return_count class plot plant\n"
      "SIZE 4 4 4 4 2 8 1 1 1 4 4\n"
      "TYPE F F F F U F U U U U U\n"
      "COUNT 1 1 1 1 1 1 1 1 1 1 1\n"
      "WIDTH " +
      count + "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + count + "\nDATA binary\n";
  std::string comment = "# .PCD v0.7 - Point Cloud Data file format";
  check(comment.size() + 1 + entries.size() <= kHeaderSize, "PCD header fits its length");
  comment.append(kHeaderSize - comment.size() - 1 - entries.size(), ' ');
  return comment + '\n' + entries;
}

// Writes the point's record, without padding, at `record`; returns its end.
char* pack_point(const LabelledPoint& point, char* record) {
  const auto put = [&record](const auto& value) {
    std::memcpy(record, &value, sizeof value);
    record += sizeof value;
  };
  put(point.x);
  put(point.y);
  put(point.z);
  put(point.intensity);
  put(point.ring);
  put(point.time);
  put(point.return_number);
  put(point.return_count);
  put(point.label);
  put(point.plot);
  put(point.plant);
  return record;
}

}  // namespace

PcdWriter::PcdWriter(const std::filesystem::path& path)
    : path_(path),
      file_(open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666)),
      buffer_(kBufferSize) {
  if (file_ < 0) fail();
  write_bytes(pcd_header(0));
}

PcdWriter::~PcdWriter() {
  if (file_ >= 0) ::close(file_);
}

void PcdWriter::write(std::span<const LabelledPoint> points) {
  for (const LabelledPoint& point : points) {
    if (buffered_ + kPackedPointSize > buffer_.size()) flush();
    buffered_ =
        static_cast<std::size_t>(pack_point(point, buffer_.data() + buffered_) - buffer_.data());
  }
  points_ += points.size();
}

void PcdWriter::close() {
  flush();
  if (lseek(file_, 0, SEEK_SET) != 0) fail();
  write_bytes(pcd_header(points_));
  const int file = std::exchange(file_, -1);
  if (::close(file) != 0) fail();
}

void PcdWriter::flush() {
  write_bytes(std::span(buffer_).first(buffered_));
  buffered_ = 0;
}

void PcdWriter::write_bytes(std::span<const char> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail();
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
}

void PcdWriter::fail() const {
  throw std::runtime_error(path_.string() +
                           " cannot be written: " + std::generic_category().message(errno));
}

}  // namespace plotscan::scan
