// SPDX-License-Identifier: Apache-2.0
#include "record/internal/las_file.h"

#include "core/error.h"
#include "core/geodesy.h"
#include "scan/cloud_system.h"
#include "scan/las_crs.h"
#include "scan/las_writer.h"
#ifdef PLOTSCAN_HAVE_LASZIP
#include "scan/laz_writer.h"
#endif
#include "scan/scan_angles.h"

namespace plotscan::record {
namespace {

constexpr double kOffsetStep_m = 1000;

void place_in_utm(const Source& source, const std::filesystem::path& file, scan::LasOptions& las) {
  if (!source.flight || !source.flight->anchor) {
    throw InputError(file,
                     "--crs utm needs the farm's place on Earth: the scan folder of a farm "
                     "whose description has an anchor");
  }
  const Anchor anchor = *source.flight->anchor;
  const UtmZone zone = utm_zone(anchor);
  las.crs_wkt = scan::utm_crs_wkt(zone);
  las.offset_m = (utm_from_geodetic(zone, anchor) / kOffsetStep_m).array().round() * kOffsetStep_m;
  las.coordinates = [=](const scan::LabelledPoint& point) {
    return utm_from_geodetic(zone, geodetic_from_world(anchor, {point.x, point.y, point.z}));
  };
}

// Of a cloud that states no system: a scan of ours is in the world frame, and where that of others
// lies nobody knows.
std::string local_system_of(const Source& source) {
  return source.of_scan_folder ? scan::local_crs_wkt() : scan::coded_crs_wkt(0, {});
}

// Clouds of others keep their system.
void require_local(const Source& source, const std::filesystem::path& file) {
  const std::string& stated = source.info.crs_wkt;
  if (stated.empty() || stated == scan::local_crs_wkt() || stated == scan::coded_crs_wkt(0, {}))
    return;
  throw InputError(
      file, "--crs local is for clouds that state no system; this one states {}, which is kept",
      scan::crs_name(scan::short_crs(stated)));
}

scan::LasOptions las_options(const std::filesystem::path& file, const Source& source,
                             const WriteOptions& options) {
  scan::LasOptions las{.start = source.info.start, .crs_wkt = source.info.crs_wkt};
  if (las.crs_wkt.empty()) las.crs_wkt = local_system_of(source);
  las.offset_m = source.info.origin_m;
  if (source.flight) {
    const FlightRecord& flight = *source.flight;
    las.start = flight.start;
    las.system = flight.sensor.title;
    const auto angles = std::make_shared<scan::ScanAngles>(flight.reported, flight.body_from_lidar);
    las.scan_angle_rad = [angles, &flight](const scan::LabelledPoint& point) {
      require_flown(flight, point.time);
      return angles->angle_rad(point);
    };
  }
  las.labels = options.labels;
  if (options.crs == "local") require_local(source, file);
  if (options.crs == "utm") place_in_utm(source, file, las);
  return las;
}

}  // namespace

std::unique_ptr<scan::PointWriter> create_las(const std::filesystem::path& file,
                                              const Source& source, const WriteOptions& options) {
  return std::make_unique<scan::LasWriter>(file, las_options(file, source, options));
}

#ifdef PLOTSCAN_HAVE_LASZIP
std::unique_ptr<scan::PointWriter> create_laz(const std::filesystem::path& file,
                                              const Source& source, const WriteOptions& options) {
  return std::make_unique<scan::LazWriter>(file, las_options(file, source, options));
}
#endif

}  // namespace plotscan::record
