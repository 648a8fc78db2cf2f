// SPDX-License-Identifier: Apache-2.0
#include "scan/cloud_system.h"

#include <cmath>
#include <limits>

#include "core/csv.h"
#include "core/error.h"
#include "core/text.h"
#include "scan/cloud_layout.h"

namespace plotscan::scan {
namespace {

// Points looked through for a finite one.
constexpr std::uint64_t kFirstPoints = 8192;
// UTM is exact to a millimetre this far from its meridian, and makes no sense much farther.
constexpr double kFarthest_deg = 12;

GeodeticPoint geodetic(const Eigen::Vector3d& lon_lat_z) {
  return {.latitude_deg = lon_lat_z.y(),
          .longitude_deg = std::remainder(lon_lat_z.x(), 360.0),
          .altitude_m = lon_lat_z.z()};
}

Eigen::Vector3d first_finite(const std::filesystem::path& cloud, const CloudLayout& layout) {
  const std::vector<ScalarField> fields = {*layout.find("x"), *layout.find("y"), *layout.find("z")};
  std::optional<Eigen::Vector3d> first;
  read_rows(
      cloud, layout, fields,
      [&](std::span<const double> rows) {
        for (std::size_t i = 0; i < rows.size() && !first; i += 3) {
          const Eigen::Vector3d point(rows[i], rows[i + 1], rows[i + 2]);
          if (point.allFinite()) first = point;
        }
      },
      kFirstPoints);
  if (!first) throw InputError(cloud, "none of its first points has finite x, y and z");
  return *first;
}

void project(const std::filesystem::path& cloud, const CloudLayout& layout, CloudSystem& system) {
  const Eigen::Vector3d first = first_finite(cloud, layout);
  if (std::abs(first.x()) > 360 || first.y() < -80 || first.y() > 84) {
    throw InputError(cloud, "says that x and y are degrees, but its first point has longitude " +
                                format_number(first.x()) + ", latitude " +
                                format_number(first.y()) +
                                "; --units m, ft or us-ft says what they are");
  }
  system.units.horizontal_m = 1;
  system.zone = utm_zone(geodetic(first));
  system.crs = formatted("EPSG:%d", (system.zone->north ? 32600 : 32700) + system.zone->number);
  system.notes.push_back(
      formatted("degrees are projected to WGS 84 / UTM zone %d%c, in metres; results are in it",
                system.zone->number, system.zone->north ? 'N' : 'S'));
}

void note_units(bool given, CloudSystem& system) {
  const CoordinateUnits& units = system.units;
  if (units == CoordinateUnits{}) return;
  const std::string what =
      units.horizontal_m == units.vertical_m
          ? unit_name(units.horizontal_m)
          : unit_name(units.horizontal_m) + " (z: " + unit_name(units.vertical_m) + ")";
  system.notes.push_back(what + " are read as metres, as " +
                         (given ? "--units says" : "the file states them") +
                         "; boxes and ground are written in the file's units");
}

}  // namespace

Eigen::Vector3d CloudSystem::metres_of(const Eigen::Vector3d& point) const {
  if (!zone) {
    return {point.x() * units.horizontal_m, point.y() * units.horizontal_m,
            point.z() * units.vertical_m};
  }
  const GeodeticPoint place = geodetic(point);
  const double from_meridian_deg =
      std::remainder(place.longitude_deg - zone->central_meridian_deg(), 360.0);
  if (!(std::abs(from_meridian_deg) < kFarthest_deg && std::abs(place.latitude_deg) < 90))
    return Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  Eigen::Vector3d projected = utm_from_geodetic(*zone, place);
  projected.z() *= units.vertical_m;
  return projected;
}

CloudSystem system_of(const std::filesystem::path& cloud, const CloudLayout& layout,
                      const std::optional<CoordinateUnits>& given) {
  CloudSystem system{
      .crs = layout.crs(), .units = given.value_or(layout.units), .notes = layout.notes};
  if (layout.in_degrees && !given) {
    project(cloud, layout, system);
  } else {
    note_units(given.has_value(), system);
  }
  return system;
}

CloudSystem read_cloud_system(const CloudFiles& cloud) {
  std::optional<CloudSystem> first;
  for (const std::filesystem::path& file : cloud.files) {
    const CloudSystem system = system_of(file, read_cloud_header(file), cloud.units);
    if (!first) {
      first = system;
      continue;
    }
    const bool same_place = first->zone ? system.zone.has_value() : system.crs == first->crs;
    if (!same_place || system.units != first->units) {
      throw InputError(file, "states another coordinate system or other units than " +
                                 cloud.files.front().string());
    }
  }
  check(first.has_value(), "a cloud has files");
  return *first;
}

}  // namespace plotscan::scan
