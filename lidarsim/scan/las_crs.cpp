// SPDX-License-Identifier: Apache-2.0
#include "scan/las_crs.h"

#include <cmath>

#include <fmt/core.h>

#include "core/coordinate_units.h"
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

}  // namespace

std::string local_crs_wkt() {
  return R"(LOCAL_CS["Plotscan world frame",LOCAL_DATUM["Centre of the farm",0],)"
         R"(UNIT["metre",1],AXIS["x",EAST],AXIS["y",NORTH],AXIS["z",UP]])";
}

std::string utm_crs_wkt(const UtmZone& zone) {
  const std::string name =
      fmt::format("WGS 84 / UTM zone {}{}", zone.number, zone.north ? 'N' : 'S');
  const int epsg = (zone.north ? 32600 : 32700) + zone.number;
  return R"(COMPD_CS[")" + name + R"( + ellipsoidal height",PROJCS[")" + name +
         R"(",GEOGCS["WGS 84",DATUM["WGS_1984",SPHEROID["WGS 84",6378137,298.257223563,)"
         R"(AUTHORITY["EPSG","7030"]],AUTHORITY["EPSG","6326"]],PRIMEM["Greenwich",0,)"
         R"(AUTHORITY["EPSG","8901"]],UNIT["degree",0.0174532925199433,)"
         R"(AUTHORITY["EPSG","9122"]],AUTHORITY["EPSG","4326"]],)"
         R"(PROJECTION["Transverse_Mercator"],PARAMETER["latitude_of_origin",0],)" +
         fmt::format(R"(PARAMETER["central_meridian",{}],)", zone.central_meridian_deg()) +
         R"(PARAMETER["scale_factor",0.9996],PARAMETER["false_easting",500000],)" +
         fmt::format(R"(PARAMETER["false_northing",{}],)", zone.north ? 0 : 10000000) +
         R"(UNIT["metre",1,AUTHORITY["EPSG","9001"]],AXIS["Easting",EAST],)" +
         fmt::format(R"(AXIS["Northing",NORTH],AUTHORITY["EPSG","{}"]],)", epsg) +
         R"(VERT_CS["WGS 84 ellipsoidal height",VERT_DATUM["Ellipsoid",2002],)"
         R"(UNIT["metre",1,AUTHORITY["EPSG","9001"]],AXIS["Up",UP]]])";
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
  return {.horizontal_m = unit_of(root->find({"PROJCS", "PROJCRS", "LOCAL_CS", "ENGCRS"})),
          .vertical_m = unit_of(root->find({"VERT_CS", "VERTCRS", "VERTICALCRS"}))};
}

}  // namespace plotscan::scan
