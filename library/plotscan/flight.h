// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "plotscan/error.h"
#include "plotscan/export.h"
#include "plotscan/progress.h"
#include "plotscan/settings.h"

namespace plotscan {

// Every setting there is: sensor, strips, wind, beam, pose errors.
PLOTSCAN_API std::vector<Setting> flight_settings();

struct FlightOptions {
  std::map<std::string, SettingValue> settings = {};     // by their keys
  std::optional<std::filesystem::path> trajectory = {};  // to fly in place of strips
  std::optional<std::filesystem::path> waypoints = {};   // to fly in place of strips, YAML
  std::vector<std::string> formats = {};  // ply, las, pcap, bag, mcap: written beside cloud.pcd
  std::vector<std::filesystem::path> resource_paths = {};  // of an SDF world's models
  std::uint64_t seed = 1;
  int threads = 0;       // 0: one for each processor; results are the same
  bool replace = false;  // a scan that is there
};

struct FlightSummary {
  std::uint64_t shots = 0;
  std::uint64_t points = 0;
  double duration_s = 0;                // of the flight
  std::vector<std::string> notes = {};  // what of an SDF world is not scanned, or why nothing is
};

// What `lidarsim fly` does: flies the drone over a farm folder or an SDF world and writes the scan
// folder (docs/scan-format.md). Throws BadInput on settings out of their range, a farm or world
// that does not hold, or a folder that exists, and leaves nothing behind then.
PLOTSCAN_API FlightSummary fly(const std::filesystem::path& place,
                               const std::filesystem::path& folder,
                               const FlightOptions& options = {}, const Progress& progress = {});

}  // namespace plotscan
