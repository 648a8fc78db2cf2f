// SPDX-License-Identifier: Apache-2.0
#pragma once

// What a cloud's header tells about the points that follow it.

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/coordinate_units.h"
#include "core/utc_time.h"
#include "scan/fields.h"

namespace plotscan::scan {

enum class CloudBody {
  ascii,       // one point a line
  binary,      // one record a point
  compressed,  // PCD: LZF over field after field
  laz,         // LAS records as LASzip packs them
};

struct CloudLayout {
  std::string format;  // "PCD, binary", for people
  CloudBody body = CloudBody::ascii;
  bool big_endian = false;
  std::uint64_t points = 0;     // kMaxPoints if only the file's end tells
  std::size_t columns = 0;      // of an ascii line
  std::size_t record_size = 0;  // of a point, bytes
  std::vector<ScalarField> fields;
  std::uint64_t body_offset = 0;  // of the first point, bytes from the file's start
  std::size_t body_line = 0;      // of the first point, lines from 1

  bool in_degrees = false;         // of x and y
  CoordinateUnits units;           // else
  std::vector<std::string> notes;  // what the user should know, one sentence each

  // Only for text clouds (text_header.cpp).
  bool is_text = false;
  char separator = ' ';          // of a line's columns; ' ': any blanks
  bool has_counts = false;       // a line of one number counts the points that follow it (.pts)
  bool may_lack_values = false;  // a table with names: an empty value is one that was not measured

  // Only for LAS.
  bool is_las = false;
  int point_format = 0;
  std::string crs_wkt;
  int crs_epsg = 0;                // from GeoTIFF keys; 0: none
  bool adjusted_gps_time = false;  // GPS time minus 1e9 s; else time of the GPS week
  std::optional<UtcTime> start;    // of the points' time 0; only in Plotscan's files

  // Adds a field after the others and sets its column and offset.
  void append(ScalarField field);
  // The coordinate system: "EPSG:<code>", well-known text that names no code, or "".
  std::string crs() const;
  // The field of that name; nullptr if there is none.
  const ScalarField* find(std::string_view name) const;
  // x, y and z, which every layout has.
  std::vector<ScalarField> coordinates() const { return {*find("x"), *find("y"), *find("z")}; }
};

// Reads a cloud's header line by line, counting lines. Refuses what is no text.
class HeaderLines {
 public:
  explicit HeaderLines(const std::filesystem::path& file);

  // The next line's words; an empty line has none. InputError at the end of the file.
  const std::vector<std::string>& next();
  // The next line; absent at the end of the file.
  std::optional<std::string> next_text();
  // The offset of the next line, bytes from the file's start.
  std::uint64_t offset() const { return offset_; }
  std::size_t line() const { return line_; }
  [[noreturn]] void fail(const std::string& what) const;
  // A word of the last line as a whole number in [low, high], or InputError.
  std::uint64_t whole_number(const std::string& word, std::uint64_t low, std::uint64_t high) const;

 private:
  std::filesystem::path file_;
  std::ifstream in_;
  std::size_t line_ = 0;
  std::uint64_t offset_ = 0;
  std::vector<std::string> words_;
};

// The columns of an ascii line, without the blanks around them. A separator of ' ' stands for any
// blanks.
void split_columns(std::string_view line, char separator, std::vector<std::string_view>& columns);
// The number that the whole word stands for, with any sign, nan, NA and inf included; absent if it
// is none.
std::optional<double> number_of(std::string_view word);
// Whether a line of a text cloud is a comment: "#..." or "//...".
bool is_comment(std::string_view line);

// The most bytes one point may have: ample for descriptors of a thousand numbers.
inline constexpr std::size_t kMaxRecordSize = std::size_t{1} << 16;
// The most points a file may promise, so that sizes in bytes never overflow.
inline constexpr std::uint64_t kMaxPoints = std::uint64_t{1} << 40;

CloudLayout read_pcd_header(const std::filesystem::path& file);
CloudLayout read_ply_header(const std::filesystem::path& file);
CloudLayout read_las_header(const std::filesystem::path& file);
// Lines of x y z, with or without a line of names or a count in front of them.
CloudLayout read_text_header(const std::filesystem::path& file);
// Reads the header of a cloud, whose format is recognised by its content. Throws InputError when
// the file is no cloud, or empty.
CloudLayout read_cloud_header(const std::filesystem::path& file);

// Makes sure that a PCD or PLY layout has x, y and z; X, Y and Z are renamed. Throws InputError at
// the header's last line unless each is a single float.
void require_coordinates(const HeaderLines& lines, CloudLayout& layout);

// The first field that is one readable number and has one of the names; earlier names take
// precedence. Names are plain ones (fields.h). nullptr when there is none.
const ScalarField* find_field(const CloudLayout& layout, const std::vector<std::string>& names);

// The instant of a LAS file's adjusted GPS time; absent outside of the century from 1980.
std::optional<UtcTime> utc_of_adjusted_gps(double adjusted_s);

// When a cloud's points' time 0 was, if its file states it (CloudInfo::start).
std::optional<UtcTime> start_time_of(const std::filesystem::path& cloud, const CloudLayout& layout);

// Receives rows of numbers one after the other. A row is one point, with a number for each
// requested field.
using RowSink = std::function<void(std::span<const double> rows)>;

// Passes these fields (of one element each) of the first `limit` points to the sink. Throws
// InputError when the file is truncated or broken.
void read_rows(const std::filesystem::path& file, const CloudLayout& layout,
               std::span<const ScalarField> fields, const RowSink& sink,
               std::uint64_t limit = kMaxPoints);

// The first row of these fields, x, y and z in front, whose coordinates are finite; absent if
// there is none at the cloud's beginning.
std::optional<std::vector<double>> first_finite(const std::filesystem::path& file,
                                                const CloudLayout& layout,
                                                std::span<const ScalarField> fields);

}  // namespace plotscan::scan
