// SPDX-License-Identifier: Apache-2.0
#include "record/velodyne/pcap_format.h"

#include "record/velodyne/internal/pcap_reader.h"
#include "record/velodyne/internal/pcap_writer.h"

namespace plotscan::record {
namespace {

using std::filesystem::path;

Source open_pcap(const path& file, const ReadOptions& options) {
  const std::optional<FlightRecord>& flight = options.flight;
  const PcapInfo info = read_pcap_info(file);
  const sensor::Sensor sensor =
      flight && options.sensor_given ? flight->sensor : sensor_of_product(info.first.product, file);
  Source source{.path = file, .info = {}, .flight = flight, .stream = {}};
  source.info.start = info.start;
  source.info.fields = {"x",           "y", "z", "intensity", "ring", "time", "return_number",
                        "return_count"};
  std::optional<Placement> placement;
  if (flight) {
    source.flight->sensor = sensor;
    source.flight->start = info.start;
    source.flight->returns = info.first.mode;
    if (!options.spin_given) source.flight->spin_hz = spin_hz(info.first, sensor);
    source.info.origin_m = scan::origin_near(flight->reported.poses().front().position_m);
    placement = {.world_from_body = scan::moved(flight->reported, -source.info.origin_m),
                 .body_from_lidar = flight->body_from_lidar};
  }
  source.stream = [=](const scan::PointSink& sink) {
    const PcapSummary read = read_pcap(file, sensor, placement, sink);
    return scan::CloudSummary{.points = read.points};
  };
  return source;
}

}  // namespace

Format pcap_format() {
  return {.name = "Velodyne recording",
          .extensions = {".pcap"},
          .is_recording = true,
          .needs_flight = true,
          .needs_packets = true,
          .open = open_pcap,
          .create = [](const path& file, const Source& source, const WriteOptions&) {
            return create_pcap(file, *source.flight);
          }};
}

Format pcapng_format() {
  return {.name = "pcapng recording",
          .extensions = {".pcapng"},
          .is_recording = true,
          .open = open_pcap};
}

}  // namespace plotscan::record
