// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace plotscan::estimate {

// A coordinate system, "EPSG:<code>" or well-known text, as a .prj file has it: Esri's well-known
// text. `unit_m`: metres to one unit of the coordinates. "" for "", where GDAL does not know the
// system or it counts in other units, and in a build without GDAL.
std::string esri_wkt(const std::string& crs, double unit_m);

}  // namespace plotscan::estimate
