// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sensor/sensor.h"

namespace plotscan::record {

// A scan folder's flight in further formats beside its cloud.pcd, named by their extension without
// the dot: "ply" and "las" as cloud.EXTENSION, "pcap", "bag" and "mcap" as flight.EXTENSION; "pcd"
// is there anyway.

// What there is but "pcd", in the order of formats().
std::vector<std::string> further_formats();

// Throws InputError where one of them is no format, or records packets that the sensor does not
// send.
void require_formats(const std::vector<std::string>& formats, const sensor::Sensor& sensor);

// Writes the files: each is what convert() makes of the folder, by its defaults. Throws InputError
// as require_formats and convert do.
void write_formats(const std::vector<std::string>& formats,
                   const std::filesystem::path& scan_folder);

}  // namespace plotscan::record
