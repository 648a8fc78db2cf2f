// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/manifest.h"
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

// Writes the manifest of a scan folder that lacks nothing else, and the further formats, which are
// made of the whole folder and are listed in the manifest, too. Throws as write_formats does.
void finish_scan(const std::filesystem::path& scan_folder, const Manifest& manifest,
                 const std::vector<std::string>& formats);

}  // namespace plotscan::record
