// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cloud/area.h"
#include "farmbench/farm_scan.h"
#include "score/score.h"

// The files of a farm for entrants of a contest; they reveal nothing of the truth.
namespace plotscan::farmbench {

// Writes the points of a scan folder or a cloud without their labels, in the order of firing; for a
// survey only the points inside it. The extension gives the format: .pcd or .las. Returns the
// number of points.
std::uint64_t write_blind_cloud(const std::filesystem::path& source,
                                const std::filesystem::path& cloud,
                                const std::optional<cloud::Area>& survey = std::nullopt);

// Writes boxes.csv and boxes.geojson: numbers and boxes of the plots that are scored, no more.
void write_boxes(const std::filesystem::path& folder, const std::vector<score::TruePlot>& plots);

// The optional parts of a field's export.
struct BlindParts {
  std::vector<std::string> formats = {"pcd"};  // pcd, las, pcap
  bool boxes = false;                          // write_boxes
};

// Throws InputError on an unknown format, on one named twice, if no format is one of a cloud, and
// on pcap if the suite's sensor sends no Velodyne packets or lidarsim was built without pcap.
void require_parts(const BlindParts& parts, const Suite& suite);

// Writes the entrants' files of a farm, made and flown at `place`, into an existing folder: its
// clouds, poses.csv as the drone reported it, sensor.yaml, flight.json. Returns the cloud's points.
std::uint64_t write_blind_files(const FarmPlace& place, const BlindParts& parts,
                                const std::filesystem::path& folder);

}  // namespace plotscan::farmbench
