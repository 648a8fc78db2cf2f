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

// What a cloud's file says beside its points, and what their numbers count from.
struct CloudInfo {
  std::uint64_t points = 0;  // that the header promises; 0 of text, which promises none
  // A point lies at origin_m + (x, y, z): points are floats, which do not hold coordinates of
  // hundreds of kilometres. Zero where the file's own coordinates are floats; else, in each
  // coordinate, the first finite point's rounded to whole kilometres.
  Eigen::Vector3d origin_m = Eigen::Vector3d::Zero();
  // When time 0 of the points was, where the file knows: LAS with adjusted GPS time. Where the file
  // is not of ours, the whole second at or before its first point.
  std::optional<UtcTime> start = {};
  std::string crs_wkt = {};  // the coordinate system, LAS only; "" where the file has none
  std::vector<std::string> fields = {};  // of LabelledPoint, by the names of docs/formats.md
};

// The origin that points near this one count from: in each coordinate its whole kilometres.
Eigen::Vector3d origin_near(const Eigen::Vector3d& point_m);

// Reads a cloud's header and the beginning of its points. Throws InputError as read_points does.
CloudInfo read_cloud_info(const std::filesystem::path& cloud);

// Streams the points of a PCD, PLY, LAS or text cloud with every field of LabelledPoint that the
// file has, relative to info.origin_m; the other fields keep their defaults. Which names and units
// are understood: docs/formats.md. Points that are not finite are left out. Throws InputError on a
// missing, foreign, truncated or empty cloud, and on a number that its field cannot hold.
CloudSummary read_points(const std::filesystem::path& cloud, const CloudInfo& info,
                         const PointSink& sink);

}  // namespace plotscan::scan
