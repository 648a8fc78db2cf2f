// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/cloud_files.h"
#include "core/coordinate_units.h"
#include "core/geodesy.h"

namespace plotscan::scan {

// The coordinate system of a cloud's files, and how their coordinates become metres.
struct CloudSystem {
  // The coordinate system of the file, or that of `zone` if it is set: "EPSG:<code>", or well-known
  // text that names no code; "" if the file names none.
  std::string crs = {};
  CoordinateUnits units = {};  // of the file; for degrees, only that of z counts
  // Set if the file has longitudes and latitudes on WGS 84: the zone to which they are projected.
  std::optional<UtmZone> zone = {};
  // What the user should be told about how the file is read, one sentence each.
  std::vector<std::string> notes = {};

  // The position, in metres with z up, of a point with the file's coordinates. NaN if degrees are
  // too far from the zone.
  Eigen::Vector3d metres_of(const Eigen::Vector3d& point) const;
};

// Determines it from the files' headers and first points; what the user says (CloudFiles) overrides
// them. The zone is that of the first file. Throws InputError on a missing, foreign or empty cloud,
// on degrees that are no place on Earth with a UTM zone, on files that state other systems or units
// than the first, on an unknown system of the user's, and when the first point is out of that
// system's range.
CloudSystem read_cloud_system(const CloudFiles& cloud);

// The system of positions in metres whose file states no system: what the user says, checked
// against one of the positions, `first`, if there is one. Throws InputError as above; messages call
// the file `name`.
CloudSystem told_system(const CloudFiles& cloud, const std::filesystem::path& name,
                        const std::optional<Eigen::Vector3d>& first);

// A system's name for people: an EPSG code as it is; for well-known text, the name at its
// beginning.
std::string crs_name(const std::string& crs);

}  // namespace plotscan::scan
