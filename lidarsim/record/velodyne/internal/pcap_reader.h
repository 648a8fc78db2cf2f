// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "core/utc_time.h"
#include "record/velodyne/internal/decoder.h"
#include "record/velodyne/packet.h"
#include "scan/point.h"
#include "sensor/sensor.h"

namespace plotscan::record {

// What the first data packet of a recording states.
struct PcapInfo {
  DataPacket first;
  // When its first firing was, which is time 0 of the points. The packet states the time past the
  // hour, the recorder's clock the hour. If the two clocks differ by more than a minute, the
  // recorder's time counts: a sensor without GPS counts from when it was switched on.
  UtcTime start;
};

// Reads up to the first data packet of a pcap or pcapng file. Throws InputError as read_pcap does.
PcapInfo read_pcap_info(const std::filesystem::path& file);

// The shipped sensor that sends packets with this product byte. Throws InputError (naming the file)
// if there is none.
sensor::Sensor sensor_of_product(std::uint8_t product, const std::filesystem::path& file);

struct PcapSummary {
  std::uint64_t data_packets = 0;
  std::uint64_t position_packets = 0;
  std::uint64_t other_packets = 0;  // left out: of another kind, sensor or product, or out of order
  std::uint64_t points = 0;
};

// Streams the points of a recording of one Velodyne sensor, ours or a real one, in the order of
// firing. It is the sensor that sent the first data packet. Times count from that packet's first
// firing, and continue when the packets' times wrap at the hour. Points are in the world frame if a
// placement is given, else in the lidar frame. Throws InputError on a missing, foreign, truncated
// or empty recording, frames that were cut when recorded, packets of another product than the
// sensor's, and times that go back.
PcapSummary read_pcap(const std::filesystem::path& file, const sensor::Sensor& sensor,
                      const std::optional<Placement>& placement, const scan::PointSink& sink);

}  // namespace plotscan::record
