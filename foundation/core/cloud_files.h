// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/coordinate_units.h"

namespace plotscan {

// A cloud as a user gives it: one file, or several that are read as one.
struct CloudFiles {
  std::vector<std::filesystem::path> files = {};
  // Of all files, where they are silent or wrong; else what they state, metres where they do not.
  std::optional<CoordinateUnits> units = {};
  // ASPRS classes of points to leave out, 0 to 255.
  std::vector<int> leave_out_classes = {};

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
