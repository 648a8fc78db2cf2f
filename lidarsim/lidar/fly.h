// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "core/progress.h"
#include "farm/farm.h"

namespace plotscan::lidar {

// How a farm is flown and scanned.
struct FlyOptions {
  std::string sensor = "vlp16";
  double altitude_m = 8.0;                      // over the mean terrain under the plots
  double speed_m_s = 2.0;                       // along the strips
  double spacing_m = 6.0;                       // between neighbouring strips
  std::optional<std::filesystem::path> flight;  // a TUM trajectory in place of the planned path
  double spin_hz = 10.0;        // turns of the sensor a second, 5 to 20 for the VLP-16
  double range_noise_m = 0.03;  // standard deviation of the range noise
  std::uint64_t seed = 1;
  int threads = 1;
};

struct FlySummary {
  std::uint64_t shots = 0;
  std::uint64_t points = 0;
  double duration_s = 0;  // of the flight
};

// Scans the farm and writes the scan folder: cloud.pcd, trajectory.csv, manifest.json
// (docs/formats.md). The same farm and options give the same bytes for any number of threads.
// Throws InputError on impossible options, a broken trajectory, or an existing folder that
// `replace` does not cover.
FlySummary fly(const farm::Farm& farm, const std::filesystem::path& scan_folder,
               const FlyOptions& options, bool replace, const ProgressReport& progress = {});

}  // namespace plotscan::lidar
