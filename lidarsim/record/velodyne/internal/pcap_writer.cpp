// SPDX-License-Identifier: Apache-2.0
#include "record/velodyne/internal/pcap_writer.h"

#include <cerrno>

#include <pcap/pcap.h>

#include "core/error.h"
#include "record/velodyne/encoder.h"
#include "record/velodyne/internal/close_pcap.h"
#include "record/velodyne/internal/ethernet.h"
#include "record/velodyne/internal/position_packets.h"

namespace plotscan::record {
namespace {

constexpr int kLongestFrame = 65'535;
constexpr std::uint64_t kDataPerPosition = 14;
// How long a data packet takes on the wire at 100 Mbit/s; a position packet is sent after it.
constexpr double kFrameTime_s = 1e-4;

// A pcap file of Ethernet frames stamped in microseconds.
class FrameFile {
 public:
  explicit FrameFile(const std::filesystem::path& path)
      : path_(path), pcap_(pcap_open_dead(DLT_EN10MB, kLongestFrame)) {
    errno = 0;
    file_.reset(pcap_dump_open(pcap_.get(), path.c_str()));
    if (!file_) fail();
  }

  void write(UtcTime captured, std::span<const std::uint8_t> frame) {
    const auto seconds = std::chrono::floor<std::chrono::seconds>(captured);
    pcap_pkthdr header{};
    header.ts.tv_sec = static_cast<time_t>(seconds.time_since_epoch().count());
    header.ts.tv_usec = static_cast<suseconds_t>((captured - seconds).count());
    header.caplen = header.len = static_cast<bpf_u_int32>(frame.size());
    errno = 0;
    pcap_dump(reinterpret_cast<u_char*>(file_.get()), &header, frame.data());  // NOLINT
    if (std::ferror(pcap_dump_file(file_.get())) != 0) fail();
  }

  void close() {
    errno = 0;
    if (pcap_dump_flush(file_.get()) != 0) fail();
    file_.reset();
  }

 private:
  [[noreturn]] void fail() const { throw WriteError(path_, errno != 0 ? errno : EIO); }

  std::filesystem::path path_;
  std::unique_ptr<pcap_t, ClosePcap> pcap_;
  std::unique_ptr<pcap_dumper_t, ClosePcap> file_;
};

class PcapWriter : public scan::PointWriter {
 public:
  PcapWriter(const std::filesystem::path& path, const FlightRecord& flight)
      : flight_(flight),
        encoder_(flight_, [this](const SentPacket& packet) { send(packet); }),
        file_(path) {}

  void write(std::span<const scan::LabelledPoint> points) override { encoder_.write(points); }

  void close() override {
    encoder_.close();
    file_.close();
  }

 private:
  void send(const SentPacket& packet) {
    file_.write(later(flight_.start, packet.sent_s),
                broadcast_frame(kDataPort, encode(packet.data)));
    if (sent_++ % kDataPerPosition != 0) return;
    file_.write(later(flight_.start, packet.sent_s + kFrameTime_s),
                broadcast_frame(kPositionPort, encode(position_packet(flight_, packet.sent_s))));
  }

  FlightRecord flight_;
  VelodyneEncoder encoder_;
  FrameFile file_;
  std::uint64_t sent_ = 0;
};

}  // namespace

std::unique_ptr<scan::PointWriter> create_pcap(const std::filesystem::path& path,
                                               const FlightRecord& flight) {
  return std::make_unique<PcapWriter>(path, flight);
}

}  // namespace plotscan::record
