// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstring>

#include <fmt/core.h>

#include "core/coordinate_units.h"
#include "core/error.h"
#include "core/geodesy.h"
#include "core/printable.h"
#include "scan/cloud_system.h"
#include "scan/internal/cloud_layout.h"
#include "scan/internal/las_format.h"
#include "scan/las_crs.h"

namespace plotscan::scan {
namespace {

// The most bytes of a description that are kept: a coordinate system has a few thousand.
constexpr std::uint64_t kMaxText = std::uint64_t{1} << 16;
constexpr std::size_t kOldHeaderSize = 227;
constexpr std::uint8_t kCompressedFormat = 0xC0;  // LAZ sets one of these bits
#ifdef PLOTSCAN_HAVE_LASZIP
constexpr bool kReadsLaz = true;
#else
constexpr bool kReadsLaz = false;
#endif

// A LAS file whose header is being read: little-endian numbers at given offsets.
class LasFile {
 public:
  explicit LasFile(const std::filesystem::path& file)
      : file_(file), in_(file, std::ios::binary), size_(std::filesystem::file_size(file)) {}

  std::uint64_t size() const { return size_; }
  [[noreturn]] void fail(const std::string& what) const { throw InputError(file_, what); }
  std::string bytes(std::uint64_t offset, std::uint64_t count) {
    if (offset > size_ || count > size_ - offset) fail("is truncated: its header is not whole");
    std::string text(count, '\0');
    in_.seekg(static_cast<std::streamoff>(offset));
    in_.read(text.data(), static_cast<std::streamsize>(count));
    if (!in_) fail("cannot be read");
    return text;
  }
  // Text up to its first zero byte. (The LAS specification states no encoding.)
  std::string text(std::uint64_t offset, std::uint64_t count) {
    const std::string all = bytes(offset, count);
    return utf8_of(all.substr(0, all.find('\0')));
  }
  template <class T>
  T number(std::uint64_t offset) {
    T value;
    std::memcpy(&value, bytes(offset, sizeof value).data(), sizeof value);
    return value;
  }

 private:
  std::filesystem::path file_;
  std::ifstream in_;
  std::uint64_t size_;
};

struct LasHeader {
  int minor = 0;  // of version 1.minor
  std::size_t size = 0;
  std::uint64_t points_at = 0;
  int format = 0;
  bool compressed = false;
  std::size_t record_size = 0;
  std::uint64_t points = 0;
};

std::uint64_t point_count(LasFile& file, int minor) {
  const std::uint64_t count = minor >= 4 ? file.number<std::uint64_t>(247) : 0;
  return count != 0 ? count : file.number<std::uint32_t>(107);
}

LasHeader read_header(LasFile& file) {
  LasHeader header;
  const int major = file.number<std::uint8_t>(24);
  header.minor = file.number<std::uint8_t>(25);
  if (major != 1 || header.minor > 4) {
    file.fail("LAS version " + std::to_string(major) + "." + std::to_string(header.minor) +
              " is not known; 1.0 to 1.4 are");
  }
  header.size = file.number<std::uint16_t>(94);
  if (header.size < (header.minor >= 4 ? las::kHeaderSize : kOldHeaderSize))
    file.fail("its header says that it has " + std::to_string(header.size) + " bytes: too few");
  header.points_at = file.number<std::uint32_t>(96);
  if (header.points_at < header.size || header.points_at > file.size())
    file.fail("its points begin at byte " + std::to_string(header.points_at) +
              ", which is not between the header and the file's end");
  const auto packed_format = file.number<std::uint8_t>(104);
  header.compressed = (packed_format & kCompressedFormat) != 0;
  if (header.compressed && !kReadsLaz)
    file.fail(
        "is compressed (LAZ), which this build does not read; make a LAS of it with scripts/unlaz, "
        "or build Plotscan where liblaszip-dev is installed (Debian 13, Ubuntu 24.04)");
  const auto format = static_cast<std::uint8_t>(packed_format & ~kCompressedFormat);
  if (format >= las::kFormatSizes.size())
    file.fail("point format " + std::to_string(format) + " is not known; 0 to 10 are");
  header.format = format;
  header.record_size = file.number<std::uint16_t>(105);
  if (header.record_size < las::kFormatSizes[format])
    file.fail("points of format " + std::to_string(format) + " have at least " +
              std::to_string(las::kFormatSizes[format]) + " bytes; the header says " +
              std::to_string(header.record_size));
  header.points = point_count(file, header.minor);
  if (header.points > kMaxPoints)
    file.fail("promises " + std::to_string(header.points) + " points");
  return header;
}

void add_coordinates(LasFile& file, CloudLayout& layout) {
  for (std::uint64_t axis = 0; axis < 3; ++axis) {
    const auto scale = file.number<double>(131 + 8 * axis);
    const auto offset = file.number<double>(155 + 8 * axis);
    if (!std::isfinite(scale) || scale == 0 || !std::isfinite(offset))
      file.fail("its scale factors must be finite and not 0, its offsets finite");
    layout.fields.push_back({.name = std::string(1, "xyz"[axis]),
                             .kind = 'I',
                             .size = 4,
                             .offset = 4 * axis,
                             .scale = scale,
                             .add = offset});
  }
}

ScalarField whole(const std::string& name, std::size_t offset, std::size_t size, int shift = 0,
                  int bits = 0) {
  return {.name = name, .kind = 'U', .size = size, .offset = offset, .shift = shift, .bits = bits};
}

// Adds the fields of a point format: tables 7 to 18 of the specification.
void add_format_fields(int format, CloudLayout& layout) {
  ScalarField intensity = whole("intensity", 12, 2);
  intensity.scale = 1 / las::kIntensityScale;
  layout.fields.push_back(intensity);
  const bool is_new = format >= las::kNewFormats;
  const int bits = is_new ? 4 : 3;
  layout.fields.push_back(whole("return_number", 14, 1, 0, bits));
  layout.fields.push_back(whole("number_of_returns", 14, 1, bits, bits));
  const std::string classification(las::kClassification);
  layout.fields.push_back(is_new ? whole(classification, 16, 1)
                                 : whole(classification, 15, 1, 0, 5));
  layout.fields.push_back(whole(std::string(las::kWithheld), 15, 1, is_new ? 2 : 7, 1));
  if (is_new || format == 1 || format >= 3)
    layout.fields.push_back({.name = "gps_time", .size = 8, .offset = is_new ? 22u : 20u});
}

// Adds the extra bytes: the fields after those of the point format (table 24).
void add_extra_bytes(LasFile& file, const std::string& descriptions, const LasHeader& header,
                     CloudLayout& layout) {
  static constexpr std::string_view kKinds = "UUIUIUIUIFF";
  static constexpr std::array<std::size_t, 11> kSizes = {1, 1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
  constexpr std::uint8_t kHasScale = 8;
  constexpr std::uint8_t kHasOffset = 16;
  if (descriptions.size() % las::kExtraByteSize != 0)
    file.fail("the description of its extra bytes is broken");
  std::size_t offset = las::kFormatSizes[static_cast<std::size_t>(header.format)];
  for (std::size_t at = 0; at < descriptions.size(); at += las::kExtraByteSize) {
    const std::string description = descriptions.substr(at, las::kExtraByteSize);
    const auto type = static_cast<std::uint8_t>(description[2]);
    const auto options = static_cast<std::uint8_t>(description[3]);
    if (type > 30)
      file.fail("an extra byte has type " + std::to_string(type) + "; 0 to 30 are known");
    // 11 to 20 and 21 to 30 are pairs and triples of 1 to 10.
    const std::size_t base = type == 0 ? 0 : (type - 1) % 10u + 1;
    ScalarField field{.name = {&description[4], strnlen(&description[4], 32)},
                      .kind = kKinds[base],
                      .size = kSizes[base],
                      .count = type == 0 ? options : (type - 1) / 10u + 1,
                      .offset = offset};
    offset += field.size * field.count;
    if (offset > header.record_size) file.fail("its extra bytes do not fit its points");
    if (type != 0 && (options & kHasScale) != 0)
      std::memcpy(&field.scale, &description[112], sizeof field.scale);
    if (type != 0 && (options & kHasOffset) != 0)
      std::memcpy(&field.add, &description[136], sizeof field.add);
    if (!std::isfinite(field.scale) || !std::isfinite(field.add))
      file.fail("the scale and offset of its extra byte \"" + field.name + "\" must be finite");
    if (type != 0) layout.fields.push_back(std::move(field));
  }
}

// What the records state of the coordinates; well-known text takes precedence over GeoTIFF keys.
struct StatedUnits {
  WktUnits wkt = {};
  WktUnits keys = {};
  bool keys_in_degrees = false;
};

// Metres in the unit of length with this EPSG code (EPSG data set v10.076: metre, foot, US survey
// foot). For an unknown code it adds a note to the layout.
std::optional<double> unit_of_code(std::uint16_t code, CloudLayout& layout) {
  if (code == 9001) return 1;
  if (code == 9002) return kFoot_m;
  if (code == 9003) return kUsSurveyFoot_m;
  layout.notes.push_back("its unit has the code " + std::to_string(code) +
                         ", which is not known here: taken for metres; --units says otherwise");
  return std::nullopt;
}

// Metres in the unit of a system of heights of EPSG's, if it is one of North America's (data set
// v10.076: NAVD88 and NGVD29, of which each unit has a code of its own).
std::optional<double> unit_of_heights(std::uint16_t code) {
  switch (code) {
    case 5703:
      return 1;
    case 8228:
      return kFoot_m;
    case 5702:
    case 6360:
      return kUsSurveyFoot_m;
    default:
      return std::nullopt;
  }
}

// Files exist that state so of coordinates that are none, so that it is a note.
void note_geocentric(CloudLayout& layout) {
  layout.notes.emplace_back(
      "it states geocentric coordinates, whose z does not point up; they are taken for x east, y "
      "north, z up: project the cloud first unless they are");
}

// GeoTIFF keys: quadruples of 16-bit numbers, key, where its value lies (0: here), count, value.
void read_geo_keys(const std::string& bytes, CloudLayout& layout, StatedUnits& stated) {
  WktUnits& units = stated.keys;
  std::vector<std::array<std::uint16_t, 4>> entries(bytes.size() / 8);
  std::memcpy(entries.data(), bytes.data(), entries.size() * 8);
  for (const auto& [key, place, count, value] : entries) {
    if (place != 0) continue;
    if (key == las::kModelKey) stated.keys_in_degrees = value == las::kGeographicModel;
    if (key == las::kModelKey && value == las::kGeocentricModel) note_geocentric(layout);
    if (key == las::kProjectedKey && value != las::kUserDefined) layout.crs_epsg = value;
    if (key == las::kLinearUnitsKey) units.horizontal_m = unit_of_code(value, layout);
    if (key == las::kVerticalKey && !units.vertical_m) units.vertical_m = unit_of_heights(value);
    if (key == las::kVerticalUnitsKey) units.vertical_m = unit_of_code(value, layout);
  }
}

// Heights without a unit of their own are in the unit of x and y, or metres if that is degrees.
CoordinateUnits units_of(const StatedUnits& stated) {
  CoordinateUnits units;
  units.horizontal_m = stated.wkt.horizontal_m.value_or(stated.keys.horizontal_m.value_or(1));
  units.vertical_m =
      stated.wkt.vertical_m.value_or(stated.keys.vertical_m.value_or(units.horizontal_m));
  return units;
}

// Whether the well-known text describes a coordinate system in degrees.
bool says_geographic(const std::string& wkt) {
  const auto has = [&](const char* word) { return wkt.find(word) != std::string::npos; };
  return !has("PROJCS") && !has("PROJCRS") && (has("GEOGCS") || has("GEOGCRS") || has("GEODCRS"));
}

// GeoTIFF lets a file leave out the unit of a system of EPSG's (OGC 19-008r4, requirements of
// ProjLinearUnitsGeoKey), and some well-known text lacks it: UTM is in metres; for others the unit
// is not known here, which is noted.
void note_unknown_unit(const StatedUnits& stated, CloudLayout& layout) {
  const std::string crs = layout.crs();
  if (crs.empty() || layout.in_degrees || stated.wkt.horizontal_m || stated.keys.horizontal_m)
    return;
  if (utm_system(crs) || is_geographic(crs)) return;
  layout.notes.push_back("it states no unit, and that of its system, " + crs_name(crs) +
                         ", is not known here: taken for metres; --units says otherwise");
}

// A note only: the points' offset is stated elsewhere, so that a wrong count of records does not
// matter to them.
std::string count_note(std::uint64_t promised, std::uint64_t found) {
  return "the header promises " + std::to_string(promised) + " variable length records, " +
         std::to_string(found) + " are whole; the others were not looked at";
}

struct VariableRecords {
  std::uint64_t at = 0;  // offset of the first record's header
  std::uint64_t count = 0;
  bool extended = false;
};

void read_records(LasFile& file, const VariableRecords& records, const LasHeader& header,
                  CloudLayout& layout, StatedUnits& units) {
  auto [at, count, extended] = records;
  const std::uint64_t end = extended ? file.size() : header.points_at;
  const std::uint64_t header_size = extended ? las::kEvlrHeaderSize : las::kVlrHeaderSize;
  for (std::uint64_t i = 0; i < count; ++i) {
    const bool has_header = at <= end && end - at >= header_size;
    const std::uint64_t size = !has_header ? 0
                               : extended  ? file.number<std::uint64_t>(at + 20)
                                           : file.number<std::uint16_t>(at + 20);
    if (!has_header || size > end - at - header_size) {
      layout.notes.push_back(count_note(count, i));
      return;
    }
    const std::string user = file.text(at + 2, 16);
    const auto record = file.number<std::uint16_t>(at + 18);
    at += header_size;
    if (user == las::kSpecUser && record == las::kExtraBytesRecord) {
      add_extra_bytes(file, file.bytes(at, std::min(size, kMaxText)), header, layout);
    } else if (user == las::kProjectionUser && record == las::kWktRecord) {
      layout.crs_wkt = file.text(at, std::min(size, kMaxText));
      if (layout.crs_wkt.starts_with("GEOCCS")) note_geocentric(layout);
      units.wkt = units_of_wkt(layout.crs_wkt);
    } else if (user == las::kProjectionUser && record == las::kGeoKeysRecord) {
      read_geo_keys(file.bytes(at, std::min(size, kMaxText)), layout, units);
    } else if (user == las::kPlotscanUser && record == las::kStartRecord) {
      layout.start = parse_utc(file.text(at, std::min(size, kMaxText)));
    }
    at += size;
  }
}

}  // namespace

CloudLayout read_las_header(const std::filesystem::path& path) {
  LasFile file(path);
  const LasHeader header = read_header(file);
  CloudLayout layout;
  layout.body = header.compressed ? CloudBody::laz : CloudBody::binary;
  layout.is_las = true;
  layout.point_format = header.format;
  layout.format = fmt::format("{} 1.{}, point format {}", header.compressed ? "LAZ" : "LAS",
                              header.minor, header.format);
  layout.points = header.points;
  layout.record_size = header.record_size;
  layout.body_offset = header.points_at;
  layout.adjusted_gps_time = (file.number<std::uint16_t>(6) & las::kAdjustedGpsTime) != 0;
  add_coordinates(file, layout);
  add_format_fields(header.format, layout);
  StatedUnits units;
  read_records(file, {header.size, file.number<std::uint32_t>(100), false}, header, layout, units);
  if (header.minor >= 4) {
    const auto count = file.number<std::uint32_t>(243);
    if (count > 0)
      read_records(file, {file.number<std::uint64_t>(235), count, true}, header, layout, units);
  }
  layout.in_degrees =
      layout.crs_wkt.empty() ? units.keys_in_degrees : says_geographic(layout.crs_wkt);
  layout.units = units_of(units);
  note_unknown_unit(units, layout);
  return layout;
}

}  // namespace plotscan::scan
