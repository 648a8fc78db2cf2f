// SPDX-License-Identifier: Apache-2.0
// Every shipped Velodyne's recording, against the cloud of the same flight.
#include <algorithm>
#include <ostream>

#include <gtest/gtest.h>

#include "core/angle.h"
#include "lidarsim/record/flown_scan.h"
#include "lidarsim/record/hovering.h"
#include "record/convert.h"
#include "record/velodyne/internal/pcap_reader.h"

namespace plotscan::record {
namespace {

using testing::FlownScan;
using testing::Measured;

struct Shipped {
  const char* name;
  std::uint8_t product;
  double distance_step_m;
  std::size_t sequences_a_packet;  // in a single mode
};

// Points of a recording in the lidar frame, as its first packet names the sensor.
std::vector<scan::LabelledPoint> decoded(const std::filesystem::path& file) {
  std::vector<scan::LabelledPoint> points;
  read_pcap(file, sensor_of_product(read_pcap_info(file).first.product, file), {},
            [&](auto piece) { points.insert(points.end(), piece.begin(), piece.end()); });
  return points;
}

// Ranges within single precision (the cloud's and the packet's steps are the same), angles within
// what blocks of 0.01 degrees tell, times within the microsecond that packets are stamped in.
void expect_measured(const FlownScan& scan, const std::vector<scan::LabelledPoint>& read) {
  const std::vector<Measured> expected = testing::measured(scan);
  ASSERT_EQ(read.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const scan::LabelledPoint& point = read[i];
    const scan::LabelledPoint& cloud = scan.points[i];
    const sensor::Laser& laser = scan.flight.sensor.lasers[expected[i].laser];
    const Eigen::Vector3d way(point.x, point.y, point.z - laser.offset_m);
    ASSERT_NEAR(way.norm(), expected[i].range_m, 1e-4);
    const double steps = way.norm() / scan.flight.sensor.packets->distance_step_m;
    ASSERT_NEAR(steps, std::round(steps), 0.01);
    ASSERT_NEAR(std::asin(way.z() / way.norm()), laser.elevation_rad, 1e-6);
    const double azimuth_deg = degrees(std::atan2(-point.y, point.x));
    ASSERT_LT(testing::azimuth_error_deg(azimuth_deg, expected[i].azimuth_deg), 0.0151);
    ASSERT_NEAR(point.time, cloud.time, 0.6e-6);
    ASSERT_EQ(point.ring, cloud.ring);
    ASSERT_EQ(point.intensity, cloud.intensity);
    ASSERT_EQ(point.return_number, cloud.return_number);
    ASSERT_EQ(point.return_count, cloud.return_count);
  }
}

// GoogleTest prints it beside the test's name.
void PrintTo(const Shipped& sensor, std::ostream* out) { *out << sensor.name; }

class VelodyneSensors : public ::testing::TestWithParam<Shipped> {};

TEST_P(VelodyneSensors, RecordingsReadBackAsTheCloudWasMeasured) {
  const Shipped& shipped = GetParam();
  const FlownScan scan({.sensor = shipped.name});
  ASSERT_GT(scan.points.size(), 20'000U);
  const auto file = scan.folder.path() / "flight.pcap";
  convert(scan.folder.path() / "scan", file, {});
  EXPECT_EQ(read_pcap_info(file).first.product, shipped.product);
  EXPECT_EQ(sensor_of_product(shipped.product, file).name, shipped.name);
  EXPECT_EQ(scan.flight.sensor.packets->distance_step_m, shipped.distance_step_m);
  const std::size_t sequences = scan.flight.placed().sequences();
  const PcapSummary summary = read_pcap(file, scan.flight.sensor, {}, [](auto) {});
  EXPECT_EQ(summary.data_packets,
            (sequences + shipped.sequences_a_packet - 1) / shipped.sequences_a_packet);
  expect_measured(scan, decoded(file));
}

// The small farm with bushes of more than 2 m: a sensor tells returns apart from 1 m on.
farm::Farm tall_farm() {
  farm::Farm farm = testing::small_farm();
  for (farm::Plant& plant : farm.plants) plant.scale.z() *= 5;
  return farm;
}

// Beams of 7 rays at the edges of leaves: shots of two returns.
TEST_P(VelodyneSensors, DualReturnsOfAFlightComeBack) {
  const FlownScan scan({.sensor = GetParam().name, .sub_rays = 7, .returns = "dual"}, tall_farm());
  ASSERT_EQ(scan.flight.returns, ReturnMode::dual);
  const auto seconds = std::ranges::count(scan.points, 2, &scan::LabelledPoint::return_number);
  ASSERT_GT(seconds, 100);
  const auto file = scan.folder.path() / "flight.pcap";
  convert(scan.folder.path() / "scan", file, {});
  EXPECT_EQ(read_pcap_info(file).first.mode, ReturnMode::dual);
  expect_measured(scan, decoded(file));
}

INSTANTIATE_TEST_SUITE_P(All, VelodyneSensors,
                         ::testing::Values(Shipped{"vlp16", 0x22, 0.002, 24},
                                           Shipped{"puck_hires", 0x24, 0.002, 24},
                                           Shipped{"vlp32c", 0x28, 0.004, 12},
                                           Shipped{"hdl32e", 0x21, 0.002, 12}),
                         [](const auto& tested) { return std::string(tested.param.name); });

// No Velodyne's rays begin off its axis; the packets' reader minds it for sensors of one's own.
TEST(VelodyneDecoder, RaysMayBeginOffTheSpinAxis) {
  FlightRecord flight = testing::hovering("vlp32c", 0.1);
  for (sensor::Laser& laser : flight.sensor.lasers) laser.radius_m = 0.4;
  VelodyneDecoder decoder(flight.sensor, {});
  DataPacket packet;
  packet.blocks[0].azimuth = 9000;
  for (std::size_t block = 1; block < kPacketBlocks; ++block) packet.blocks[block].azimuth = 9000;
  packet.blocks[0].returns[0] = {.distance = 1000, .reflectivity = 1};
  std::vector<scan::LabelledPoint> points;
  decoder.decode(packet, 0, points);
  ASSERT_EQ(points.size(), 1U);
  // Azimuth 90 degrees is -y; the beam of laser 0 is 1.4 degrees ahead and 25 below.
  EXPECT_NEAR(points[0].x, -4 * std::cos(25 * kDegrees) * std::sin(1.4 * kDegrees), 1e-6);
  EXPECT_NEAR(points[0].y, -0.4 - 4 * std::cos(25 * kDegrees) * std::cos(1.4 * kDegrees), 1e-6);
  EXPECT_NEAR(points[0].z, -4 * std::sin(25 * kDegrees), 1e-6);
}

}  // namespace
}  // namespace plotscan::record
