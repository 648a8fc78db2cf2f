// SPDX-License-Identifier: Apache-2.0
#include "scan/cloud_reader.h"

#include <algorithm>
#include <array>
#include <sstream>

#include <fmt/format.h>

#include "core/error.h"
#include "core/parse.h"
#include "core/text.h"
#include "scan/fields.h"
#include "scan/internal/cloud_layout.h"
#include "scan/internal/foreign_file.h"
#include "scan/internal/las_format.h"
#include "scan/las_crs.h"

namespace plotscan::scan {
namespace {

constexpr std::size_t kMaxHeaderLine = std::size_t{1} << 16;
// How many bytes are read to recognise a format.
constexpr std::size_t kStart = std::size_t{1} << 12;

enum class CloudFormat { pcd, ply, las, text };

std::string start_of(const std::filesystem::path& file) {
  require_file(file);
  std::ifstream in(file, std::ios::binary);
  std::string start(kStart, '\0');
  in.read(start.data(), static_cast<std::streamsize>(start.size()));
  start.resize(static_cast<std::size_t>(in.gcount()));
  return start;
}

// Whether the first line is "ply", with or without blanks after it.
bool is_ply(const std::string& start) {
  const std::size_t end = start.find_first_of("\r\n");
  return start.starts_with("ply") && end != std::string::npos &&
         start.find_first_not_of(" \t", 3) == end;
}

// Whether the file begins with an entry of a PCD header, possibly after comments.
bool is_pcd(const std::string& start) {
  std::istringstream in(start);
  for (std::string line, word; std::getline(in, line); word.clear()) {
    std::istringstream(line) >> word;
    if (word.empty() || word.starts_with('#')) continue;
    return word == "VERSION" || word == "FIELDS" || word == "COLUMNS";
  }
  return start.starts_with("# .PCD");
}

bool is_text(std::string_view start) {
  return std::ranges::all_of(start, [](unsigned char c) {
    return c >= ' ' || c == '\n' || c == '\r' || c == '\t' || c == '\f';
  });
}

// The format by content, since names may be wrong.
CloudFormat cloud_format(const std::filesystem::path& file) {
  const std::string start = start_of(file);
  if (is_ply(start)) return CloudFormat::ply;
  if (start.starts_with("LASF")) return CloudFormat::las;
  if (is_pcd(start)) return CloudFormat::pcd;
  if (start.empty()) throw InputError(file, "is empty; a PCD, PLY, LAS or text cloud is expected");
  const std::string_view foreign = foreign_file(start);
  if (foreign.empty() && is_text(start)) return CloudFormat::text;
  throw InputError(file, "is neither a PCD, nor a PLY, nor a LAS cloud, nor text{}",
                   foreign.empty() ? "" : ", but " + std::string(foreign));
}

CloudLayout read_header_of(CloudFormat format, const std::filesystem::path& file) {
  switch (format) {
    case CloudFormat::pcd:
      return read_pcd_header(file);
    case CloudFormat::ply:
      return read_ply_header(file);
    case CloudFormat::las:
      return read_las_header(file);
    case CloudFormat::text:
      return read_text_header(file);
  }
  throw std::logic_error("unknown format of a cloud");
}

// Decides by marks and class whether a point is kept.
class PointFilter {
 public:
  enum class Fate { kept, marked, left_out };

  // Adds the fields that it needs to those that are read.
  PointFilter(const std::filesystem::path& file, const CloudLayout& layout, const CloudFiles& cloud,
              const PositionOptions& options, std::vector<ScalarField>& fields) {
    marks_ = options.leave_out_marked && layout.is_las;
    only_ = !cloud.only_classes.empty();
    left_out_.fill(only_);
    for (const int number : cloud.only_classes)
      left_out_.at(static_cast<std::size_t>(number)) = false;
    for (const int number : cloud.leave_out_classes)
      left_out_.at(static_cast<std::size_t>(number)) = true;
    if (marks_) add(layout.find(las::kWithheld), withheld_, fields);
    has_class_ = marks_ || !cloud.leave_out_classes.empty() || !cloud.only_classes.empty();
    if (!has_class_) return;
    const ScalarField* classification = find_field(layout, {std::string(las::kClassification)});
    if (classification == nullptr)
      throw InputError(
          file, "has no field \"classification\": its points have no class to choose them by");
    add(classification, class_, fields);
  }

  Fate fate_of(std::span<const double> row) const {
    if (!has_class_) return Fate::kept;
    const double number = row[class_];
    if (marks_ && (row[withheld_] != 0 || number == las::kLowNoise || number == las::kHighNoise))
      return Fate::marked;
    const bool is_class = number >= 0 && number < static_cast<double>(left_out_.size());
    const bool left_out = is_class ? left_out_[static_cast<std::size_t>(number)] : only_;
    return left_out ? Fate::left_out : Fate::kept;
  }

 private:
  static void add(const ScalarField* field, std::size_t& place, std::vector<ScalarField>& fields) {
    place = fields.size();
    fields.push_back(*field);
  }

  bool marks_ = false;
  bool has_class_ = false;
  bool only_ = false;         // only the chosen classes are read
  std::size_t withheld_ = 0;  // places in a row
  std::size_t class_ = 0;
  std::array<bool, 256> left_out_{};
};

// Streams one file to the sink and adds it to the summary, whose system the file has.
void read_file(const std::filesystem::path& file, const CloudFiles& cloud,
               const PositionOptions& options, const PositionSink& sink, CloudSummary& summary) {
  const CloudLayout layout = read_cloud_header(file);
  std::vector<ScalarField> fields = layout.coordinates();
  const PointFilter filter(file, layout, cloud, options, fields);
  std::vector<Eigen::Vector3d> positions;
  read_rows(file, layout, fields, [&](std::span<const double> rows) {
    positions.clear();
    for (std::size_t i = 0; i < rows.size(); i += fields.size()) {
      const auto row = rows.subspan(i, fields.size());
      const Eigen::Vector3d position = summary.system.metres_of({row[0], row[1], row[2]});
      const PointFilter::Fate fate = filter.fate_of(row);
      if (!position.allFinite()) {
        ++summary.not_finite;
      } else if (fate == PointFilter::Fate::marked) {
        ++summary.marked;
      } else if (fate == PointFilter::Fate::left_out) {
        ++summary.left_out;
      } else {
        positions.push_back(position);
      }
    }
    summary.points += positions.size();
    if (!positions.empty()) sink(positions);
  });
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

const ScalarField* find_field(const CloudLayout& layout, const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    for (const ScalarField& field : layout.fields) {
      const bool readable = field.count == 1 && (field.kind != 'F' || field.size >= 4);
      if (readable && plain_name(field.name) == name) return &field;
    }
  }
  return nullptr;
}

std::string CloudLayout::crs() const {
  if (!crs_wkt.empty()) return short_crs(crs_wkt);
  return crs_epsg == 0 ? "" : "EPSG:" + std::to_string(crs_epsg);
}

HeaderLines::HeaderLines(const std::filesystem::path& file)
    : file_(file), in_(file, std::ios::binary) {}

std::optional<std::string> HeaderLines::next_text() {
  std::string text;
  ++line_;
  for (;;) {
    const int c = in_.get();
    if (c == std::ifstream::traits_type::eof()) break;
    ++offset_;
    if (c == '\n') return text;
    if (text.size() == kMaxHeaderLine) fail("a header line is too long; the header is broken");
    text.push_back(static_cast<char>(c));
  }
  if (text.empty()) return std::nullopt;
  return text;
}

const std::vector<std::string>& HeaderLines::next() {
  const std::optional<std::string> text = next_text();
  if (!text) fail("the file ends inside its header");
  words_.clear();
  std::istringstream in(*text);
  for (std::string word; in >> word;) words_.push_back(word);
  return words_;
}

void HeaderLines::fail(const std::string& what) const { throw InputError(file_, line_, what); }

std::uint64_t HeaderLines::whole_number(const std::string& word, std::uint64_t low,
                                        std::uint64_t high) const {
  const auto value = parsed<std::uint64_t>(word);
  if (!value || *value < low || *value > high) {
    fail("\"" + word + "\" must be a whole number in [" + std::to_string(low) + ", " +
         std::to_string(high) + "]");
  }
  return *value;
}

void require_coordinates(const HeaderLines& lines, CloudLayout& layout) {
  for (const char axis : {'x', 'y', 'z'}) {
    const std::string name(1, axis);
    const std::string capital(1, static_cast<char>(axis - 'x' + 'X'));
    const auto capitals = std::ranges::find(layout.fields, capital, &ScalarField::name);
    if (layout.find(name) == nullptr && capitals != layout.fields.end()) capitals->name = name;
    const ScalarField* field = layout.find(name);
    if (field == nullptr) lines.fail("the cloud has no field \"" + name + "\"");
    if (field->kind != 'F' || field->size < 4 || field->count != 1)
      lines.fail("field \"" + name + "\" must be one float of 4 or 8 bytes");
  }
}

CloudLayout read_cloud_header(const std::filesystem::path& file) {
  CloudLayout layout = read_header_of(cloud_format(file), file);
  if (layout.points == 0) throw InputError(file, "the cloud is empty: its header says 0 points");
  return layout;
}

double expected_points(const CloudFiles& cloud) {
  constexpr double kBytesOfLine = 40;
  double points = 0;
  for (const std::filesystem::path& file : cloud.files) {
    const CloudLayout layout = read_cloud_header(file);
    points += layout.points < kMaxPoints
                  ? static_cast<double>(layout.points)
                  : static_cast<double>(std::filesystem::file_size(file)) / kBytesOfLine;
  }
  return points;
}

CloudSummary read_positions(const CloudFiles& cloud, const PositionSink& sink,
                            const PositionOptions& options) {
  CloudSummary summary{.system = read_cloud_system(cloud)};
  for (const std::filesystem::path& file : cloud.files)
    read_file(file, cloud, options, sink, summary);
  if (summary.points + summary.marked + summary.left_out == 0)
    throw InputError(cloud.name() + ": no point of the cloud has finite x, y and z");
  if (summary.points == 0 && !cloud.only_classes.empty())
    throw InputError(cloud.name() + ": no point is of the classes that are to be read: " +
                     fmt::format("{}", fmt::join(cloud.only_classes, ", ")));
  if (summary.points == 0) {
    throw InputError(cloud.name() + ": all points of the cloud are marked as withheld or noise" +
                     (summary.left_out > 0 ? ", or of a class to leave out" : ""));
  }
  return summary;
}

std::vector<Eigen::Vector3f> read_positions(const std::filesystem::path& cloud) {
  std::vector<Eigen::Vector3f> points;
  read_positions(cloud, [&](std::span<const Eigen::Vector3d> piece) {
    for (const Eigen::Vector3d& point : piece) points.push_back(point.cast<float>());
  });
  return points;
}

}  // namespace plotscan::scan
