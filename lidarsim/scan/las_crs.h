// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "core/coordinate_units.h"
#include "core/geodesy.h"

namespace plotscan::scan {

// Coordinate systems as well-known text (OGC 01-009), as LAS 1.4 needs them.

// The world frame of our own scans: east, north, up, metres, origin at the farm's centre.
std::string local_crs_wkt();

// WGS 84 / UTM in the zone, EPSG 326xx or 327xx, with heights over the ellipsoid.
std::string utm_crs_wkt(const UtmZone& zone);

// A system that is known by its EPSG code (0: none) and units alone. UTM on WGS 84 in metres is
// described whole; any other is a local system with the code as its name, since what the code
// stands for is not known here.
std::string coded_crs_wkt(int epsg, const CoordinateUnits& units);

// "EPSG:<code>" of the projected system that the text (WKT 1 or 2) describes, if it names the code;
// else the text itself.
std::string short_crs(const std::string& wkt);

// Metres in one unit of x and y, and of z, if well-known text states them.
struct WktUnits {
  std::optional<double> horizontal_m = {};
  std::optional<double> vertical_m = {};
};

// The units of a projected, geocentric or local system, and of its heights. Empty if the text is
// broken.
WktUnits units_of_wkt(const std::string& wkt);

}  // namespace plotscan::scan
