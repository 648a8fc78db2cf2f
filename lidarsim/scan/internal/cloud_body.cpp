// SPDX-License-Identifier: Apache-2.0
#include "scan/internal/cloud_body.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include <Eigen/Core>
#include <lzf.h>

#include "core/error.h"
#include "scan/internal/cloud_layout.h"

namespace plotscan::scan {
namespace {

// LZF encodes at most 264 bytes in a back reference of 3.
constexpr std::uint64_t kMaxLzfRatio = 88;

// Detects floats in the wrong byte order: their exponents are random, so some 40 % of them are no
// plausible lengths. Throws InputError if more than a tenth of the coordinates is not plausible.
// `value` returns the value of a field in a record.
template <class Value>
void require_lengths(const std::filesystem::path& file, const Wanted& wanted, std::uint64_t records,
                     Value&& value) {
  constexpr double kLeast_m = 1e-30;
  constexpr double kMost_m = 1e12;
  std::uint64_t coordinates = 0;
  std::uint64_t garbled = 0;
  for (const ScalarField& field : wanted.fields) {
    const bool is_coordinate = field.name == "x" || field.name == "y" || field.name == "z";
    if (!is_coordinate || field.kind != 'F') continue;
    for (std::uint64_t i = 0; i < records; ++i) {
      const double length_m = std::abs(value(field, i));
      ++coordinates;
      if (length_m > kMost_m || (length_m > 0 && length_m < kLeast_m)) ++garbled;
    }
  }
  // A handful of points proves nothing.
  constexpr std::uint64_t kFewest = 300;
  if (coordinates < kFewest || 10 * garbled <= coordinates) return;
  throw InputError(file,
                   "{} % of its coordinates are no lengths: below 1e-30 m or beyond 1e12 m; is "
                   "their byte order another than the header says?",
                   100 * garbled / coordinates);
}

bool must_swap(const CloudLayout& layout) {
  return layout.big_endian != (std::endian::native == std::endian::big);
}

[[noreturn]] void fail_truncated(const std::filesystem::path& file, const CloudLayout& layout,
                                 std::uint64_t body_size) {
  throw InputError(
      file, "is truncated: the header promises {} points of {} bytes, the file holds {} bytes",
      layout.points, layout.record_size, body_size);
}

void read_binary(const std::filesystem::path& file, std::ifstream& in, const CloudLayout& layout,
                 const Wanted& wanted) {
  const std::uint64_t body_size = std::filesystem::file_size(file) - layout.body_offset;
  if (layout.points > body_size / layout.record_size) fail_truncated(file, layout, body_size);
  const bool swap = must_swap(layout);
  const std::size_t records_a_read = std::max<std::size_t>(1, (1u << 20) / layout.record_size);
  std::vector<char> buffer(records_a_read * layout.record_size);
  Rows rows(wanted);
  for (std::uint64_t done = 0; done < wanted.points;) {
    const std::size_t records = std::min<std::uint64_t>(records_a_read, wanted.points - done);
    in.read(buffer.data(), static_cast<std::streamsize>(records * layout.record_size));
    if (!in) throw InputError(file, "cannot be read to its end");
    if (done == 0) {
      require_lengths(file, wanted, records, [&](const ScalarField& field, std::uint64_t i) {
        return decode(field, buffer.data() + i * layout.record_size + field.offset, swap);
      });
    }
    for (std::size_t i = 0; i < records; ++i) {
      const char* record = buffer.data() + i * layout.record_size;
      for (const ScalarField& field : wanted.fields)
        rows.add(decode(field, record + field.offset, swap));
      rows.end_row();
    }
    done += records;
  }
  rows.flush();
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
    throw InputError(file,
                     "the compressed body does not fit the header: {} points of {} bytes are "
                     "promised, {} bytes are there",
                     layout.points, layout.record_size, sizes[1]);
  }
  std::vector<char> compressed(sizes[0]);
  std::vector<char> body(sizes[1]);
  in.read(compressed.data(), static_cast<std::streamsize>(compressed.size()));
  if (body.empty()) return body;
  if (!in || lzf_decompress(compressed.data(), sizes[0], body.data(), sizes[1]) != sizes[1])
    throw InputError(file, "the compressed body is broken");
  return body;
}

void read_compressed(const std::filesystem::path& file, std::ifstream& in,
                     const CloudLayout& layout, const Wanted& wanted) {
  const std::vector<char> body = decompress(file, in, layout);
  const bool swap = must_swap(layout);
  const auto value = [&](const ScalarField& field, std::uint64_t i) {
    return decode(field, body.data() + field.offset * layout.points + i * field.size, swap);
  };
  require_lengths(file, wanted, wanted.points, value);
  Rows rows(wanted);
  for (std::uint64_t i = 0; i < wanted.points; ++i) {
    for (const ScalarField& field : wanted.fields) rows.add(value(field, i));
    rows.end_row();
  }
  rows.flush();
}

}  // namespace

void read_rows(const std::filesystem::path& file, const CloudLayout& layout,
               std::span<const ScalarField> fields, const RowSink& sink, std::uint64_t limit) {
  std::ifstream in(file, std::ios::binary);
  in.seekg(static_cast<std::streamoff>(layout.body_offset));
  const Wanted wanted{std::min(layout.points, limit), fields, sink};
  switch (layout.body) {
    case CloudBody::ascii:
      return read_ascii(file, in, layout, wanted);
    case CloudBody::binary:
      return read_binary(file, in, layout, wanted);
    case CloudBody::compressed:
      return read_compressed(file, in, layout, wanted);
    case CloudBody::laz:
#ifdef PLOTSCAN_HAVE_LASZIP
      return read_laz(file, layout, wanted);
#else
      break;
#endif
  }
  throw std::logic_error("unknown kind of cloud body");
}

std::optional<std::vector<double>> first_finite(const std::filesystem::path& file,
                                                const CloudLayout& layout,
                                                std::span<const ScalarField> fields) {
  constexpr std::uint64_t kSearched = 8192;
  std::optional<std::vector<double>> first;
  const auto search = [&](std::span<const double> rows) {
    for (std::size_t i = 0; i < rows.size() && !first; i += fields.size()) {
      const auto row = rows.subspan(i, fields.size());
      if (Eigen::Vector3d(row[0], row[1], row[2]).allFinite())
        first.emplace(row.begin(), row.end());
    }
  };
  read_rows(file, layout, fields, search, kSearched);
  return first;
}

}  // namespace plotscan::scan
