// SPDX-License-Identifier: Apache-2.0
#include "scan/cloud_reader.h"

#include <algorithm>
#include <charconv>
#include <sstream>

#include "core/error.h"
#include "scan/cloud_layout.h"
#include "scan/las_crs.h"
#include "scan/las_format.h"

namespace plotscan::scan {
namespace {

constexpr std::size_t kMaxHeaderLine = std::size_t{1} << 16;

enum class CloudFormat { pcd, ply, las };

// By content, since names lie: PLY and LAS begin with their names, PCD with a comment or a header
// entry.
CloudFormat cloud_format(const std::filesystem::path& file) {
  require_file(file);
  std::ifstream in(file, std::ios::binary);
  std::string start(7, '\0');
  in.read(start.data(), static_cast<std::streamsize>(start.size()));
  start.resize(static_cast<std::size_t>(in.gcount()));
  if (start.starts_with("ply\n") || start.starts_with("ply\r")) return CloudFormat::ply;
  if (start.starts_with("LASF")) return CloudFormat::las;
  if (start.starts_with("#") || start.starts_with("VERSION") || start.starts_with("FIELDS") ||
      start.starts_with("COLUMNS"))
    return CloudFormat::pcd;
  throw InputError(file, start.empty() ? "is empty; a PCD, PLY or LAS cloud is expected"
                                       : "is neither a PCD, nor a PLY, nor a LAS cloud");
}

// By a LAS point's withheld flag and class.
bool is_marked(std::span<const double> withheld_and_class) {
  return withheld_and_class[0] != 0 || withheld_and_class[1] == las::kLowNoise ||
         withheld_and_class[1] == las::kHighNoise;
}

}  // namespace

void CloudLayout::append(ScalarField field) {
  field.column = columns;
  field.offset = record_size;
  columns += field.count;
  record_size += field.count * field.size;
  fields.push_back(std::move(field));
}

const ScalarField* CloudLayout::find(std::string_view name) const {
  const auto found = std::ranges::find(fields, name, &ScalarField::name);
  return found == fields.end() ? nullptr : &*found;
}

std::string CloudLayout::crs() const {
  if (!crs_wkt.empty()) return short_crs(crs_wkt);
  return crs_epsg == 0 ? "" : "EPSG:" + std::to_string(crs_epsg);
}

HeaderLines::HeaderLines(const std::filesystem::path& file)
    : file_(file), in_(file, std::ios::binary) {}

const std::vector<std::string>& HeaderLines::next() {
  std::string text;
  ++line_;
  for (;;) {
    const int c = in_.get();
    if (c == std::ifstream::traits_type::eof()) fail("the file ends inside its header");
    ++offset_;
    if (c == '\n') break;
    if (text.size() == kMaxHeaderLine) fail("a header line is too long; the header is broken");
    text.push_back(static_cast<char>(c));
  }
  words_.clear();
  std::istringstream in(text);
  for (std::string word; in >> word;) words_.push_back(word);
  return words_;
}

void HeaderLines::fail(const std::string& what) const { throw InputError(file_, line_, what); }

std::uint64_t HeaderLines::whole_number(const std::string& word, std::uint64_t low,
                                        std::uint64_t high) const {
  std::uint64_t value = 0;
  const char* end = word.data() + word.size();
  const auto [stopped, error] = std::from_chars(word.data(), end, value);
  if (error != std::errc() || stopped != end || value < low || value > high) {
    fail("\"" + word + "\" must be a whole number in [" + std::to_string(low) + ", " +
         std::to_string(high) + "]");
  }
  return value;
}

void require_coordinates(const HeaderLines& lines, const CloudLayout& layout) {
  for (const char axis : {'x', 'y', 'z'}) {
    const std::string name(1, axis);
    const ScalarField* field = layout.find(name);
    if (field == nullptr) lines.fail("the cloud has no field \"" + name + "\"");
    if (field->kind != 'F' || field->size < 4 || field->count != 1)
      lines.fail("field \"" + name + "\" must be one float of 4 or 8 bytes");
  }
}

CloudLayout read_cloud_header(const std::filesystem::path& file) {
  const CloudFormat format = cloud_format(file);
  const CloudLayout layout = format == CloudFormat::pcd   ? read_pcd_header(file)
                             : format == CloudFormat::ply ? read_ply_header(file)
                                                          : read_las_header(file);
  if (layout.points == 0) throw InputError(file, "the cloud is empty: its header says 0 points");
  return layout;
}

CloudSummary read_positions(const std::filesystem::path& cloud, const PositionSink& sink,
                            const PositionOptions& options) {
  const CloudLayout layout = read_cloud_header(cloud);
  std::vector<ScalarField> fields = {*layout.find("x"), *layout.find("y"), *layout.find("z")};
  const bool marks = options.leave_out_marked && layout.is_las;
  if (marks) {
    fields.push_back(*layout.find(las::kWithheld));
    fields.push_back(*layout.find(las::kClassification));
  }
  CloudSummary summary{.crs = layout.crs(), .in_degrees = layout.in_degrees};
  std::vector<Eigen::Vector3d> positions;
  read_rows(cloud, layout, fields, [&](std::span<const double> rows) {
    positions.clear();
    for (std::size_t i = 0; i < rows.size(); i += fields.size()) {
      const Eigen::Vector3d position(rows[i], rows[i + 1], rows[i + 2]);
      if (!position.allFinite()) {
        ++summary.not_finite;
      } else if (marks && is_marked(rows.subspan(i + 3, 2))) {
        ++summary.marked;
      } else {
        positions.push_back(position);
      }
    }
    summary.points += positions.size();
    if (!positions.empty()) sink(positions);
  });
  if (summary.points + summary.marked == 0)
    throw InputError(cloud, "no point of the cloud has finite x, y and z");
  if (summary.points == 0)
    throw InputError(cloud, "all points of the cloud are marked as withheld or noise");
  return summary;
}

std::string cloud_crs(const std::filesystem::path& cloud) { return read_cloud_header(cloud).crs(); }

}  // namespace plotscan::scan
