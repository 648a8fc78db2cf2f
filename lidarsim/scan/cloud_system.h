// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/cloud_files.h"
#include "core/coordinate_units.h"
#include "core/geodesy.h"
#include "core/utc_time.h"

namespace plotscan::scan {

// The coordinate system of a cloud's files, and how their coordinates become metres.
struct CloudSystem {
  // The system of the file, or of `zone` if set: "EPSG:<code>", or well-known text that names no
  // code; "" if the file names none.
  std::string crs = {};
  CoordinateUnits units = {};  // of the file; for degrees, only that of z counts
  // Set if the file has WGS 84 longitudes and latitudes: the zone they are projected to.
  std::optional<UtmZone> zone = {};
  // When the points of the first file begin, if it says so (as CloudInfo::start).
  std::optional<UtcTime> start = {};
  // What to tell the user about how the file is read, one sentence each.
  std::vector<std::string> notes = {};

  // A point of the file in metres, z up. NaN if its degrees are too far from the zone.
  Eigen::Vector3d metres_of(const Eigen::Vector3d& point) const;
};

// The system by the files' headers and first points, overridden by the user's CloudFiles; the zone
// is the first file's. Throws InputError on a missing, foreign or empty cloud, on degrees that are
// no place on Earth with a UTM zone, on files that state other systems or units than the first, on
// an unknown system of the user's, and when the first point is out of that system's range.
CloudSystem read_cloud_system(const CloudFiles& cloud);

// The system of positions in metres whose file states none: the user's, checked against a first
// position if there is one. Throws InputError as above; messages call the file `name`.
CloudSystem users_system(const CloudFiles& cloud, const std::filesystem::path& name,
                         const std::optional<Eigen::Vector3d>& first);

// A system's name for people: a code as it is, or the name that well-known text begins with.
std::string crs_name(const std::string& crs);

}  // namespace plotscan::scan
