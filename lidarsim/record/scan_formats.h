// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/manifest.h"
#include "sensor/sensor.h"

namespace plotscan::record {

// Writes a scan folder's flight in further formats beside its cloud.pcd. A format is named by its
// extension without the dot: "ply" and "las" are written to cloud.EXTENSION, "pcap", "bag" and
// "mcap" to flight.EXTENSION. "pcd" is always there.

// All such names except "pcd", in the order of formats().
std::vector<std::string> further_formats();

// Throws InputError when a name is no format, or the format records packets that the sensor does
// not send.
void require_formats(const std::vector<std::string>& formats, const sensor::Sensor& sensor);

// Completes a scan folder that lacks only its manifest: writes the manifest, then the further
// formats, which need the whole folder; the manifest lists them too. Each is what convert() makes
// of the folder with its default options. Throws InputError as require_formats and convert do.
void finish_scan(const std::filesystem::path& scan_folder, const Manifest& manifest,
                 const std::vector<std::string>& formats);

}  // namespace plotscan::record
