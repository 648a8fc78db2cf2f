// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/progress.h"
#include "farm/farm.h"
#include "flight/pose_errors.h"
#include "flight/wind.h"
#include "lidar/flight_part.h"
#include "lidar/scene.h"
#include "lidar/site.h"
#include "lidar/sway.h"

namespace plotscan::lidar {

// How a farm or a world is flown and scanned.
struct FlyOptions {
  std::string sensor = "vlp16";       // a name or a file, as sensor::load_sensor takes it
  double altitude_m = 8.0;            // above the mean ground under the plots
  double speed_m_s = 2.0;             // along the strips
  double spacing_m = 6.0;             // between neighbouring strips
  std::string pattern = "lawnmower";  // or "crosshatch", "single": flight::Pattern
  // The strips' heading, counter-clockwise from east. Absent: along the longer side of the plots'
  // bounding rectangle.
  std::optional<double> heading_deg = {};
  // A waypoint file (docs/flight.md) in place of strips. Where it states no speed, speed_m_s holds.
  std::optional<std::filesystem::path> waypoints = {};
  // A trajectory (TUM, or a scan's trajectory.csv) in place of the planned path. Its first pose is
  // the flight's time 0.
  std::optional<std::filesystem::path> flight = {};
  // Its seed and height are replaced by those of this flight. By default there is no wind.
  flight::WindOptions wind = {};
  std::string wind_acts_on = "both";               // "both", "drone" or "plants"
  SwayOptions sway = {};                           // of a farm's plants in the wind
  std::string start_utc = "2026-06-01T10:00:00Z";  // of the flight's time 0
  std::optional<double> spin_hz = {};  // turns of the sensor a second; else its own default
  std::string spin_jitter = "sensor";  // as its file states it; "none": the head turns steadily
  double range_noise_m = 0.03;         // standard deviation of the range noise, 0 to 1
  int sub_rays = 1;                    // rays that stand for a beam, 1 (its axis) to 1024
  std::string returns = "strongest";   // which returns of a shot are kept: strongest, last or dual
  // body_from_lidar = Rz(yaw) Ry(pitch) Rx(roll) of this (roll, pitch, yaw). By default the spin
  // axis lies along the flight and azimuth 0 points down.
  Eigen::Vector3d mount_rpy_deg = {0, 90, 0};
  std::string pose_error = "none";      // a preset's name
  flight::PoseErrors pose_errors = {};  // added to the preset's (flight::combined)
  // Formats of further files beside cloud.pcd, named as in record::finish_scan.
  std::vector<std::string> formats = {};
  FlightPart part = {};  // the part that is scanned; record::join_scans joins the parts
  std::uint64_t seed = 1;
  int threads = 1;
  std::vector<std::filesystem::path> inputs = {};  // files read, for the manifest
  bool replace = false;                            // an existing scan folder
};

struct FlySummary {
  std::uint64_t shots = 0;
  std::uint64_t points = 0;
  double duration_s = 0;   // of the whole flight
  double underground = 0;  // share of a given trajectory's poses that lie below the ground
};

// Scans the scene and writes the scan folder: cloud.pcd, trajectory.csv (true), poses.csv
// (reported), sensor.yaml, manifest.json, and the files of options.formats (docs/scan-format.md).
// The same scene, site and options give the same bytes, for any number of threads. Throws
// InputError on impossible options, a broken trajectory, or an existing folder that options.replace
// does not cover.
FlySummary fly(const Site& site, const Scene& scene, const std::filesystem::path& scan_folder,
               const FlyOptions& options, const ProgressReport& progress = {});

// The same for content whose plants sway if the wind acts on them.
FlySummary fly(const Site& site, const SceneContent& content,
               const std::filesystem::path& scan_folder, const FlyOptions& options,
               const ProgressReport& progress = {});

// The same for a farm. Also throws InputError when a plant names a missing model.
FlySummary fly(const farm::Farm& farm, const std::filesystem::path& scan_folder,
               const FlyOptions& options, const ProgressReport& progress = {});

}  // namespace plotscan::lidar
