// SPDX-License-Identifier: Apache-2.0
#include "scan/cloud_system.h"

#include <cmath>

#include <fmt/core.h>

#include "core/csv.h"
#include "core/error.h"
#include "core/statistics.h"
#include "scan/internal/cloud_layout.h"

namespace plotscan::scan {
namespace {

// Up to this distance from its meridian UTM is exact to a millimetre; much farther it is
// meaningless.
constexpr double kFarthest_deg = 12;

GeodeticPoint geodetic(const Eigen::Vector3d& lon_lat_z) {
  return {.latitude_deg = lon_lat_z.y(),
          .longitude_deg = std::remainder(lon_lat_z.x(), 360.0),
          .altitude_m = lon_lat_z.z()};
}

Eigen::Vector3d first_point(const std::filesystem::path& cloud, const CloudLayout& layout) {
  const auto first = first_finite(cloud, layout, layout.coordinates());
  if (!first) throw InputError(cloud, "none of its first points has finite x, y and z");
  return Eigen::Vector3d(first->data());
}

void project(const std::filesystem::path& cloud, const CloudLayout& layout, const CloudFiles& given,
             CloudSystem& system) {
  const Eigen::Vector3d first = first_point(cloud, layout);
  if (std::abs(first.x()) > 360 || first.y() < -80 || first.y() > 84) {
    throw InputError(cloud, "{}, but its first point has longitude {}, latitude {}{}",
                     std::string(given.crs ? "is in degrees, as --crs " + *given.crs + " says"
                                           : "says that x and y are degrees"),
                     format_number(first.x()), format_number(first.y()),
                     given.crs ? "" : "; --units says what they are");
  }
  system.units.horizontal_m = 1;
  system.zone = utm_zone(geodetic(first));
  system.crs = fmt::format("EPSG:{}", (system.zone->north ? 32600 : 32700) + system.zone->number);
  system.notes.push_back(
      fmt::format("degrees are projected to WGS 84 / UTM zone {}{}, in metres; results are in it",
                  system.zone->number, system.zone->north ? 'N' : 'S'));
}

// Throws InputError unless the user's system is known and counts in the units that the user says.
void require_known(const CloudFiles& given) {
  const std::string& crs = *given.crs;
  if (!utm_system(crs) && !is_geographic(crs)) {
    throw InputError("--crs " + crs +
                     ": known are UTM on WGS 84 (EPSG:32601 to 32660, 32701 to 32760), ETRS89, "
                     "NAD83, GDA94 and GDA2020, and longitude and latitude (EPSG:4326)");
  }
  if (!given.units || (utm_system(crs) && *given.units == CoordinateUnits{})) return;
  throw InputError("--crs " + crs + " counts in " + (is_geographic(crs) ? "degrees" : "metres") +
                   ", and --units says otherwise");
}

// UTM's eastings reach 333 km from 500 km at the equator; 400 km leaves room beyond a zone's edge.
void require_within_utm(const std::filesystem::path& name, const std::string& crs,
                        const Eigen::Vector3d& first) {
  constexpr double kLeastEasting_m = 1e5;
  constexpr double kMostEasting_m = 9e5;
  constexpr double kMostNorthing_m = 1e7;
  if (first.x() >= kLeastEasting_m && first.x() <= kMostEasting_m && first.y() >= 0 &&
      first.y() <= kMostNorthing_m)
    return;
  throw InputError(name,
                   "its first point, x {}, y {}, is no place of --crs {}: eastings are 100000 to "
                   "900000 m, northings 0 to 10000000 m",
                   format_number(first.x()), format_number(first.y()), crs);
}

// What the file states about x and y if that contradicts the user's word; else "".
std::string contradiction(const CloudLayout& layout, const std::string& crs) {
  const std::string stated = layout.crs();
  if (layout.in_degrees) return is_geographic(crs) ? "" : "degrees";
  if (!stated.empty()) return stated == crs ? "" : crs_name(stated);
  return layout.units.horizontal_m == 1 ? "" : unit_name(layout.units.horizontal_m);
}

void note_units(bool given, CloudSystem& system) {
  const CoordinateUnits& units = system.units;
  if (units == CoordinateUnits{}) return;
  const std::string what =
      units.horizontal_m == units.vertical_m
          ? unit_name(units.horizontal_m)
          : unit_name(units.horizontal_m) + " (z: " + unit_name(units.vertical_m) + ")";
  system.notes.push_back(what + " are converted to metres, as " +
                         (given ? "--units says" : "the file states them") +
                         "; boxes and ground are written in the file's units");
}

// The system that the user names, whatever the file states; only the unit of z may be the file's.
CloudSystem given_system(const std::filesystem::path& cloud, const CloudLayout& layout,
                         const CloudFiles& given) {
  CloudSystem system{.crs = *given.crs, .notes = layout.notes};
  system.units.vertical_m = given.units ? 1 : layout.units.vertical_m;
  const std::string stated = contradiction(layout, system.crs);
  if (!stated.empty())
    system.notes.push_back("the file states " + stated + "; its numbers are taken for " +
                           system.crs + ", as --crs says");
  if (is_geographic(system.crs)) {
    project(cloud, layout, given, system);
  } else {
    require_within_utm(cloud, system.crs, first_point(cloud, layout));
    note_units(false, system);
  }
  return system;
}

// Web Mercator (EPSG guidance note 7-2, "Popular Visualisation Pseudo Mercator") maps a sphere of
// this radius: at northing y its x and y are cosh(y/R) = 1/cos(latitude) times as long as the
// ground is.
void note_web_mercator(const std::filesystem::path& cloud, const CloudLayout& layout,
                       CloudSystem& system) {
  constexpr double kRadius_m = 6378137;
  if (system.crs != "EPSG:3857") return;
  system.notes.push_back(fmt::format(
      "EPSG:3857 (Web Mercator) stretches x and y, here {:.2f} times: plots come out as much "
      "too large; project the cloud first, for instance to UTM",
      std::cosh(first_point(cloud, layout).y() / kRadius_m)));
}

CloudSystem header_system(const std::filesystem::path& cloud, const CloudLayout& layout,
                          const CloudFiles& given) {
  CloudSystem system{
      .crs = layout.crs(), .units = given.units.value_or(layout.units), .notes = layout.notes};
  if (layout.in_degrees && !given.units) {
    project(cloud, layout, given, system);
  } else {
    note_units(given.units.has_value(), system);
    note_web_mercator(cloud, layout, system);
  }
  return system;
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
    return Eigen::Vector3d::Constant(kNaN);
  Eigen::Vector3d projected = utm_from_geodetic(*zone, place);
  projected.z() *= units.vertical_m;
  return projected;
}

std::string crs_name(const std::string& crs) {
  const std::size_t begin = crs.find('"');
  const std::size_t end = begin == std::string::npos ? begin : crs.find('"', begin + 1);
  return end == std::string::npos ? crs : crs.substr(begin + 1, end - begin - 1);
}

CloudSystem read_cloud_system(const CloudFiles& cloud) {
  if (cloud.crs) require_known(cloud);
  std::optional<CloudSystem> first;
  for (const std::filesystem::path& file : cloud.files) {
    const CloudLayout layout = read_cloud_header(file);
    const CloudSystem system = (cloud.crs ? given_system : header_system)(file, layout, cloud);
    if (!first) {
      first = system;
      first->start = start_time_of(file, layout);
      continue;
    }
    const bool in_degrees = system.zone.has_value();
    const bool same_place =
        in_degrees == first->zone.has_value() && (in_degrees || system.crs == first->crs);
    if (!same_place || system.units != first->units) {
      throw InputError(file, "states another coordinate system or other units than {}",
                       cloud.files.front().string());
    }
  }
  check(first.has_value(), "a cloud has files");
  return *first;
}

CloudSystem users_system(const CloudFiles& cloud, const std::filesystem::path& name,
                         const std::optional<Eigen::Vector3d>& first) {
  CloudSystem system{.units = cloud.units.value_or(CoordinateUnits{})};
  note_units(true, system);
  if (!cloud.crs) return system;
  require_known(cloud);
  if (is_geographic(*cloud.crs))
    throw InputError(name, "is a recording, in metres; --crs " + *cloud.crs + " counts in degrees");
  if (first) require_within_utm(name, *cloud.crs, *first);
  system.crs = *cloud.crs;
  return system;
}

}  // namespace plotscan::scan
