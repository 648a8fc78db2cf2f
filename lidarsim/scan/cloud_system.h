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

// The coordinates of a cloud's file, and how they become metres.
struct CloudSystem {
  // The coordinate system of the file, or of `zone`: "EPSG:<code>", or well-known text where that
  // names no code; "" where the file names none.
  std::string crs = {};
  CoordinateUnits units = {};  // of the file; of degrees, only that of z
  // The file has longitudes and latitudes on WGS 84, which are projected to this zone.
  std::optional<UtmZone> zone = {};
  // What the user should be told of how the file is read, a sentence each.
  std::vector<std::string> notes = {};

  // Of a point of the file, z up. Not finite where degrees lie nowhere near the zone.
  Eigen::Vector3d metres_of(const Eigen::Vector3d& point) const;
};

// By the files' headers and first points; the zone is the first file's. Throws InputError on a
// missing, foreign or empty cloud, on degrees that are no place on Earth with a UTM zone, and on
// files that state other systems or units than the first.
CloudSystem read_cloud_system(const CloudFiles& cloud);

}  // namespace plotscan::scan
