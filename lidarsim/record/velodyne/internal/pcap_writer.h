// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>

#include "record/recording/flight_record.h"
#include "scan/point.h"

namespace plotscan::record {

// Streams a flight's points to a pcap file as the sensor broadcast them: its data packets
// (VelodyneEncoder), and after every 14th a position packet, as often as the VLP-16 sends them
// (manual, section 9.3.3). A packet is captured when the sensor has completed it. Memory does not
// grow. Throws InputError when the sensor sends no Velodyne packets, and WriteError when the file
// cannot be created; its write() as VelodyneEncoder::write does.
std::unique_ptr<scan::PointWriter> create_pcap(const std::filesystem::path& path,
                                               const FlightRecord& flight);

}  // namespace plotscan::record
