// SPDX-License-Identifier: Apache-2.0
#include "scan/cloud_writer.h"

#include <algorithm>
#include <array>
#include <limits>

#include <lzf.h>

#include "core/error.h"

namespace plotscan::scan {
namespace {

using Fields = std::vector<PointRecord::Field>;

// Pads `comment` with blanks, so that the header's length does not depend on the number of points.
std::string padded(const std::string& before, std::string comment, const std::string& after) {
  constexpr std::size_t kHeaderSize = 512;
  const std::size_t size = before.size() + comment.size() + 1 + after.size();
  check(size <= kHeaderSize, "a cloud's header fits its length");
  comment.append(kHeaderSize - size, ' ');
  return before + comment + '\n' + after;
}

std::string pcd_header(std::uint64_t points, const Fields& fields, const std::string& data) {
  std::string names = "FIELDS";
  std::string sizes = "SIZE";
  std::string types = "TYPE";
  std::string counts = "COUNT";
  for (const auto& [name, kind, size] : fields) {
    names += ' ' + name;
    sizes += ' ' + std::to_string(size);
    types += {' ', kind};
    counts += " 1";
  }
  const std::string count = std::to_string(points);
  return padded("", "# .PCD v0.7 - Point Cloud Data file format",
                "VERSION 0.7\n" + names + '\n' + sizes + '\n' + types + '\n' + counts + "\nWIDTH " +
                    count + "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + count + "\nDATA " +
                    data + '\n');
}

std::string ply_type(char kind, std::size_t size) {
  if (kind == 'F') return size == 8 ? "double" : "float";
  return size == 1 ? "uchar" : size == 2 ? "ushort" : "uint";
}

std::string ply_header(std::uint64_t points, const Fields& fields, bool ascii) {
  std::string properties;
  for (const auto& [name, kind, size] : fields)
    properties += "property " + ply_type(kind, size) + ' ' + name + '\n';
  return padded(std::string("ply\nformat ") + (ascii ? "ascii" : "binary_little_endian") + " 1.0\n",
                "comment Plotscan",
                "element vertex " + std::to_string(points) + '\n' + properties + "end_header\n");
}

// The records reordered: all values of the first field, then of the next, and so on.
std::vector<char> columns_of(const std::vector<char>& records, const Fields& fields,
                             std::size_t record_size) {
  std::vector<char> columns;
  columns.reserve(records.size());
  std::size_t offset = 0;
  for (const PointRecord::Field& field : fields) {
    for (std::size_t at = offset; at < records.size(); at += record_size) {
      const auto begin = records.begin() + static_cast<std::ptrdiff_t>(at);
      columns.insert(columns.end(), begin, begin + static_cast<std::ptrdiff_t>(field.size));
    }
    offset += field.size;
  }
  return columns;
}

}  // namespace

CloudWriter::CloudWriter(const std::filesystem::path& path, const CloudWriteOptions& options,
                         Header header)
    : file_(path),
      record_(options.origin_m, options.labels),
      ascii_(options.ascii),
      header_(header) {
  file_.append(header_(0, record_.fields(), ascii_));
  file_.flush();
}

void CloudWriter::write(std::span<const LabelledPoint> points) {
  for (const LabelledPoint& point : points) {
    if (ascii_) {
      text_.clear();
      record_.print(point, text_);
      file_.append(text_);
    } else {
      record_.pack(point, file_.room(record_.size()));
      file_.used(record_.size());
    }
  }
  points_ += points.size();
}

void CloudWriter::close() { file_.close(header_(points_, record_.fields(), ascii_)); }

PcdWriter::PcdWriter(const std::filesystem::path& path, const CloudWriteOptions& options)
    : CloudWriter(path, options, [](std::uint64_t points, const Fields& fields, bool ascii) {
        return pcd_header(points, fields, ascii ? "ascii" : "binary");
      }) {}

PlyWriter::PlyWriter(const std::filesystem::path& path, const CloudWriteOptions& options)
    : CloudWriter(path, options, ply_header) {}

CompressedPcdWriter::CompressedPcdWriter(const std::filesystem::path& path,
                                         const Eigen::Vector3d& origin_m, bool labels)
    : path_(path), file_(path), record_(origin_m, labels) {}

void CompressedPcdWriter::write(std::span<const LabelledPoint> points) {
  const std::size_t before = records_.size();
  const std::size_t after = before + points.size() * record_.size();
  if (after > std::numeric_limits<std::uint32_t>::max()) {
    throw InputError(path_, "a compressed PCD holds at most 4 GiB, {} points; write binary PCD",
                     (std::size_t{1} << 32) / record_.size());
  }
  records_.resize(after);
  char* record = records_.data() + before;
  for (const LabelledPoint& point : points) record = record_.pack(point, record);
}

void CompressedPcdWriter::close() {
  const std::vector<char> columns = columns_of(records_, record_.fields(), record_.size());
  const std::size_t points = records_.size() / record_.size();
  records_ = {};
  // LZF makes data that it cannot compress longer, by one byte in 32.
  std::vector<char> compressed(std::min<std::size_t>(columns.size() + columns.size() / 16 + 64,
                                                     std::numeric_limits<std::uint32_t>::max()));
  const unsigned int size =
      lzf_compress(columns.data(), static_cast<unsigned int>(columns.size()), compressed.data(),
                   static_cast<unsigned int>(compressed.size()));
  if (size == 0 && points > 0)
    throw InputError(path_, "the cloud cannot be compressed; write binary PCD");
  const std::array<std::uint32_t, 2> sizes = {size, static_cast<std::uint32_t>(columns.size())};
  const std::string header = pcd_header(points, record_.fields(), "binary_compressed");
  file_.append(header);
  file_.append({reinterpret_cast<const char*>(sizes.data()), sizeof sizes});
  file_.append(std::span(compressed).first(size));
  file_.close(header);
}

}  // namespace plotscan::scan
