// SPDX-License-Identifier: Apache-2.0
#include <map>

#include "core/error.h"
#include "scan/cloud_layout.h"

namespace plotscan::scan {
namespace {

// PLY's scalar types, by both of their names.
std::size_t scalar_size(const HeaderLines& lines, const std::string& type) {
  static const std::map<std::string, std::size_t> sizes = {
      {"char", 1},   {"int8", 1},    {"uchar", 1},  {"uint8", 1},  {"short", 2}, {"int16", 2},
      {"ushort", 2}, {"uint16", 2},  {"int", 4},    {"int32", 4},  {"uint", 4},  {"uint32", 4},
      {"float", 4},  {"float32", 4}, {"double", 8}, {"float64", 8}};
  const auto found = sizes.find(type);
  if (found == sizes.end()) lines.fail("unknown PLY property type \"" + type + "\"");
  return found->second;
}

void read_format(const HeaderLines& lines, const std::vector<std::string>& words,
                 CloudLayout& layout) {
  const std::string format = words.size() > 1 ? words[1] : "";
  if (format != "ascii" && format != "binary_little_endian" && format != "binary_big_endian") {
    lines.fail("PLY format \"" + format +
               "\" must be ascii, binary_little_endian or binary_big_endian");
  }
  layout.body = format == "ascii" ? CloudBody::ascii : CloudBody::binary;
  layout.big_endian = format == "binary_big_endian";
}

void read_vertex_property(const HeaderLines& lines, const std::vector<std::string>& words,
                          CloudLayout& layout) {
  if (words.size() > 1 && words[1] == "list")
    lines.fail("a list property of element vertex is not supported");
  if (words.size() != 3) lines.fail("a property needs a type and a name");
  const std::size_t size = scalar_size(lines, words[1]);
  for (int axis = 0; axis < 3; ++axis) {
    if (words[2] != std::string(1, "xyz"[axis])) continue;
    const bool is_float = words[1][0] == 'f' || words[1][0] == 'd';
    if (!is_float) lines.fail("property \"" + words[2] + "\" must be float or double");
    layout.xyz[axis] = {
        .column = layout.columns, .offset = layout.record_size, .element_size = size};
  }
  ++layout.columns;
  layout.record_size += size;
  if (layout.record_size > kMaxRecordSize)
    lines.fail("a vertex has more than " + std::to_string(kMaxRecordSize) + " bytes");
}

}  // namespace

CloudLayout read_ply_header(const std::filesystem::path& file) {
  HeaderLines lines(file);
  CloudLayout layout;
  std::string element;
  bool has_vertex = false;
  for (const auto* words = &lines.next();; words = &lines.next()) {
    if (words->empty()) continue;
    const std::string& key = words->front();
    if (key == "end_header") break;
    if (key == "format") {
      read_format(lines, *words, layout);
    } else if (key == "element") {
      if (words->size() != 3) lines.fail("an element needs a name and a count");
      element = (*words)[1];
      if (element == "vertex") {
        layout.points = lines.whole_number((*words)[2], 0, kMaxPoints);
        has_vertex = true;
      } else if (!has_vertex) {
        lines.fail("element vertex must come first, before \"" + element + "\"");
      }
    } else if (key == "property" && element == "vertex") {
      read_vertex_property(lines, *words, layout);
    } else if (key != "property" && key != "comment" && key != "obj_info" && lines.line() != 1) {
      lines.fail("unknown PLY header entry \"" + key + "\"");
    }
  }
  for (int axis = 0; axis < 3; ++axis) {
    if (layout.xyz[axis].element_size == 0)
      lines.fail("the cloud has no vertex property \"" + std::string(1, "xyz"[axis]) + "\"");
  }
  layout.body_offset = lines.offset();
  layout.body_line = lines.line() + 1;
  return layout;
}

}  // namespace plotscan::scan
