// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/coordinate_units.h"

namespace plotscan {

// What the user adds to a recording of a sensor or a robot that does not say it by itself.
struct RecordingOptions {
  // The body's trajectory (TUM or trajectory.csv), at whose first pose the recording begins. A pcap
  // needs it; bags and MCAP files hold their own.
  std::optional<std::filesystem::path> trajectory = {};
  std::optional<std::string> sensor = {};  // its name or file; absent: as the packets tell
  // The sensor's mount in the body's frame: roll, pitch, yaw. Absent: that of lidarsim fly.
  std::optional<Eigen::Vector3d> mount_rpy_deg = {};
  std::string topic = {};  // which topic holds the clouds, where several do

  bool any() const { return trajectory || sensor || mount_rpy_deg || !topic.empty(); }
};

// A cloud as a user names it: one file, or several files that are read as one cloud.
struct CloudFiles {
  std::vector<std::filesystem::path> files = {};
  // The units of all files, if these state none or wrong ones. Absent: those stated, else metres.
  std::optional<CoordinateUnits> units = {};
  // The coordinate system of all files, given for the same reasons: "EPSG:<code>" of UTM's metres
  // (utm_system) or of longitude and latitude (is_geographic).
  std::optional<std::string> crs = {};
  // Only for recordings.
  RecordingOptions recording = {};
  // ASPRS classes of points to leave out, 0 to 255.
  std::vector<int> leave_out_classes = {};
  // ASPRS classes of the points to read, all others are left out; empty: all classes are read.
  std::vector<int> only_classes = {};

  CloudFiles() = default;
  // Implicit: a file alone is a cloud.
  CloudFiles(std::filesystem::path file);  // NOLINT(google-explicit-constructor)
  explicit CloudFiles(std::vector<std::filesystem::path> several);

  // For messages: "a.las", "a.las and 3 more".
  std::string name() const;
};

// The files that the user's paths stand for: a file for itself, a scan folder for its cloud.pcd,
// any other folder for the clouds in it (.las, .laz, .pcd, .ply, .xyz, .asc, .pts) in the order of
// their names. Throws InputError on a path that is no file and no folder, a folder without clouds,
// and a file named twice.
std::vector<std::filesystem::path> cloud_files_of(const std::vector<std::filesystem::path>& paths);

}  // namespace plotscan
