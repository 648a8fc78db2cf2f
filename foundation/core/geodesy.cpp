// SPDX-License-Identifier: Apache-2.0
#include "core/geodesy.h"

#include <cmath>

#include <GeographicLib/LocalCartesian.hpp>

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

}  // namespace plotscan
