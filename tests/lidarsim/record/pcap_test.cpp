// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cstdio>
#include <cstring>
#include <memory>
#include <set>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/angle.h"
#include "core/error.h"
#include "lidarsim/record/flown_scan.h"
#include "lidarsim/record/hovering.h"
#include "record/convert.h"
#include "record/velodyne/internal/pcap_reader.h"
#include "record/velodyne/internal/pcap_writer.h"

namespace plotscan::record {
namespace {

using testing::azimuth_error_deg;
using testing::FlownScan;
using ::testing::HasSubstr;
using testing::hovering;
using testing::Measured;
using testing::message_of;
using testing::return_of;
using testing::TemporaryFolder;

void write_pcap(const std::filesystem::path& file, const FlightRecord& flight,
                std::span<const scan::LabelledPoint> points) {
  const auto writer = create_pcap(file, flight);
  writer->write(points);
  writer->close();
}

struct ReadPcap {
  PcapSummary summary;
  std::vector<scan::LabelledPoint> points;
};

ReadPcap read(const std::filesystem::path& file, const std::optional<Placement>& placement = {}) {
  ReadPcap result;
  result.summary =
      read_pcap(file, sensor_of_product(read_pcap_info(file).first.product, file), placement,
                [&](std::span<const scan::LabelledPoint> piece) {
                  result.points.insert(result.points.end(), piece.begin(), piece.end());
                });
  return result;
}

// What a program prints; nothing where it is not installed.
std::optional<std::string> output_of(const std::string& command) {
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen((command + " 2>/dev/null").c_str(), "r"),
                                                   pclose);
  std::string text;
  std::array<char, 4096> piece{};
  while (const std::size_t length = std::fread(piece.data(), 1, piece.size(), pipe.get()))
    text.append(piece.data(), length);
  if (text.empty()) return std::nullopt;
  return text;
}

class Pcap : public ::testing::Test {
 protected:
  // Flown once for all tests of the suite.
  void SetUp() override {
    if (scan_) return;
    scan_ = std::make_unique<FlownScan>();
    write_pcap(file(), scan_->flight, scan_->points);
  }
  static void TearDownTestSuite() { scan_.reset(); }
  static const FlownScan& scan() { return *scan_; }
  static std::filesystem::path file() { return scan_->folder.path() / "flight.pcap"; }

 private:
  static std::unique_ptr<FlownScan> scan_;
};

std::unique_ptr<FlownScan> Pcap::scan_;

TEST_F(Pcap, ReadsBackAsTheRangesAzimuthsAndTimesOfTheCloud) {
  const ReadPcap read_back = read(file());
  const std::vector<Measured> expected = testing::measured(scan());
  ASSERT_GT(expected.size(), 50'000U);
  ASSERT_EQ(read_back.points.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const scan::LabelledPoint& point = read_back.points[i];
    const scan::LabelledPoint& cloud = scan().points[i];
    const sensor::Laser& laser = scan().flight.sensor.lasers[expected[i].laser];
    const Eigen::Vector3d way(point.x, point.y, point.z - laser.offset_m);
    ASSERT_NEAR(way.norm(), expected[i].range_m, 1e-4);  // 2 mm steps on both sides
    ASSERT_NEAR(std::asin(way.z() / way.norm()), laser.elevation_rad, 1e-6);
    const double azimuth_deg = degrees(std::atan2(-point.y, point.x));
    ASSERT_LT(azimuth_error_deg(azimuth_deg, expected[i].azimuth_deg), 0.0151);
    ASSERT_NEAR(point.time, cloud.time, 0.6e-6);
    ASSERT_EQ(point.ring, cloud.ring);
    ASSERT_EQ(point.intensity, cloud.intensity);
    ASSERT_EQ(point.return_count, 1);
  }
  EXPECT_EQ(format_utc(read_pcap_info(file()).start), "2026-06-01T10:59:59.7Z");
}

TEST_F(Pcap, WithPosesThePointsAreWhereTheCloudHasThem) {
  const ReadPcap read_back =
      read(file(), Placement{.world_from_body = scan().flight.reported,
                             .body_from_lidar = scan().flight.body_from_lidar});
  ASSERT_EQ(read_back.points.size(), scan().points.size());
  for (std::size_t i = 0; i < scan().points.size(); ++i) {
    const auto position = [](const scan::LabelledPoint& p) {
      return Eigen::Vector3d(p.x, p.y, p.z);
    };
    const double range_m = (position(scan().points[i]) - Eigen::Vector3d(-1, 0.5, 7)).norm();
    ASSERT_LT((position(read_back.points[i]) - position(scan().points[i])).norm(),
              radians(0.0155) * (range_m + 1));
  }
}

struct TsharkPacket {
  int port = 0;
  int length = 0;
  double time_s = 0;
  std::string source, destination, payload;
};

// Every packet with a right IP checksum and, as a sensor sends, no UDP one, or nothing where there
// is no tshark.
std::vector<TsharkPacket> tshark_packets(const std::filesystem::path& file) {
  const auto text =
      output_of("tshark -r '" + file.string() +
                "' -o ip.check_checksum:TRUE -Y "
                "'udp.checksum == 0 && ip.checksum.status == 1 && udp.srcport == udp.dstport' "
                "-T fields -e udp.dstport -e udp.length -e frame.time_epoch -e ip.src -e ip.dst -e "
                "udp.payload");
  std::vector<TsharkPacket> packets;
  if (!text) return packets;
  std::istringstream lines(*text);
  TsharkPacket packet;
  while (lines >> packet.port >> packet.length >> packet.time_s >> packet.source >>
         packet.destination >> packet.payload)
    packets.push_back(packet);
  return packets;
}

std::string text_of_hex(const std::string& hex) {
  std::string text;
  for (std::size_t i = 0; i + 1 < hex.size(); i += 2)
    text += static_cast<char>(std::stoi(hex.substr(i, 2), nullptr, 16));
  return text;
}

// What the sentence says, read by the C library.
struct RmcSentence {
  explicit RmcSentence(const std::string& text) {
    std::array<char, 7> clock{}, day{};
    double north_minutes = 0, west_minutes = 0;
    EXPECT_EQ(
        std::sscanf(text.c_str(), "$GPRMC,%6s,A,%2lf%lf,N,%3lf%lf,W,%*f,%*f,%6s", clock.data(),
                    &north_deg, &north_minutes, &west_deg, &west_minutes, day.data()),
        6);
    north_deg += north_minutes / 60;
    west_deg += west_minutes / 60;
    time = clock.data();
    date = day.data();
  }

  std::string date, time;  // ddmmyy, hhmmss
  double north_deg = 0, west_deg = 0;
};

TEST_F(Pcap, TsharkSeesASensorsBroadcasts) {
  const auto packets = tshark_packets(file());
  if (packets.empty()) GTEST_SKIP() << "tshark is not installed";
  const ReadPcap own = read(file());
  const std::size_t sequences = scan().flight.placed().sequences();
  EXPECT_EQ(own.summary.data_packets, (sequences + 23) / 24);
  EXPECT_EQ(own.summary.position_packets, (own.summary.data_packets + 13) / 14);
  EXPECT_EQ(own.summary.other_packets, 0U);
  ASSERT_EQ(packets.size(), own.summary.data_packets + own.summary.position_packets);
  const double start_s = 1780311599.7;  // 2026-06-01T10:59:59.7Z
  double before_s = start_s;
  std::set<std::string> seconds;
  for (const TsharkPacket& packet : packets) {
    EXPECT_GT(packet.time_s, before_s);
    before_s = packet.time_s;
    EXPECT_EQ(packet.source, "192.168.1.201");
    EXPECT_EQ(packet.destination, "255.255.255.255");
    EXPECT_EQ(packet.length, 8 + (packet.port == 2368 ? 1206 : 512));
    if (packet.port == 2368) continue;
    ASSERT_EQ(packet.port, 8308);
    const std::string payload = text_of_hex(packet.payload);
    const std::size_t at = payload.find("$GPRMC");
    ASSERT_EQ(at, 206U);
    const RmcSentence rmc(payload.substr(at));
    seconds.insert(rmc.date + " " + rmc.time);
    // 1.2 m of flight about 2 m west of the anchor.
    EXPECT_NEAR(rmc.north_deg, 37.2 + 0.55 / 111e3, 1e-6);
    EXPECT_NEAR(rmc.west_deg, 80.5 + 1.3 / 88.7e3, 1e-5);
  }
  EXPECT_EQ(seconds, (std::set<std::string>{"010626 105959", "010626 110000"}));
  const double end_s = start_s + 55.296e-6 * 24 * static_cast<double>(own.summary.data_packets);
  EXPECT_NEAR(before_s, end_s, 2e-4);
}

TEST_F(Pcap, ReadsPcapngToo) {
  const auto ng = scan().folder.path() / "flight.pcapng";
  output_of("editcap -F pcapng '" + file().string() + "' '" + ng.string() + "'");
  if (!std::filesystem::exists(ng)) GTEST_SKIP() << "editcap (of tshark) is not installed";
  EXPECT_EQ(read(ng).points.size(), scan().points.size());
}

TEST_F(Pcap, ConvertsFromAScanFolderAndBack) {
  const auto folder = scan().folder.path();
  convert(folder / "scan", folder / "converted.pcap", {});
  EXPECT_EQ(read_text(folder / "converted.pcap"), read_text(file()));
  ConvertOptions options;
  options.flight = FlightOptions{.trajectory = folder / "scan" / "poses.csv"};
  EXPECT_EQ(convert(folder / "converted.pcap", folder / "back.pcd", options).points,
            scan().points.size());
  const auto back = testing::cloud_points(folder / "back.pcd");
  ASSERT_EQ(back.size(), scan().points.size());
  for (std::size_t i = 0; i < back.size(); i += 100)
    EXPECT_NEAR(back[i].x, scan().points[i].x, 0.01);
  EXPECT_THAT(
      message_of<InputError>([&] { convert(folder / "back.pcd", folder / "again.pcap", {}); }),
      HasSubstr("needs the flight"));
}

TEST_F(Pcap, ATruncatedRecordingIsRefused) {
  const auto cut = scan().folder.path() / "cut.pcap";
  std::filesystem::copy_file(file(), cut);
  std::filesystem::resize_file(cut, std::filesystem::file_size(cut) - 100);
  EXPECT_THAT(message_of<InputError>([&] { read(cut); }),
              AllOf(HasSubstr("cut.pcap: packet "), HasSubstr("truncated")));
}

TEST(PcapFile, DualReturnsComeBackAsTwo) {
  const TemporaryFolder folder;
  FlightRecord flight = hovering("vlp16", 0.02);
  flight.returns = ReturnMode::dual;
  const std::vector<scan::LabelledPoint> points = {
      return_of(flight, 0, 0, 10, 80),  return_of(flight, 0, 0, 11, 20),
      return_of(flight, 13, 4, 12, 10), return_of(flight, 13, 4, 14, 90),
      return_of(flight, 13, 5, 20, 33), return_of(flight, 360, 15, 30, 1)};
  write_pcap(folder.path() / "dual.pcap", flight, points);
  const auto read_back = read(folder.path() / "dual.pcap").points;
  ASSERT_EQ(read_back.size(), points.size());
  const std::vector<int> numbers = {1, 2, 1, 2, 1, 1};
  const std::vector<int> counts = {2, 2, 2, 2, 1, 1};
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_EQ(read_back[i].return_number, numbers[i]);
    EXPECT_EQ(read_back[i].return_count, counts[i]);
    EXPECT_EQ(read_back[i].intensity, points[i].intensity);
    EXPECT_EQ(read_back[i].ring, points[i].ring);
    EXPECT_NEAR(read_back[i].time, points[i].time, 0.6e-6);
    EXPECT_NEAR(read_back[i].x, points[i].x, 0.01);
    EXPECT_NEAR(read_back[i].y, points[i].y, 0.01);
    EXPECT_NEAR(read_back[i].z, points[i].z, 1e-5);
  }
}

TEST(PcapFile, WithoutAnAnchorTheReceiverKnowsTheTimeAlone) {
  const TemporaryFolder folder;
  write_pcap(folder.path() / "a.pcap", hovering("vlp16", 0.01), {});
  std::ifstream in(folder.path() / "a.pcap", std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(in)), {});
  EXPECT_THAT(bytes, HasSubstr("$GPRMC,100000,V,,,,,,,010626,,,N*"));
}

TEST(PcapFile, WhatIsNoRecordingIsRefused) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "a.pcap";
  const auto refusal = [&] { return message_of<InputError>([&] { read(file); }); };
  EXPECT_THAT(refusal(), HasSubstr("a.pcap"));
  std::ofstream(file) << "";
  EXPECT_THAT(refusal(), HasSubstr("no pcap recording"));
  std::ofstream(file) << "VERSION 0.7 and so on, which is no pcap";
  EXPECT_THAT(refusal(), HasSubstr("no pcap recording"));
  // A flight shorter than a firing sequence: only the file's header.
  write_pcap(file, hovering("vlp16", 1e-5), {});
  EXPECT_THAT(refusal(), HasSubstr("no data packets"));
}

// The file as a pcapng of its first frame alone, captured so many seconds after 1970
// (draft-ietf-opsawg-pcapng, sections 4.1 to 4.3).
std::string pcapng_of(const std::filesystem::path& pcap, std::uint64_t captured_s) {
  std::ifstream in(pcap, std::ios::binary);
  const std::string whole((std::istreambuf_iterator<char>(in)), {});
  std::uint32_t size = 0;
  std::memcpy(&size, &whole[24 + 8], sizeof size);
  std::string bytes;
  const auto words = [&](std::initializer_list<std::uint32_t> values) {
    for (const std::uint32_t value : values)
      bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  words({0x0a0d0d0a, 28, 0x1a2b3c4d, 1, 0xffffffff, 0xffffffff, 28});
  // An Ethernet whose time stamps (option 9) count in units of 10^0 s.
  words({1, 32, 1, 65535, 9 | 1 << 16, 0, 0, 32});
  const std::uint32_t padded = (size + 3) / 4 * 4;
  words({6, 32 + padded, 0, static_cast<std::uint32_t>(captured_s >> 32),
         static_cast<std::uint32_t>(captured_s), size, size});
  bytes += whole.substr(24 + 16, size) + std::string(padded - size, '\0');
  words({32 + padded});
  return bytes;
}

TEST(PcapFile, PacketsOfNoTimeAreRefused) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "a.pcap";
  write_pcap(file, hovering("vlp16", 0.01), {});
  const auto captured = [&](std::uint64_t captured_s) {
    return folder.write("b.pcap", pcapng_of(file, captured_s));
  };
  EXPECT_NO_THROW(read(captured(1'780'000'000)));
  const auto never = captured(std::uint64_t{1} << 62);
  EXPECT_THAT(message_of<InputError>([&] { read(never); }),
              HasSubstr("packet 1: its time lies outside"));
}

// The file of one packet with a byte changed, counted from the frame's start; the file's header
// takes 24 bytes and the packet's 16.
std::filesystem::path changed(const TemporaryFolder& folder, std::size_t at, char value) {
  const auto file = folder.path() / "changed.pcap";
  const FlightRecord flight = hovering("vlp16", 0.001);
  write_pcap(file, flight, std::vector{return_of(flight, 3, 0, 10)});
  std::fstream bytes(file, std::ios::binary | std::ios::in | std::ios::out);
  bytes.seekp(static_cast<std::streamoff>(24 + 16 + at)).put(value);
  return file;
}

TEST(PcapFile, DamagedPacketsAreLeftOut) {
  const TemporaryFolder folder;
  const auto refusal = [&](std::size_t at, char value) {
    return message_of<InputError>([&] { read(changed(folder, at, value)); });
  };
  EXPECT_EQ(read(changed(folder, 0, 1)).points.size(), 1U);      // to whom does not matter
  EXPECT_THAT(refusal(12, 0x09), HasSubstr("no data packets"));  // another protocol than IPv4
  EXPECT_THAT(refusal(14, 0x4F), HasSubstr("no data packets"));  // a header longer than it is
  EXPECT_THAT(refusal(17, 0x00), HasSubstr("no data packets"));  // a shorter datagram
  EXPECT_THAT(refusal(20, 0x20), HasSubstr("no data packets"));  // a fragment
  EXPECT_THAT(refusal(23, 0x06), HasSubstr("no data packets"));  // TCP
  EXPECT_THAT(refusal(38, 0x0F), HasSubstr("no data packets"));  // a longer datagram
  EXPECT_THAT(refusal(42, 0x00), HasSubstr("no data packets"));  // the first block's flag
  EXPECT_THAT(refusal(42 + 1205, 0x63),
              HasSubstr("product 0x63, which no shipped sensor is; --sensor"));
  EXPECT_THAT(refusal(42 + 1203, -1), HasSubstr("beyond the hour"));
}

TEST(PcapFile, FramesThatWereCutAreRefused) {
  const TemporaryFolder folder;
  // The packet's header says that the frame was longer by 256 bytes.
  const auto file = changed(folder, 0, 0);
  std::fstream bytes(file, std::ios::binary | std::ios::in | std::ios::out);
  bytes.seekp(24 + 13).put(0x05);
  bytes.close();
  EXPECT_THAT(message_of<InputError>([&] { read(file); }), HasSubstr("record whole packets"));
}

TEST(PcapFile, AFullDiskIsAnError) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full";
  EXPECT_THROW(write_pcap("/dev/full", hovering("vlp16", 0.5), {}), std::runtime_error);
}

}  // namespace
}  // namespace plotscan::record
