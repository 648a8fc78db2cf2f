// SPDX-License-Identifier: Apache-2.0
#include "record/velodyne/internal/pcap_reader.h"

#include <array>
#include <cmath>
#include <memory>

#include <fmt/core.h>
#include <pcap/pcap.h>

#include "core/csv.h"
#include "core/error.h"
#include "record/velodyne/internal/close_pcap.h"
#include "record/velodyne/internal/ethernet.h"

namespace plotscan::record {
namespace {

using namespace std::chrono;

constexpr std::int64_t kHour_us = 3'600'000'000;
// A packet up to this late, which others overtook on the network, is left out; time that goes back
// further is an error.
constexpr std::int64_t kOvertaken_us = 1'000'000;

struct CapturedDatagram {
  UtcTime captured;
  UdpDatagram udp;
};

// The UDP datagrams of a pcap or pcapng file.
class DatagramFile {
 public:
  explicit DatagramFile(const std::filesystem::path& path) : path_(path) {
    require_file(path);
    std::array<char, PCAP_ERRBUF_SIZE> error{};
    pcap_.reset(pcap_open_offline(path.c_str(), error.data()));
    if (!pcap_) throw InputError(path, std::string("is no pcap recording: ") + error.data());
    kind_ = frame_kind();
  }

  // The next datagram, valid until the one after it is asked for; absent at the end.
  std::optional<CapturedDatagram> next() {
    pcap_pkthdr* header = nullptr;
    const u_char* frame = nullptr;
    while (true) {
      const int result = pcap_next_ex(pcap_.get(), &header, &frame);
      if (result == PCAP_ERROR_BREAK) return std::nullopt;
      if (result != 1) fail(pcap_geterr(pcap_.get()));
      ++frames_;
      if (header->caplen < header->len) {
        fail(fmt::format(
            "only {} of its {} bytes were recorded; record whole packets (tcpdump -s 0)",
            header->caplen, header->len));
      }
      const auto datagram = udp_datagram(kind_, {frame, header->caplen});
      if (datagram) return CapturedDatagram{.captured = time_of(*header), .udp = *datagram};
      ++foreign_;
    }
  }

  // How many frames carried no datagram.
  std::uint64_t foreign() const { return foreign_; }

  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(path_, fmt::format("packet {}: ", frames_) + what);
  }

 private:
  FrameKind frame_kind() const {
    switch (pcap_datalink(pcap_.get())) {
      case DLT_EN10MB:
        return FrameKind::ethernet;
      case DLT_LINUX_SLL:
        return FrameKind::linux_cooked;
      case DLT_LINUX_SLL2:
        return FrameKind::linux_cooked_2;
      case DLT_RAW:
      case DLT_IPV4:
        return FrameKind::ip;
      default:
        break;
    }
    const char* link = pcap_datalink_val_to_description(pcap_datalink(pcap_.get()));
    throw InputError(path_,
                     "was recorded on a link of type {} ({}); Ethernet, Linux cooked and raw "
                     "IPv4 are read",
                     pcap_datalink(pcap_.get()), link != nullptr ? link : "unknown");
  }

  // libpcap converts the file's time stamps to microseconds.
  UtcTime time_of(const pcap_pkthdr& header) const {
    constexpr std::int64_t kMost_s = 0xffffffff;  // of a pcap; pcapng may state any time
    if (header.ts.tv_sec < 0 || header.ts.tv_sec > kMost_s)
      fail("its time lies outside of the years 1970 to 2106");
    return UtcTime(seconds(header.ts.tv_sec) + microseconds(header.ts.tv_usec));
  }

  std::filesystem::path path_;
  std::unique_ptr<pcap_t, ClosePcap> pcap_;
  FrameKind kind_ = FrameKind::ethernet;
  std::uint64_t frames_ = 0;
  std::uint64_t foreign_ = 0;
};

// Time since the first packet, from the packets' times past the hour. The hours come from the
// recorder's clock, so that a pause of more than an hour is counted as well.
class HourClock {
 public:
  std::int64_t elapsed_us(std::uint32_t past_hour_us, UtcTime captured) {
    if (is_started_) {
      const std::int64_t step_us = std::int64_t{past_hour_us} - past_hour_us_;
      const std::int64_t waited_us = (captured - captured_).count();
      const auto hours = std::llround(static_cast<double>(waited_us - step_us) / kHour_us);
      elapsed_us_ += step_us + hours * kHour_us;
    }
    is_started_ = true;
    past_hour_us_ = past_hour_us;
    captured_ = captured;
    return elapsed_us_;
  }

 private:
  bool is_started_ = false;
  std::uint32_t past_hour_us_ = 0;
  UtcTime captured_;
  std::int64_t elapsed_us_ = 0;
};

UtcTime start_of(std::uint32_t past_hour_us, UtcTime captured) {
  const std::int64_t captured_us = captured.time_since_epoch().count();
  const auto hours = std::llround(static_cast<double>(captured_us - past_hour_us) / kHour_us);
  const UtcTime stated{microseconds(hours * kHour_us + past_hour_us)};
  return std::chrono::abs(stated - captured) <= minutes(1) ? stated : captured;
}

[[noreturn]] void fail_empty(const std::filesystem::path& file) {
  throw InputError(file,
                   "holds no data packets of a Velodyne VLP-16, Puck Hi-Res, VLP-32C or "
                   "HDL-32E");
}

// Turns data packets from one sensor into points, and counts everything else.
class Reader {
 public:
  Reader(const std::filesystem::path& file, const sensor::Sensor& sensor,
         const std::optional<Placement>& placement, const scan::PointSink& sink)
      : path_(file), file_(file), sensor_(sensor), decoder_(sensor, placement), sink_(sink) {}

  PcapSummary run() {
    while (const auto datagram = file_.next()) take(*datagram);
    if (summary_.data_packets == 0) fail_empty(path_);
    summary_.other_packets += file_.foreign();
    return summary_;
  }

 private:
  void take(const CapturedDatagram& datagram) {
    const auto packet = decode_data_packet(datagram.udp.payload);
    if (packet && is_from_sensor(datagram.udp)) {
      take(*packet, datagram.captured);
    } else if (!packet && decode_position_packet(datagram.udp.payload)) {
      ++summary_.position_packets;
    } else {
      ++summary_.other_packets;
    }
  }

  bool is_from_sensor(const UdpDatagram& udp) {
    const auto source = std::pair(udp.source_address, udp.destination_port);
    if (!source_) source_ = source;
    return source_ == source;
  }

  void take(const DataPacket& packet, UtcTime captured) {
    if (packet.product != sensor_.packets->product) {
      file_.fail(
          fmt::format("product 0x{:02X} is not the 0x{:02X} of sensor {}; --sensor names "
                      "the sensor that was flown",
                      packet.product, sensor_.packets->product, sensor_.name));
    }
    if (packet.past_hour_us >= kHour_us) file_.fail("its time is beyond the hour");
    const std::int64_t elapsed_us = clock_.elapsed_us(packet.past_hour_us, captured);
    if (elapsed_us < latest_us_ - kOvertaken_us) {
      file_.fail(fmt::format("its time goes back by {:.6f} s",
                             1e-6 * static_cast<double>(latest_us_ - elapsed_us)));
    }
    if (elapsed_us < latest_us_) {
      ++summary_.other_packets;
      return;
    }
    latest_us_ = elapsed_us;
    ++summary_.data_packets;
    points_.clear();
    decoder_.decode(packet, 1e-6 * static_cast<double>(elapsed_us), points_);
    summary_.points += points_.size();
    sink_(points_);
  }

  std::filesystem::path path_;
  DatagramFile file_;
  const sensor::Sensor& sensor_;
  VelodyneDecoder decoder_;
  const scan::PointSink& sink_;
  std::optional<std::pair<std::uint32_t, std::uint16_t>> source_;  // address, port
  HourClock clock_;
  std::int64_t latest_us_ = 0;
  std::vector<scan::LabelledPoint> points_;
  PcapSummary summary_;
};

}  // namespace

PcapInfo read_pcap_info(const std::filesystem::path& path) {
  DatagramFile file(path);
  while (const auto datagram = file.next()) {
    const auto packet = decode_data_packet(datagram->udp.payload);
    if (!packet) continue;
    return {.first = *packet, .start = start_of(packet->past_hour_us, datagram->captured)};
  }
  fail_empty(path);
}

sensor::Sensor sensor_of_product(std::uint8_t product, const std::filesystem::path& file) {
  for (const std::string& name : sensor::sensor_names()) {
    sensor::Sensor sensor = sensor::load_sensor(name);
    if (sensor.packets && sensor.packets->product == product) return sensor;
  }
  throw InputError(file,
                   "was recorded by product 0x{:02X}, which no shipped sensor is; "
                   "--sensor FILE.yaml with --trajectory reads it",
                   product);
}

PcapSummary read_pcap(const std::filesystem::path& file, const sensor::Sensor& sensor,
                      const std::optional<Placement>& placement, const scan::PointSink& sink) {
  if (!sensor.packets) throw InputError("sensor " + sensor.name + " sends no Velodyne packets");
  return Reader(file, sensor, placement, sink).run();
}

}  // namespace plotscan::record
