// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "plotscan/error.h"
#include "plotscan/export.h"
#include "plotscan/points.h"
#include "plotscan/progress.h"

namespace plotscan {

// One return of a sensor (docs/scan-format.md, cloud.pcd); what a file does not say keeps its
// default.
struct Point {
  float x = 0, y = 0, z = 0;       // from the cloud's origin_m, metres
  float intensity = 0;             // 0..255
  std::uint16_t ring = 0;          // laser by elevation, 0 the lowest
  double time = 0;                 // of the shot, seconds from take-off
  std::uint8_t return_number = 1;  // from 1, the nearest
  std::uint8_t return_count = 1;   // of the shot
  std::uint8_t label = 0;          // 0 unlabelled, 1 ground, 2 crop, 3 weed, 4 other
  std::uint32_t plot = 0;          // 0: none
  std::uint32_t plant = 0;         // 0: none

  bool operator==(const Point&) const = default;
};

// A cloud held in memory: 48 bytes a point.
struct Cloud {
  std::array<double, 3> origin_m = {};   // what the points' x, y, z count from
  std::vector<Point> points = {};        // in the order of the file
  std::vector<std::string> fields = {};  // of Point, that the file has
  std::string crs_wkt = {};              // coordinate system (LAS); "" where the file has none

  // Its positions, for estimate_field; valid while the points stay.
  PLOTSCAN_API PointsView positions() const;
};

// Reads a PCD, PLY, LAS or text cloud, a recording (pcap of ours, ROS bag, MCAP) or a scan folder
// (its cloud.pcd). Points that are not finite are left out. Throws BadInput on a missing, foreign,
// truncated or empty file.
PLOTSCAN_API Cloud read_cloud(const std::filesystem::path& file, const Progress& progress = {});

struct WriteCloudOptions {
  std::array<double, 3> origin_m = {};  // what the points' x, y, z count from
  std::string crs_wkt = {};             // coordinate system (LAS); "": local metres
  std::string encoding = {};            // one of the format's (docs/formats.md); "": its first
  bool replace = false;                 // a file that exists
};

// Writes points as PCD, PLY or LAS, by the extension of the file, which appears whole or not at
// all. Throws BadInput on an unknown extension or encoding, on one that needs a flight (pcap, bag,
// MCAP: convert_cloud writes these from scan folders), on an origin, time or intensity that is not
// finite, on a place that LAS cannot hold, and on a file that exists.
PLOTSCAN_API void write_cloud(const std::filesystem::path& file, std::span<const Point> points,
                              const WriteCloudOptions& options = {}, const Progress& progress = {});

struct ConvertCloudOptions {
  std::string encoding = {};  // as above
  std::string crs = {};       // LAS: "local" or "utm"; "": local
  std::string topic = {};     // of the clouds in a bag or MCAP file, where there are several
  bool replace = false;       // a file that exists
};

// Does what `lidarsim convert` does: converts a scan folder, cloud, recording or trajectory to the
// format that the extension of `out` names, without holding all points in memory. Returns how many
// points, or poses of a trajectory, were written. Throws BadInput on broken input, and where `out`
// needs what `in` does not say.
PLOTSCAN_API std::uint64_t convert_cloud(const std::filesystem::path& in,
                                         const std::filesystem::path& out,
                                         const ConvertCloudOptions& options = {},
                                         const Progress& progress = {});

}  // namespace plotscan
