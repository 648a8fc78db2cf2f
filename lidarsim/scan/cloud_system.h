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

// By the files' headers and first points, and what the user says against them (CloudFiles); the
// zone is the first file's. Throws InputError on a missing, foreign or empty cloud, on degrees that
// are no place on Earth with a UTM zone, on files that state other systems or units than the first,
// on a user's system that is unknown, and where the first point is out of its range.
CloudSystem read_cloud_system(const CloudFiles& cloud);

// Of positions in metres that no file says more of: the user's word, checked against `first`, one
// of them, where there is any. Throws InputError as above; `name` stands for them in messages.
CloudSystem told_system(const CloudFiles& cloud, const std::filesystem::path& name,
                        const std::optional<Eigen::Vector3d>& first);

// For people: a code as it is, of well-known text the name at its head.
std::string crs_name(const std::string& crs);

}  // namespace plotscan::scan
