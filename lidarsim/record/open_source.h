// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include <Eigen/Core>

#include "record/formats.h"

namespace plotscan::record {

// What a bare cloud or a pcap does not say of its flight; all but the trajectory has lidarsim fly's
// defaults.
struct FlightOptions {
  // Of the body, in the points' frame; in a cloud's time, while a recording begins at its first
  // pose.
  std::optional<std::filesystem::path> trajectory = {};
  // As sensor::load_sensor takes it; else the one that a recording's packets tell, or vlp16.
  std::optional<std::string> sensor = {};
  std::optional<double> spin_hz = {};  // else the sensor's own
  Eigen::Vector3d mount_rpy_deg = {0, 90, 0};
  // When a cloud's time 0 was; else as the cloud says; else the trajectory begins at
  // 2026-06-01T10:00:00Z. A recording says it by itself.
  std::optional<std::string> start_utc = {};
};

struct SourceOptions {
  std::optional<FlightOptions> flight = {};  // for a source that is no scan folder
  std::string topic = {};  // of the clouds in a bag or MCAP file, where there are several
};

// Opens a scan folder, a cloud or a recording, and reads what comes in front of its points. Where
// its flight is known, the points' times count from the trajectory's first pose.
// Recordings are known by their extension, clouds by their content. Throws InputError on broken
// input, and on options that mean nothing for it.
Source open_source(const std::filesystem::path& in, const SourceOptions& options);

}  // namespace plotscan::record
