// SPDX-License-Identifier: Apache-2.0
#include <optional>

#include "scan/internal/cloud_layout.h"

namespace plotscan::scan {
namespace {

// PCL's own header parser allocates whatever the header promises; this one allocates nothing.

struct PcdHeader {
  std::vector<ScalarField> fields;
  bool has_size = false;
  bool has_type = false;
  std::optional<std::uint64_t> width;
  std::optional<std::uint64_t> height;
  std::optional<std::uint64_t> points;
  std::string data;
};

using Words = std::vector<std::string>;

// Throws InputError unless the line has one word per field after its keyword.
void require_one_a_field(const HeaderLines& lines, const Words& words, const PcdHeader& header) {
  if (header.fields.empty()) lines.fail(words[0] + " stands before FIELDS");
  if (words.size() - 1 != header.fields.size()) {
    lines.fail(words[0] + " has " + std::to_string(words.size() - 1) + " values; FIELDS names " +
               std::to_string(header.fields.size()));
  }
}

void read_sizes(const HeaderLines& lines, const Words& words, PcdHeader& header) {
  require_one_a_field(lines, words, header);
  for (std::size_t i = 1; i < words.size(); ++i) {
    const std::size_t size = lines.whole_number(words[i], 1, 8);
    if (size != 1 && size != 2 && size != 4 && size != 8) lines.fail("SIZE must be 1, 2, 4 or 8");
    header.fields[i - 1].size = size;
  }
  header.has_size = true;
}

void read_types(const HeaderLines& lines, const Words& words, PcdHeader& header) {
  require_one_a_field(lines, words, header);
  for (std::size_t i = 1; i < words.size(); ++i) {
    if (words[i] != "I" && words[i] != "U" && words[i] != "F") lines.fail("TYPE must be I, U or F");
    header.fields[i - 1].kind = words[i][0];
  }
  header.has_type = true;
}

void read_counts(const HeaderLines& lines, const Words& words, PcdHeader& header) {
  require_one_a_field(lines, words, header);
  for (std::size_t i = 1; i < words.size(); ++i)
    header.fields[i - 1].count = lines.whole_number(words[i], 1, kMaxRecordSize);
}

void read_line(const HeaderLines& lines, const Words& words, PcdHeader& header) {
  const std::string& key = words[0];
  if (words.size() < 2) lines.fail(key + " has no value");
  if (key == "FIELDS" || key == "COLUMNS") {
    header.fields.clear();
    for (std::size_t i = 1; i < words.size(); ++i) header.fields.push_back({.name = words[i]});
  } else if (key == "SIZE") {
    read_sizes(lines, words, header);
  } else if (key == "TYPE") {
    read_types(lines, words, header);
  } else if (key == "COUNT") {
    read_counts(lines, words, header);
  } else if (key == "WIDTH") {
    header.width = lines.whole_number(words[1], 0, kMaxPoints);
  } else if (key == "HEIGHT") {
    header.height = lines.whole_number(words[1], 0, kMaxPoints);
  } else if (key == "POINTS") {
    header.points = lines.whole_number(words[1], 0, kMaxPoints);
  } else if (key == "DATA") {
    header.data = words[1];
  } else if (key != "VERSION" && key != "VIEWPOINT") {
    lines.fail("unknown PCD header entry \"" + key + "\"");
  }
}

std::uint64_t point_count(const HeaderLines& lines, const PcdHeader& header) {
  if (header.points) return *header.points;
  if (!header.width) lines.fail("the header has neither POINTS nor WIDTH");
  const std::uint64_t height = header.height.value_or(1);
  if (height != 0 && *header.width > kMaxPoints / height)
    lines.fail("WIDTH x HEIGHT is more than " + std::to_string(kMaxPoints) + " points");
  return *header.width * height;
}

CloudBody body_kind(const HeaderLines& lines, const std::string& data) {
  if (data == "ascii") return CloudBody::ascii;
  if (data == "binary") return CloudBody::binary;
  if (data == "binary_compressed") return CloudBody::compressed;
  lines.fail("DATA \"" + data + "\" must be ascii, binary or binary_compressed");
}

}  // namespace

CloudLayout read_pcd_header(const std::filesystem::path& file) {
  HeaderLines lines(file);
  PcdHeader header;
  while (header.data.empty()) {
    const Words& words = lines.next();
    if (!words.empty() && words[0][0] != '#') read_line(lines, words, header);
  }
  if (!header.has_size || !header.has_type) lines.fail("the header needs FIELDS, SIZE and TYPE");

  CloudLayout layout;
  layout.body = body_kind(lines, header.data);
  layout.format = "PCD, " + header.data;
  layout.points = point_count(lines, header);
  for (const ScalarField& field : header.fields) {
    layout.append(field);
    if (layout.record_size > kMaxRecordSize)
      lines.fail("a point has more than " + std::to_string(kMaxRecordSize) + " bytes");
  }
  require_coordinates(lines, layout);
  layout.body_offset = lines.offset();
  layout.body_line = lines.line() + 1;
  return layout;
}

}  // namespace plotscan::scan
