// SPDX-License-Identifier: Apache-2.0
#include "core/geodesy.h"

#include <array>
#include <cmath>

#include <GeographicLib/LocalCartesian.hpp>
#include <GeographicLib/TransverseMercator.hpp>
#include <GeographicLib/UTMUPS.hpp>
#include <fmt/core.h>

#include "core/contains.h"
#include "core/csv.h"
#include "core/error.h"
#include "core/parse.h"

namespace plotscan {
namespace {

constexpr double kFalseEasting_m = 5e5;

double false_northing_m(const UtmZone& zone) { return zone.north ? 0 : 1e7; }

// EPSG codes `first_code` and up are the zones `first_zone` to `last_zone` of a datum.
struct UtmCodes {
  const char* datum;
  bool north;
  int first_code;
  int first_zone;
  int last_zone;
};
constexpr std::array<UtmCodes, 7> kUtmCodes = {{{"WGS 84", true, 32601, 1, 60},
                                                {"WGS 84", false, 32701, 1, 60},
                                                {"ETRS89", true, 25828, 28, 38},
                                                {"NAD83", true, 26901, 1, 23},
                                                {"NAD83(2011)", true, 6330, 1, 19},
                                                {"GDA94", false, 28348, 48, 58},
                                                {"GDA2020", false, 7846, 46, 59}}};

}  // namespace

GeodeticPoint geodetic_from_world(const Anchor& anchor, const Eigen::Vector3d& point) {
  const GeographicLib::LocalCartesian frame(anchor.latitude_deg, anchor.longitude_deg,
                                            anchor.altitude_m);
  GeodeticPoint geodetic;
  frame.Reverse(point.x(), point.y(), point.z(), geodetic.latitude_deg, geodetic.longitude_deg,
                geodetic.altitude_m);
  geodetic.longitude_deg =
      anchor.longitude_deg + std::remainder(geodetic.longitude_deg - anchor.longitude_deg, 360.0);
  return geodetic;
}

UtmZone utm_zone(const GeodeticPoint& point) {
  const int number = GeographicLib::UTMUPS::StandardZone(point.latitude_deg, point.longitude_deg);
  if (number < GeographicLib::UTMUPS::MINUTMZONE) {
    throw InputError(
        fmt::format("latitude {} lies outside UTM, which reaches from 80 degrees south to 84 north",
                    format_number(point.latitude_deg)));
  }
  return {.number = number, .north = point.latitude_deg >= 0};
}

Eigen::Vector3d utm_from_geodetic(const UtmZone& zone, const GeodeticPoint& point) {
  double east_m = 0;
  double north_m = 0;
  GeographicLib::TransverseMercator::UTM().Forward(zone.central_meridian_deg(), point.latitude_deg,
                                                   point.longitude_deg, east_m, north_m);
  return {kFalseEasting_m + east_m, north_m + false_northing_m(zone), point.altitude_m};
}

GeodeticPoint geodetic_from_utm(const UtmZone& zone, const Eigen::Vector3d& point) {
  GeodeticPoint geodetic{.altitude_m = point.z()};
  GeographicLib::TransverseMercator::UTM().Reverse(
      zone.central_meridian_deg(), point.x() - kFalseEasting_m, point.y() - false_northing_m(zone),
      geodetic.latitude_deg, geodetic.longitude_deg);
  return geodetic;
}

std::optional<UtmSystem> utm_system(const std::string& crs) {
  constexpr std::string_view kPrefix = "EPSG:";
  if (!crs.starts_with(kPrefix)) return std::nullopt;
  const auto code = parsed<int>(std::string_view(crs).substr(kPrefix.size()));
  if (!code) return std::nullopt;
  for (const UtmCodes& codes : kUtmCodes) {
    const int zone = codes.first_zone + *code - codes.first_code;
    if (zone < codes.first_zone || zone > codes.last_zone) continue;
    return UtmSystem{.zone = {.number = zone, .north = codes.north}, .datum = codes.datum};
  }
  return std::nullopt;
}

bool is_geographic(const std::string& crs) {
  constexpr std::array kGeographic = {"EPSG:4326", "EPSG:4258", "EPSG:4269",
                                      "EPSG:6318", "EPSG:4283", "EPSG:7844"};
  return contains(kGeographic, crs);
}

}  // namespace plotscan
