// SPDX-License-Identifier: Apache-2.0
#include <map>

#include "scan/internal/cloud_layout.h"

namespace plotscan::scan {
namespace {

struct ScalarType {
  char kind;
  std::size_t size;
};

// PLY's scalar types, by both of their names.
ScalarType scalar_type(const HeaderLines& lines, const std::string& type) {
  static const std::map<std::string, ScalarType> types = {
      {"char", {'I', 1}},  {"int8", {'I', 1}},    {"uchar", {'U', 1}},  {"uint8", {'U', 1}},
      {"short", {'I', 2}}, {"int16", {'I', 2}},   {"ushort", {'U', 2}}, {"uint16", {'U', 2}},
      {"int", {'I', 4}},   {"int32", {'I', 4}},   {"uint", {'U', 4}},   {"uint32", {'U', 4}},
      {"float", {'F', 4}}, {"float32", {'F', 4}}, {"double", {'F', 8}}, {"float64", {'F', 8}}};
  const auto found = types.find(type);
  if (found == types.end()) lines.fail("unknown PLY property type \"" + type + "\"");
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
  layout.format = "PLY, " + format;
  layout.big_endian = format == "binary_big_endian";
}

void read_vertex_property(const HeaderLines& lines, const std::vector<std::string>& words,
                          CloudLayout& layout) {
  if (words.size() > 1 && words[1] == "list")
    lines.fail("a list property of element vertex is not supported");
  if (words.size() != 3) lines.fail("a property needs a type and a name");
  const ScalarType type = scalar_type(lines, words[1]);
  layout.append({.name = words[2], .kind = type.kind, .size = type.size});
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
  require_coordinates(lines, layout);
  layout.body_offset = lines.offset();
  layout.body_line = lines.line() + 1;
  return layout;
}

}  // namespace plotscan::scan
