// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/progress.h"
#include "lidar/fly.h"

namespace plotscan::lidar {

struct FlyPlaceOptions {
  FlyOptions flight = {};
  std::vector<std::filesystem::path> resource_paths = {};  // searched first for a world's models
};

struct PlaceScan {
  FlySummary summary;
  std::vector<std::string> notes;  // what is not scanned, or why nothing is, a line each
};

// Scans a place by its path: a farm's folder, or the file of any SDF world or model, and writes the
// scan folder as fly does. Throws InputError as farmfolder::read_farm, gazebo::read_world and fly
// do, on a wind that would move neither the drone nor the plants, and on resource paths for a farm.
PlaceScan fly_place(const std::filesystem::path& place, const std::filesystem::path& scan_folder,
                    FlyPlaceOptions options, const ProgressReport& progress = {});

}  // namespace plotscan::lidar
