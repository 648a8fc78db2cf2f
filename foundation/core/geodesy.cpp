// SPDX-License-Identifier: Apache-2.0
#include "core/geodesy.h"

#include <cmath>

#include <GeographicLib/LocalCartesian.hpp>
#include <GeographicLib/TransverseMercator.hpp>
#include <GeographicLib/UTMUPS.hpp>

#include "core/csv.h"
#include "core/error.h"

namespace plotscan {
namespace {

GeographicLib::LocalCartesian frame_at(const Anchor& anchor) {
  return {anchor.latitude_deg, anchor.longitude_deg, anchor.altitude_m};
}

}  // namespace

GeodeticPoint geodetic_from_world(const Anchor& anchor, const Eigen::Vector3d& point) {
  GeodeticPoint geodetic;
  frame_at(anchor).Reverse(point.x(), point.y(), point.z(), geodetic.latitude_deg,
                           geodetic.longitude_deg, geodetic.altitude_m);
  geodetic.longitude_deg =
      anchor.longitude_deg + std::remainder(geodetic.longitude_deg - anchor.longitude_deg, 360.0);
  return geodetic;
}

Eigen::Vector3d world_from_geodetic(const Anchor& anchor, const GeodeticPoint& point) {
  Eigen::Vector3d world;
  frame_at(anchor).Forward(point.latitude_deg, point.longitude_deg, point.altitude_m, world.x(),
                           world.y(), world.z());
  return world;
}

UtmZone utm_zone(const GeodeticPoint& point) {
  const int number = GeographicLib::UTMUPS::StandardZone(point.latitude_deg, point.longitude_deg);
  if (number < GeographicLib::UTMUPS::MINUTMZONE) {
    throw InputError("latitude " + format_number(point.latitude_deg) +
                     " lies outside UTM, which reaches from 80 degrees south to 84 north");
  }
  return {.number = number, .north = point.latitude_deg >= 0};
}

Eigen::Vector3d utm_from_geodetic(const UtmZone& zone, const GeodeticPoint& point) {
  double east_m = 0;
  double north_m = 0;
  GeographicLib::TransverseMercator::UTM().Forward(zone.central_meridian_deg(), point.latitude_deg,
                                                   point.longitude_deg, east_m, north_m);
  return {5e5 + east_m, north_m + (zone.north ? 0 : 1e7), point.altitude_m};
}

}  // namespace plotscan
