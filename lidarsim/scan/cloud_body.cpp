// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <bit>
#include <charconv>
#include <cstring>

#include <pcl/io/lzf.h>

#include "core/error.h"
#include "scan/cloud_layout.h"

namespace plotscan::scan {
namespace {

constexpr std::size_t kChunkPoints = 8192;
// LZF turns at most 264 bytes into 3 of a back reference.
constexpr std::uint64_t kMaxLzfRatio = 88;

// Collects finite positions and hands them on in chunks.
class Chunk {
 public:
  explicit Chunk(const PositionSink& sink) : sink_(sink) { positions_.reserve(kChunkPoints); }

  void add(const Eigen::Vector3d& position) {
    if (!position.allFinite()) {
      ++summary_.not_finite;
      return;
    }
    positions_.push_back(position);
    if (positions_.size() == kChunkPoints) flush();
  }
  CloudSummary finish() {
    if (!positions_.empty()) flush();
    return summary_;
  }

 private:
  void flush() {
    sink_(positions_);
    summary_.points += positions_.size();
    positions_.clear();
  }

  const PositionSink& sink_;
  std::vector<Eigen::Vector3d> positions_;
  CloudSummary summary_;
};

template <class Float, class Bits>
double decode(const char* bytes, bool swap) {
  Bits bits;
  std::memcpy(&bits, bytes, sizeof bits);
  if (swap) bits = sizeof bits == 4 ? __builtin_bswap32(bits) : __builtin_bswap64(bits);
  return std::bit_cast<Float>(bits);
}

double decode(const char* bytes, std::size_t element_size, bool swap) {
  return element_size == 4 ? decode<float, std::uint32_t>(bytes, swap)
                           : decode<double, std::uint64_t>(bytes, swap);
}

bool must_swap(const CloudLayout& layout) {
  return layout.big_endian != (std::endian::native == std::endian::big);
}

[[noreturn]] void fail_truncated(const std::filesystem::path& file, const CloudLayout& layout,
                                 std::uint64_t body_size) {
  throw InputError(file, "is truncated: the header promises " + std::to_string(layout.points) +
                             " points of " + std::to_string(layout.record_size) +
                             " bytes, the file holds " + std::to_string(body_size) + " bytes");
}

CloudSummary read_binary(const std::filesystem::path& file, std::ifstream& in,
                         const CloudLayout& layout, const PositionSink& sink) {
  const std::uint64_t body_size = std::filesystem::file_size(file) - layout.body_offset;
  if (layout.points > body_size / layout.record_size) fail_truncated(file, layout, body_size);
  const bool swap = must_swap(layout);
  const std::size_t records_a_read = std::max<std::size_t>(1, (1u << 20) / layout.record_size);
  std::vector<char> buffer(records_a_read * layout.record_size);
  Chunk chunk(sink);
  for (std::uint64_t done = 0; done < layout.points;) {
    const std::size_t records = std::min<std::uint64_t>(records_a_read, layout.points - done);
    in.read(buffer.data(), static_cast<std::streamsize>(records * layout.record_size));
    if (!in) throw InputError(file, "cannot be read to its end");
    for (std::size_t i = 0; i < records; ++i) {
      Eigen::Vector3d position;
      for (int axis = 0; axis < 3; ++axis) {
        const Coordinate& c = layout.xyz[axis];
        position[axis] =
            decode(buffer.data() + i * layout.record_size + c.offset, c.element_size, swap);
      }
      chunk.add(position);
    }
    done += records;
  }
  return chunk.finish();
}

// A binary_compressed body: two 32-bit sizes, then LZF over all x, all y, and so on.
std::vector<char> decompress(const std::filesystem::path& file, std::ifstream& in,
                             const CloudLayout& layout) {
  std::array<std::uint32_t, 2> sizes{};  // compressed, decompressed
  in.read(reinterpret_cast<char*>(sizes.data()), sizeof sizes);
  const std::uint64_t body_size = std::filesystem::file_size(file) - layout.body_offset;
  if (!in || sizes[0] > body_size - sizeof sizes) fail_truncated(file, layout, body_size);
  if (sizes[1] / layout.record_size != layout.points || sizes[1] % layout.record_size != 0 ||
      sizes[1] > sizes[0] * kMaxLzfRatio) {
    throw InputError(
        file, "the compressed body does not fit the header: " + std::to_string(layout.points) +
                  " points of " + std::to_string(layout.record_size) + " bytes are promised, " +
                  std::to_string(sizes[1]) + " bytes are there");
  }
  std::vector<char> compressed(sizes[0]);
  std::vector<char> body(sizes[1]);
  in.read(compressed.data(), static_cast<std::streamsize>(compressed.size()));
  if (!in || pcl::lzfDecompress(compressed.data(), sizes[0], body.data(), sizes[1]) != sizes[1])
    throw InputError(file, "the compressed body is broken");
  return body;
}

CloudSummary read_compressed(const std::filesystem::path& file, std::ifstream& in,
                             const CloudLayout& layout, const PositionSink& sink) {
  const std::vector<char> body = decompress(file, in, layout);
  Chunk chunk(sink);
  for (std::uint64_t i = 0; i < layout.points; ++i) {
    Eigen::Vector3d position;
    for (int axis = 0; axis < 3; ++axis) {
      const Coordinate& c = layout.xyz[axis];
      position[axis] = decode(body.data() + c.offset * layout.points + i * c.element_size,
                              c.element_size, must_swap(layout));
    }
    chunk.add(position);
  }
  return chunk.finish();
}

double parse_coordinate(const std::filesystem::path& file, std::size_t line_number,
                        std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size())
    throw InputError(file, line_number, "\"" + std::string(word) + "\" is not a number");
  return value;
}

void split_words(std::string_view line, std::vector<std::string_view>& words) {
  constexpr std::string_view kSpace = " \t\r";
  words.clear();
  for (auto begin = line.find_first_not_of(kSpace); begin != std::string_view::npos;) {
    const auto end = std::min(line.find_first_of(kSpace, begin), line.size());
    words.push_back(line.substr(begin, end - begin));
    begin = line.find_first_not_of(kSpace, end);
  }
}

CloudSummary read_ascii(const std::filesystem::path& file, std::ifstream& in,
                        const CloudLayout& layout, const PositionSink& sink) {
  std::size_t line_number = layout.body_line - 1;
  std::string line;
  std::vector<std::string_view> words;
  Chunk chunk(sink);
  for (std::uint64_t read = 0; read < layout.points;) {
    if (!std::getline(in, line)) {
      throw InputError(file, "is truncated: the header promises " + std::to_string(layout.points) +
                                 " points, the file holds " + std::to_string(read));
    }
    ++line_number;
    split_words(line, words);
    if (words.empty()) continue;
    if (words.size() != layout.columns) {
      throw InputError(file, line_number,
                       "has " + std::to_string(words.size()) + " values; the header names " +
                           std::to_string(layout.columns));
    }
    Eigen::Vector3d position;
    for (int axis = 0; axis < 3; ++axis)
      position[axis] = parse_coordinate(file, line_number, words[layout.xyz[axis].column]);
    chunk.add(position);
    ++read;
  }
  return chunk.finish();
}

}  // namespace

CloudSummary read_body(const std::filesystem::path& file, const CloudLayout& layout,
                       const PositionSink& sink) {
  std::ifstream in(file, std::ios::binary);
  in.seekg(static_cast<std::streamoff>(layout.body_offset));
  switch (layout.body) {
    case CloudBody::ascii:
      return read_ascii(file, in, layout, sink);
    case CloudBody::binary:
      return read_binary(file, in, layout, sink);
    case CloudBody::compressed:
      return read_compressed(file, in, layout, sink);
  }
  throw std::logic_error("unknown kind of cloud body");
}

}  // namespace plotscan::scan
