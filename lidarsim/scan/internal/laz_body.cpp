// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstring>

#include "scan/internal/cloud_body.h"
#include "scan/internal/las_format.h"
#include "scan/internal/laszip_file.h"

namespace plotscan::scan {
namespace {

// A point as the bytes of its LAS record ("LAS Specification 1.4 - R15", tables 7 to 18). Colours
// and waveforms, which are not used here, stay 0.
class LasRecord {
 public:
  explicit LasRecord(const CloudLayout& layout)
      : format_(layout.point_format), bytes_(layout.record_size) {}

  const char* pack(const laszip_point_struct& point) {
    put(0, point.X);
    put(4, point.Y);
    put(8, point.Z);
    put(12, point.intensity);
    if (format_ >= las::kNewFormats) {
      pack_new(point);
    } else {
      pack_old(point);
    }
    const std::size_t extra = las::kFormatSizes[static_cast<std::size_t>(format_)];
    const auto count = std::min(static_cast<std::size_t>(std::max(0, point.num_extra_bytes)),
                                bytes_.size() - extra);
    if (count > 0) std::memcpy(bytes_.data() + extra, point.extra_bytes, count);
    return bytes_.data();
  }

 private:
  template <class T>
  void put(std::size_t offset, T value) {
    std::memcpy(bytes_.data() + offset, &value, sizeof value);
  }
  void pack_old(const laszip_point_struct& point) {
    put(14,
        static_cast<std::uint8_t>(point.return_number | point.number_of_returns << 3 |
                                  point.scan_direction_flag << 6 | point.edge_of_flight_line << 7));
    put(15, static_cast<std::uint8_t>(point.classification | point.synthetic_flag << 5 |
                                      point.keypoint_flag << 6 | point.withheld_flag << 7));
    put(16, point.scan_angle_rank);
    put(17, point.user_data);
    put(18, point.point_source_ID);
    if (format_ == 1 || format_ >= 3) put(20, point.gps_time);
  }
  void pack_new(const laszip_point_struct& point) {
    put(14, static_cast<std::uint8_t>(point.extended_return_number |
                                      point.extended_number_of_returns << 4));
    put(15, static_cast<std::uint8_t>(
                point.extended_classification_flags | point.extended_scanner_channel << 4 |
                point.scan_direction_flag << 6 | point.edge_of_flight_line << 7));
    put(16, point.extended_classification);
    put(17, point.user_data);
    put(18, point.extended_scan_angle);
    put(20, point.point_source_ID);
    put(22, point.gps_time);
  }

  int format_;
  std::vector<char> bytes_;
};

}  // namespace

void read_laz(const std::filesystem::path& file, const CloudLayout& layout, const Wanted& wanted) {
  const LaszipFile laszip(file);
  laszip_BOOL compressed = 0;
  laszip.require(laszip_open_reader(laszip.get(), file.c_str(), &compressed));
  const laszip_point_struct& point = laszip.point();
  LasRecord record(layout);
  Rows rows(wanted);
  for (std::uint64_t read = 0; read < wanted.points; ++read) {
    laszip.require(laszip_read_point(laszip.get()));
    const char* bytes = record.pack(point);
    for (const ScalarField& field : wanted.fields)
      rows.add(decode(field, bytes + field.offset, false));
    rows.end_row();
  }
  rows.flush();
  laszip.require(laszip_close_reader(laszip.get()));
}

}  // namespace plotscan::scan
