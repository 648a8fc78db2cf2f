// SPDX-License-Identifier: Apache-2.0
#include "scan/las_writer.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "core/angle.h"
#include "core/bytes.h"
#include "core/error.h"
#include "core/manifest.h"
#include "scan/internal/las_format.h"

namespace plotscan::scan {
namespace {

constexpr double kStep_m = 1e-4;
constexpr int kPointFormat = 6;
constexpr std::size_t kRing = 2;
constexpr std::size_t kLabels = 4 + 4 + 1;
constexpr std::size_t kLargestRecord = las::kFormatSizes[kPointFormat] + kRing + kLabels;
constexpr double kScanAngleStep_rad = radians(0.006);
constexpr std::uint16_t kFlightLine = 1;
constexpr int kMaxReturns = 15;

// ASPRS' standard class. Weeds are vegetation too: the extra byte `class` tells them from the crop.
std::uint8_t asprs_class(PointClass label) {
  switch (label) {
    case PointClass::unlabelled:
      return 0;
    case PointClass::ground:
      return 2;
    case PointClass::crop:
    case PointClass::weed:
      return 3;
    case PointClass::other:
      break;
  }
  return 1;
}

std::string vlr(std::string_view user, std::uint16_t record, std::string_view description,
                const std::string& data) {
  if (data.size() > std::numeric_limits<std::uint16_t>::max()) {
    throw InputError("the text of the coordinate system has " + std::to_string(data.size()) +
                     " bytes; a record of a LAS file takes 65535");
  }
  ByteWriter bytes;
  bytes.put<std::uint16_t>(0).put_field(user, 16).put(record);
  bytes.put(static_cast<std::uint16_t>(data.size())).put_field(description, 32);
  return bytes.take() + data;
}

std::string extra_byte(std::uint8_t type, std::string_view name, std::string_view description) {
  ByteWriter bytes;
  bytes.put<std::uint16_t>(0).put(type).put<std::uint8_t>(0).put_field(name, 32);
  bytes.put_field("", 124).put_field(description, 32);
  return bytes.take();
}

std::string extra_bytes(bool labels) {
  constexpr std::uint8_t kUnsigned8 = 1;
  constexpr std::uint8_t kUnsigned16 = 3;
  constexpr std::uint8_t kUnsigned32 = 5;
  std::string ring = extra_byte(kUnsigned16, "ring", "laser by elevation, 0 lowest");
  if (!labels) return ring;
  return ring + extra_byte(kUnsigned32, "plot", "plot id, 0 none") +
         extra_byte(kUnsigned32, "plant", "plant id, 0 none") +
         extra_byte(kUnsigned8, "class", "1 ground 2 crop 3 weed 4 other");
}

std::string records_of(const LasOptions& options) {
  std::string records =
      vlr(las::kSpecUser, las::kExtraBytesRecord, "Extra Bytes", extra_bytes(options.labels)) +
      vlr(las::kProjectionUser, las::kWktRecord, "OGC WKT", options.crs_wkt + '\0');
  if (options.start) {
    records += vlr(las::kPlotscanUser, las::kStartRecord, "UTC of the flight's start",
                   format_utc(*options.start) + '\0');
  }
  return records;
}

// Day of the year, from 1, and year; 0 if unknown. Today's date is not used: files of the same
// input would differ.
std::pair<std::uint16_t, std::uint16_t> creation_day(const std::optional<UtcTime>& start) {
  using namespace std::chrono;
  if (!start) return {0, 0};
  const sys_days day = floor<days>(*start);
  const year year_of = year_month_day(day).year();
  return {static_cast<std::uint16_t>((day - sys_days(year_of / January / 1)).count() + 1),
          static_cast<std::uint16_t>(static_cast<int>(year_of))};
}

}  // namespace

LasWriter::LasWriter(const std::filesystem::path& path, LasOptions options)
    : path_(path), options_(std::move(options)), records_(records_of(options_)), file_(path) {
  if (options_.start) gps_offset_s_ = gps_seconds(*options_.start) - las::kGpsTimeAdjustment_s;
  least_.fill(std::numeric_limits<std::int32_t>::max());
  most_.fill(std::numeric_limits<std::int32_t>::min());
  file_.append(header());
  file_.append(records_);
  file_.flush();
}

void LasWriter::write(std::span<const LabelledPoint> points) {
  for (const LabelledPoint& point : points) {
    pack(point, file_.room(kLargestRecord));
    file_.used(record_size());
    ++points_;
  }
}

std::size_t LasWriter::record_size() const {
  return kLargestRecord - (options_.labels ? 0 : kLabels);
}

void LasWriter::close() { file_.close(header()); }

std::array<std::int32_t, 3> LasWriter::steps_of(const LabelledPoint& point) const {
  Eigen::Vector3d relative(point.x, point.y, point.z);
  if (options_.coordinates) relative = options_.coordinates(point) - options_.offset_m;
  std::array<std::int32_t, 3> steps{};
  for (int axis = 0; axis < 3; ++axis) {
    const double step = std::round(relative[axis] / kStep_m);
    if (!(std::abs(step) <= std::numeric_limits<std::int32_t>::max())) {
      const std::string which = "point " + std::to_string(points_ + 1);
      if (!std::isfinite(step))
        throw InputError(path_, which + " has no finite x, y and z, as each point of LAS has");
      throw InputError(path_,
                       "{} lies more than 214 km from the file's origin, which LAS cannot hold in "
                       "steps of 0.1 mm",
                       which);
    }
    steps[static_cast<std::size_t>(axis)] = static_cast<std::int32_t>(step);
  }
  return steps;
}

void LasWriter::pack(const LabelledPoint& point, char* record) {
  const auto put = [&record](const auto& value) {
    std::memcpy(record, &value, sizeof value);
    record += sizeof value;
  };
  const std::array<std::int32_t, 3> steps = steps_of(point);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    least_[axis] = std::min(least_[axis], steps[axis]);
    most_[axis] = std::max(most_[axis], steps[axis]);
  }
  const int number = std::clamp<int>(point.return_number, 1, kMaxReturns);
  const int count = std::clamp<int>(point.return_count, number, kMaxReturns);
  ++by_return_[static_cast<std::size_t>(number - 1)];
  const double angle_rad = options_.scan_angle_rad ? options_.scan_angle_rad(point) : 0;
  put(steps);
  put(static_cast<std::uint16_t>(
      std::lround(std::clamp<double>(point.intensity * las::kIntensityScale, 0, 0xFFFF))));
  put(static_cast<std::uint8_t>(number | count << 4));
  put(std::uint8_t{0});  // no flags, scanner channel 0
  put(asprs_class(options_.labels ? point.label : PointClass::unlabelled));
  put(std::uint8_t{0});  // user data
  put(static_cast<std::int16_t>(std::lround(angle_rad / kScanAngleStep_rad)));
  put(kFlightLine);
  put(gps_offset_s_ + point.time);
  put(point.ring);
  if (!options_.labels) return;
  put(point.plot);
  put(point.plant);
  put(static_cast<std::uint8_t>(point.label));
}

// The header by table 3 of the specification.
std::string LasWriter::header() const {
  const auto [day, year] = creation_day(options_.start);
  const std::uint16_t encoding =
      las::kWkt | (options_.start ? las::kAdjustedGpsTime : std::uint16_t{0});
  const std::uint32_t records = options_.start ? 3 : 2;
  ByteWriter bytes;
  bytes.put_field("LASF", 4).put(kFlightLine).put(encoding);
  bytes.put_field("", 16);  // no project id
  bytes.put<std::uint8_t>(1).put<std::uint8_t>(4);
  bytes.put_field(options_.system, 32).put_field("Plotscan " + version(), 32).put(day).put(year);
  bytes.put(static_cast<std::uint16_t>(las::kHeaderSize));
  bytes.put(static_cast<std::uint32_t>(las::kHeaderSize + records_.size())).put(records);
  bytes.put(static_cast<std::uint8_t>(kPointFormat)).put(static_cast<std::uint16_t>(record_size()));
  bytes.put_field("", 24);  // the legacy counts of older versions
  for (int axis = 0; axis < 3; ++axis) bytes.put(kStep_m);
  for (int axis = 0; axis < 3; ++axis) bytes.put(options_.offset_m[axis]);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double offset = options_.offset_m[static_cast<Eigen::Index>(axis)];
    bytes.put(points_ == 0 ? 0.0 : offset + most_[axis] * kStep_m);
    bytes.put(points_ == 0 ? 0.0 : offset + least_[axis] * kStep_m);
  }
  bytes.put_field("", 8 + 8 + 4);  // no waveforms, no extended records
  bytes.put(points_).put(by_return_);
  std::string header = bytes.take();
  check(header.size() == las::kHeaderSize, "the LAS header has its length");
  return header;
}

}  // namespace plotscan::scan
