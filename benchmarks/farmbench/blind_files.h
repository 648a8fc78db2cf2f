// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cloud/cloud_map.h"

#include "farmbench/farm_scan.h"
#include "score/score.h"

// What entrants get of a farm, and nothing that tells the truth.
namespace plotscan::farmbench {

// Writes the points of a scan folder or a cloud without their labels, in the order of firing; of a
// survey, those inside. The extension says the format: .pcd or .las. Returns their number.
std::uint64_t write_blind_cloud(const std::filesystem::path& source,
                                const std::filesystem::path& cloud,
                                const std::optional<cloud::Area>& survey = std::nullopt);

// Writes boxes.csv and boxes.geojson: numbers and boxes of the plots that are scored, no more.
void write_boxes(const std::filesystem::path& folder, const std::vector<score::TruePlot>& plots);

// What of a field an export has.
struct BlindParts {
  std::vector<std::string> formats = {"pcd"};  // pcd, las, pcap
  bool boxes = false;                          // write_boxes
};

// Throws InputError on a format that is none of them, or is named twice, where none is of a cloud,
// on pcap of a suite whose sensor sends no Velodyne packets, or where lidarsim was built without
// it.
void require_parts(const BlindParts& parts, const Suite& suite);

// Writes what entrants get of a farm that was made and flown at `place` into an existing folder:
// its clouds, poses.csv as the drone reported it, sensor.yaml, flight.json. Returns the cloud's
// points.
std::uint64_t write_blind_files(const FarmPlace& place, const BlindParts& parts,
                                const std::filesystem::path& folder);

}  // namespace plotscan::farmbench
