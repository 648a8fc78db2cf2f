// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/coordinate_units.h"

namespace plotscan {

// What the recording of a sensor or a robot does not say by itself.
struct RecordingOptions {
  // Of the body, TUM text or trajectory.csv; its first pose is where the recording begins. A pcap
  // needs it, bags and MCAP files hold their own.
  std::optional<std::filesystem::path> trajectory = {};
  std::optional<std::string> sensor = {};  // name or file; else as the packets tell
  // The sensor in the body's frame, roll, pitch, yaw; else that of lidarsim fly.
  std::optional<Eigen::Vector3d> mount_rpy_deg = {};
  std::string topic = {};  // of the clouds, where there are several

  bool any() const { return trajectory || sensor || mount_rpy_deg || !topic.empty(); }
};

// A cloud as a user gives it: one file, or several that are read as one.
struct CloudFiles {
  std::vector<std::filesystem::path> files = {};
  // Of all files, where they are silent or wrong; else what they state, metres where they do not.
  std::optional<CoordinateUnits> units = {};
  // The coordinate system of all files, likewise: "EPSG:<code>" of UTM's metres (utm_system) or of
  // longitude and latitude (is_geographic).
  std::optional<std::string> crs = {};
  // Of recordings.
  RecordingOptions recording = {};
  // ASPRS classes of points to leave out, 0 to 255.
  std::vector<int> leave_out_classes = {};
  // ASPRS classes of the points to read, all others are left out; none: all classes are read.
  std::vector<int> only_classes = {};

  CloudFiles() = default;
  // A file is a cloud.
  CloudFiles(std::filesystem::path file);  // NOLINT(google-explicit-constructor)
  explicit CloudFiles(std::vector<std::filesystem::path> several);

  // For messages: "a.las", "a.las and 3 more".
  std::string name() const;
};

// The files behind what a user names: a file is itself, a scan folder its cloud.pcd, any other
// folder the clouds in it (.las, .laz, .pcd, .ply, .xyz, .asc, .pts) in the order of their names.
// Throws InputError on a path that is neither, a folder without clouds, and a file named twice.
std::vector<std::filesystem::path> cloud_files_of(const std::vector<std::filesystem::path>& paths);

}  // namespace plotscan
