// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include <Eigen/Core>

#include "record/formats.h"

namespace plotscan::record {

// What the user adds about the flight of a bare cloud or a pcap. All but the trajectory has the
// defaults of lidarsim fly.
struct FlightOptions {
  // The body's trajectory in the points' frame. For a cloud it is in the cloud's time; a recording
  // begins at its first pose.
  std::optional<std::filesystem::path> trajectory = {};
  // A name or file for sensor::load_sensor. Absent: the sensor that a recording's packets tell, or
  // vlp16.
  std::optional<std::string> sensor = {};
  std::optional<double> spin_hz = {};  // absent: the sensor's default
  Eigen::Vector3d mount_rpy_deg = {0, 90, 0};
  // When a cloud's time 0 was. Absent: as the cloud states; if it does not, the trajectory begins
  // at 2026-06-01T10:00:00Z. Recordings state it themselves.
  std::optional<std::string> start_utc = {};
};

struct SourceOptions {
  std::optional<FlightOptions> flight = {};  // only for a source that is no scan folder
  std::string topic = {};  // the topic of the clouds in a bag or MCAP file, if it has several
};

// The flight of a scan folder. Throws InputError on a broken folder, and on options, as it says all
// of it by itself.
FlightRecord scan_flight(const std::filesystem::path& folder, const SourceOptions& options);

// Opens a scan folder, a cloud or a recording, and reads what comes before its points. If its
// flight is known, the points' times count from the trajectory's first pose. Recordings are
// recognised by their extension, clouds by their content. Throws InputError on broken input, and on
// options that do not apply to it.
Source open_source(const std::filesystem::path& in, const SourceOptions& options);

}  // namespace plotscan::record
