// SPDX-License-Identifier: Apache-2.0
#include "scan/las_crs.h"

#include <cmath>

#include <fmt/core.h>

#include "core/csv.h"
#include "core/parse.h"
#include "scan/internal/wkt.h"

namespace plotscan::scan {
namespace {

// The factor in UNIT["metre", 1] of a node or, as in WKT 2, of its axes.
std::optional<double> unit_of(const WktNode* node) {
  if (node == nullptr) return std::nullopt;
  for (const WktNode& child : node->children) {
    if (child.keyword == "AXIS" && unit_of(&child)) return unit_of(&child);
    if ((child.keyword != "UNIT" && child.keyword != "LENGTHUNIT") || child.values.size() < 2)
      continue;
    const auto unit_m = parsed<double>(child.values[1]);
    if (unit_m && *unit_m > 0 && std::isfinite(*unit_m)) return exact_unit(*unit_m);
  }
  return std::nullopt;
}

std::string utm_name(const UtmZone& zone) {
  return fmt::format("WGS 84 / UTM zone {}{}", zone.number, zone.north ? 'N' : 'S');
}

// Without heights.
std::string projected_utm_wkt(const UtmZone& zone) {
  const int epsg = (zone.north ? 32600 : 32700) + zone.number;
  return R"(PROJCS[")" + utm_name(zone) +
         R"(",GEOGCS["WGS 84",DATUM["WGS_1984",SPHEROID["WGS 84",6378137,298.257223563,)"
         R"(AUTHORITY["EPSG","7030"]],AUTHORITY["EPSG","6326"]],PRIMEM["Greenwich",0,)"
         R"(AUTHORITY["EPSG","8901"]],UNIT["degree",0.0174532925199433,)"
         R"(AUTHORITY["EPSG","9122"]],AUTHORITY["EPSG","4326"]],)"
         R"(PROJECTION["Transverse_Mercator"],PARAMETER["latitude_of_origin",0],)" +
         fmt::format(R"(PARAMETER["central_meridian",{}],)", zone.central_meridian_deg()) +
         R"(PARAMETER["scale_factor",0.9996],PARAMETER["false_easting",500000],)" +
         fmt::format(R"(PARAMETER["false_northing",{}],)", zone.north ? 0 : 10000000) +
         R"(UNIT["metre",1,AUTHORITY["EPSG","9001"]],AXIS["Easting",EAST],)" +
         fmt::format(R"(AXIS["Northing",NORTH],AUTHORITY["EPSG","{}"]])", epsg);
}

std::string unit_wkt(double unit_m) {
  const char* const name = unit_m == 1                 ? "metre"
                           : unit_m == kFoot_m         ? "foot"
                           : unit_m == kUsSurveyFoot_m ? "US survey foot"
                                                       : "unknown";
  return fmt::format(R"(UNIT["{}",{}])", name, format_number(unit_m));
}

}  // namespace

std::string local_crs_wkt() {
  return R"(LOCAL_CS["Plotscan world frame",LOCAL_DATUM["Centre of the farm",0],)"
         R"(UNIT["metre",1],AXIS["x",EAST],AXIS["y",NORTH],AXIS["z",UP]])";
}

std::string utm_crs_wkt(const UtmZone& zone) {
  return R"(COMPD_CS[")" + utm_name(zone) + R"( + ellipsoidal height",)" + projected_utm_wkt(zone) +
         R"(,VERT_CS["WGS 84 ellipsoidal height",VERT_DATUM["Ellipsoid",2002],)"
         R"(UNIT["metre",1,AUTHORITY["EPSG","9001"]],AXIS["Up",UP]]])";
}

std::string coded_crs_wkt(int epsg, const CoordinateUnits& units) {
  const std::string name = epsg == 0 ? "unknown" : "EPSG:" + std::to_string(epsg);
  const std::optional<UtmSystem> utm = utm_system(name);
  std::string level =
      utm && utm->datum == "WGS 84" && units.horizontal_m == 1
          ? projected_utm_wkt(utm->zone)
          : fmt::format(R"(LOCAL_CS["{}",LOCAL_DATUM["unknown",0],{},AXIS["x",EAST],)"
                        R"(AXIS["y",NORTH]])",
                        name, unit_wkt(units.horizontal_m));
  if (units.vertical_m == units.horizontal_m) return level;
  return fmt::format(R"(COMPD_CS["{} + height",{},VERT_CS["unknown",VERT_DATUM["unknown",2005],{},)"
                     R"(AXIS["Up",UP]]])",
                     name, level, unit_wkt(units.vertical_m));
}

std::string short_crs(const std::string& wkt) {
  const std::optional<WktNode> root = parse_wkt(wkt);
  const WktNode* projected = root ? root->find({"PROJCS", "PROJCRS"}) : nullptr;
  if (projected == nullptr) return wkt;
  for (const WktNode& child : projected->children) {
    const bool is_id = child.keyword == "AUTHORITY" || child.keyword == "ID";
    if (is_id && child.values.size() >= 2 && child.values[0] == "EPSG")
      return "EPSG:" + child.values[1];
  }
  return wkt;
}

WktUnits units_of_wkt(const std::string& wkt) {
  const std::optional<WktNode> root = parse_wkt(wkt);
  if (!root) return {};
  return {
      .horizontal_m = unit_of(root->find({"PROJCS", "PROJCRS", "GEOCCS", "LOCAL_CS", "ENGCRS"})),
      .vertical_m = unit_of(root->find({"VERT_CS", "VERTCRS", "VERTICALCRS"}))};
}

}  // namespace plotscan::scan
