// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/utc_time.h"
#include "scan/cloud_reader.h"
#include "scan/point.h"

namespace plotscan::scan {

// What a cloud's file states besides its points, and the origins of their positions and times.
struct CloudInfo {
  std::uint64_t points = 0;  // as the header states; 0 for text, which states none
  // A point lies at origin_m + (x, y, z): its floats could not hold coordinates of hundreds of
  // kilometres exactly. Zero if the file's own coordinates are floats; else the first finite point,
  // each coordinate rounded to whole kilometres.
  Eigen::Vector3d origin_m = Eigen::Vector3d::Zero();
  // When the points' time 0 was, if the file states it (LAS with adjusted GPS time). For files not
  // written by Plotscan, the whole second at or before the first point.
  std::optional<UtcTime> start = {};
  // The coordinate system, LAS only; "" where the file has none. GeoTIFF keys are put as text.
  std::string crs_wkt = {};
  std::vector<std::string> fields = {};  // those of LabelledPoint, named as in docs/formats.md
};

// The origin that points near this one count from: each coordinate rounded to whole kilometres.
Eigen::Vector3d origin_near(const Eigen::Vector3d& point_m);

// Reads a cloud's header and the beginning of its points. Throws InputError as read_points does,
// and on coordinates in degrees, which floats cannot hold.
CloudInfo read_cloud_info(const std::filesystem::path& cloud);

// Streams the points of a PCD, PLY, LAS or text cloud with every field of LabelledPoint that the
// file has, relative to info.origin_m; the other fields keep their defaults. docs/formats.md lists
// the names and units that are understood. Points that are not finite are left out. Throws
// InputError on a missing, foreign, truncated or empty cloud, and on a number that its field cannot
// hold.
CloudSummary read_points(const std::filesystem::path& cloud, const CloudInfo& info,
                         const PointSink& sink);

}  // namespace plotscan::scan
