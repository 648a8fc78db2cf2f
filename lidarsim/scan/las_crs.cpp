// SPDX-License-Identifier: Apache-2.0
#include "scan/las_crs.h"

#include <algorithm>
#include <string_view>

#include "core/text.h"

namespace plotscan::scan {
namespace {

// The digits that follow, in quotes or not.
std::string code_at(std::string_view text) {
  if (text.starts_with('"')) text.remove_prefix(1);
  return std::string(text.substr(0, text.find_first_not_of("0123456789")));
}

}  // namespace

std::string local_crs_wkt() {
  return R"(LOCAL_CS["Plotscan world frame",LOCAL_DATUM["Centre of the farm",0],)"
         R"(UNIT["metre",1],AXIS["x",EAST],AXIS["y",NORTH],AXIS["z",UP]])";
}

std::string utm_crs_wkt(const UtmZone& zone) {
  const std::string name = formatted("WGS 84 / UTM zone %d%c", zone.number, zone.north ? 'N' : 'S');
  const int epsg = (zone.north ? 32600 : 32700) + zone.number;
  return R"(COMPD_CS[")" + name + R"( + ellipsoidal height",PROJCS[")" + name +
         R"(",GEOGCS["WGS 84",DATUM["WGS_1984",SPHEROID["WGS 84",6378137,298.257223563,)"
         R"(AUTHORITY["EPSG","7030"]],AUTHORITY["EPSG","6326"]],PRIMEM["Greenwich",0,)"
         R"(AUTHORITY["EPSG","8901"]],UNIT["degree",0.0174532925199433,)"
         R"(AUTHORITY["EPSG","9122"]],AUTHORITY["EPSG","4326"]],)"
         R"(PROJECTION["Transverse_Mercator"],PARAMETER["latitude_of_origin",0],)" +
         formatted(R"(PARAMETER["central_meridian",%d],)", zone.central_meridian_deg()) +
         R"(PARAMETER["scale_factor",0.9996],PARAMETER["false_easting",500000],)" +
         formatted(R"(PARAMETER["false_northing",%d],)", zone.north ? 0 : 10000000) +
         R"(UNIT["metre",1,AUTHORITY["EPSG","9001"]],AXIS["Easting",EAST],)" +
         formatted(R"(AXIS["Northing",NORTH],AUTHORITY["EPSG","%d"]],)", epsg) +
         R"(VERT_CS["WGS 84 ellipsoidal height",VERT_DATUM["Ellipsoid",2002],)"
         R"(UNIT["metre",1,AUTHORITY["EPSG","9001"]],AXIS["Up",UP]]])";
}

std::string short_crs(const std::string& wkt) {
  const std::size_t start = std::min(wkt.find("PROJCS["), wkt.find("PROJCRS["));
  if (start == std::string::npos) return wkt;
  int depth = 0;
  bool quoted = false;
  for (std::size_t at = start; at < wkt.size(); ++at) {
    if (wkt[at] == '"') quoted = !quoted;
    if (quoted) continue;
    if (wkt[at] == '[') ++depth;
    if (wkt[at] == ']' && --depth == 0) break;
    if (depth != 1) continue;
    const std::string_view rest = std::string_view(wkt).substr(at);
    for (const std::string_view name : {R"(AUTHORITY["EPSG",)", R"(ID["EPSG",)"}) {
      const std::string code = rest.starts_with(name) ? code_at(rest.substr(name.size())) : "";
      if (!code.empty()) return "EPSG:" + code;
    }
  }
  return wkt;
}

}  // namespace plotscan::scan
