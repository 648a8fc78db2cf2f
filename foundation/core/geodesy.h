// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include <Eigen/Core>

namespace plotscan {

// A place on WGS84: geodetic latitude and longitude, and the height above the ellipsoid.
struct GeodeticPoint {
  double latitude_deg = 0;
  double longitude_deg = 0;
  double altitude_m = 0;
};

// Where on Earth the world frame's origin lies; its x axis points east there, y north, z up.
using Anchor = GeodeticPoint;

// The world frame is the tangent frame at the anchor (east, north, up), without approximation
// (GeographicLib::LocalCartesian). Longitudes are within 180 degrees of the anchor's, so that a
// farm on the antimeridian stays in one piece.
GeodeticPoint geodetic_from_world(const Anchor& anchor, const Eigen::Vector3d& point);

// A zone of the Universal Transverse Mercator grid on WGS84.
struct UtmZone {
  int number = 0;  // 1 to 60
  bool north = true;

  int central_meridian_deg() const { return 6 * number - 183; }
};

// The zone of a place, with the exceptions of Norway and Svalbard. Throws InputError beyond 84
// degrees north and 80 south, where the grid ends.
UtmZone utm_zone(const GeodeticPoint& point);
// Easting, northing and height over the ellipsoid, metres.
Eigen::Vector3d utm_from_geodetic(const UtmZone& zone, const GeodeticPoint& point);
GeodeticPoint geodetic_from_utm(const UtmZone& zone, const Eigen::Vector3d& point);

// A coordinate system whose x and y are UTM eastings and northings.
struct UtmSystem {
  UtmZone zone;
  // "WGS 84", or a datum that is taken for it: its ellipsoid is the same to 0.1 mm, its places on
  // Earth differ by up to 2 m.
  std::string datum;
};

// The system that "EPSG:<code>" names: UTM on WGS 84, ETRS89, NAD83, NAD83(2011), GDA94 and GDA2020
// (codes as in PROJ's registry); absent for any other system.
std::optional<UtmSystem> utm_system(const std::string& crs);

// Whether "EPSG:<code>" is longitude and latitude on one of these datums.
bool is_geographic(const std::string& crs);

}  // namespace plotscan
