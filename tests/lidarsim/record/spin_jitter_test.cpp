// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/angle.h"
#include "core/error.h"
#include "lidarsim/record/flown_scan.h"
#include "lidarsim/record/hovering.h"
#include "record/convert.h"
#include "record/scan_folder.h"
#include "record/velodyne/encoder.h"
#include "temporary_folder.h"

namespace plotscan::record {
namespace {

using ::testing::HasSubstr;
using testing::hovering;
using testing::message_of;
using testing::TemporaryFolder;

std::vector<DataPacket> packets_of(const FlightRecord& flight) {
  std::vector<DataPacket> packets;
  VelodyneEncoder encoder(flight, [&](const SentPacket& sent) { packets.push_back(sent.data); });
  encoder.close();
  return packets;
}

// From block to block, hundredths of a degree.
std::vector<double> steps_of(const std::vector<DataPacket>& packets) {
  std::vector<int> azimuths;
  for (const DataPacket& packet : packets)
    for (const PacketBlock& block : packet.blocks) azimuths.push_back(block.azimuth);
  std::vector<double> steps;
  for (std::size_t i = 1; i < azimuths.size(); ++i)
    steps.push_back((azimuths[i] - azimuths[i - 1] + kAzimuthSteps) % kAzimuthSteps);
  return steps;
}

struct Statistics {
  double mean = 0, sd = 0, lag1 = 0;
};

Statistics statistics(const std::vector<double>& steps) {
  Statistics result;
  const auto count = static_cast<double>(steps.size());
  for (const double step : steps) result.mean += step / count;
  double variance = 0;
  double product = 0;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    variance += std::pow(steps[i] - result.mean, 2) / count;
    if (i > 0) product += (steps[i] - result.mean) * (steps[i - 1] - result.mean) / count;
  }
  result.sd = std::sqrt(variance);
  result.lag1 = product / variance;
  return result;
}

FlightRecord jittering(double sd_deg, double duration_s) {
  FlightRecord flight = hovering("vlp16", duration_s);
  flight.spin_jitter = {.sd_rad = sd_deg * kDegrees, .seed = 5};
  return flight;
}

// Azimuths that err independently by sigma, and by rounding to whole steps (variance 1/12), have
// steps of variance 2 (sigma^2 + 1/12), neighbours of which share one azimuth: correlation -1/2.
TEST(SpinJitter, BlocksHaveTheStatisticsOfWhiteJitter) {
  for (const double sigma : {0.5, 2.0}) {
    const Statistics found = statistics(steps_of(packets_of(jittering(0.01 * sigma, 3))));
    EXPECT_NEAR(found.mean, 0.36 * 2 * 55.296, 0.01);
    EXPECT_NEAR(found.sd, std::sqrt(2 * (sigma * sigma + 1.0 / 12)), 0.02 * found.sd);
    EXPECT_NEAR(found.lag1, -0.5, 0.02) << sigma;
  }
}

TEST(SpinJitter, WithoutItTheHeadTurnsSteadily) {
  for (const double step : steps_of(packets_of(jittering(0, 0.5)))) {
    EXPECT_GE(step, 39);
    EXPECT_LE(step, 40);
  }
}

// 80 packets of a real sensor, without their network's headers.
TEST(SpinJitter, IsThatOfARealSensor) {
  const std::filesystem::path real = PLOTSCAN_SHARED_DATA_DIR "/real/vlp16_indoors_80_packets.bin";
  if (!std::filesystem::exists(real)) GTEST_SKIP() << real << " is not there";
  std::vector<DataPacket> packets;
  std::ifstream in(real, std::ios::binary);
  for (std::array<char, kDataPacketSize> bytes{}; in.read(bytes.data(), bytes.size());) {
    const auto packet =
        decode_data_packet({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
    ASSERT_TRUE(packet);
    packets.push_back(*packet);
  }
  ASSERT_EQ(packets.size(), 80U);
  const double stated_deg = sensor::load_sensor("vlp16").spin_jitter_rad / kDegrees;
  const Statistics measured = statistics(steps_of(packets));
  const Statistics simulated = statistics(steps_of(packets_of(jittering(stated_deg, 3))));
  // 959 steps tell a standard deviation to some 3 %, a correlation to some 0.03.
  EXPECT_NEAR(simulated.sd, measured.sd, 0.05);
  EXPECT_NEAR(simulated.lag1, measured.lag1, 0.06);
}

// The rays are cast where the packets say that they were.
TEST(SpinJitter, RaysGoWherePacketsSay) {
  const FlightRecord flight = jittering(0.5, 0.05);
  const std::vector<DataPacket> packets = packets_of(flight);
  const sensor::ShotPlan plan = flight.placed();
  sensor::SequenceShots shots;
  double farthest_deg = 0;
  for (std::uint64_t sequence = 0; sequence + 1 < plan.sequences(); sequence += 2) {
    plan.fire(sequence, shots);
    const double azimuth_deg = std::atan2(-shots.direction[1][0], shots.direction[0][0]) / kDegrees;
    const PacketBlock& block = packets[sequence / 24].blocks[sequence % 24 / 2];
    ASSERT_LT(testing::azimuth_error_deg(azimuth_deg, 0.01 * block.azimuth), 0.0051);
    const double steady_deg = 3600 * 55.296e-6 * static_cast<double>(sequence);
    farthest_deg = std::max(farthest_deg, testing::azimuth_error_deg(azimuth_deg, steady_deg));
  }
  EXPECT_GT(farthest_deg, 1);
  EXPECT_LT(farthest_deg, 3);
}

// A VLP-16's file with another jitter, and a short way over the farm.
std::string jittering_sensor(const TemporaryFolder& folder, const std::string& jitter_deg) {
  std::string text = sensor::load_sensor("vlp16").description;
  const std::string key = "spin_jitter_deg: 0.005";
  text.replace(text.find(key), key.size(), "spin_jitter_deg: " + jitter_deg);
  return folder.write("jitters_by_" + jitter_deg + ".yaml", text);
}

std::filesystem::path short_way(const TemporaryFolder& folder) {
  return folder.write("way.txt", "0 -2 0.5 7 0 0 0 1\n0.3 -1.4 0.5 7 0 0 0.02 1\n");
}

// A flight with a jitter that moves points by decimetres: its folder says enough to find their
// shots again, and without the jitter they are none.
TEST(SpinJitter, AScanFolderKnowsItsJitter) {
  const TemporaryFolder folder;
  const auto scan = folder.path() / "scan";
  lidar::fly(testing::small_farm(), scan,
             {.sensor = jittering_sensor(folder, "1"), .flight = short_way(folder), .seed = 77});
  EXPECT_GT(convert(scan, folder.path() / "flight.pcap", {}).points, 10'000U);
  FlightRecord steady = read_flight_record(scan);
  steady.spin_jitter = {};
  VelodyneEncoder encoder(steady, [](const SentPacket&) {});
  EXPECT_THAT(
      message_of<InputError>([&] { encoder.write(testing::cloud_points(scan / "cloud.pcd")); }),
      HasSubstr("does not lie on its shot"));
}

// Without the range's noise: at 7 m over the ground 0.005 degrees are 0.6 mm.
TEST(SpinJitter, IsTheSensorsOwnUnlessNoneIsAskedFor) {
  const TemporaryFolder folder;
  const auto flown = [&](const std::string& name, lidar::FlyOptions options) {
    options.flight = short_way(folder);
    options.range_noise_m = 0;
    lidar::fly(testing::small_farm(), folder.path() / name, options);
    return testing::cloud_points(folder.path() / name / "cloud.pcd");
  };
  const auto usual = flown("usual", {});
  const auto none = flown("none", {.spin_jitter = "none"});
  const auto zero = flown("zero", {.sensor = jittering_sensor(folder, "0")});
  const auto apart = [](const auto& points, const auto& others) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < std::min(points.size(), others.size()); ++i)
      count += points[i].x != others[i].x || points[i].y != others[i].y ? 1 : 0;
    return count;
  };
  ASSERT_GT(none.size(), 10'000U);
  EXPECT_EQ(none.size(), zero.size());
  EXPECT_EQ(apart(none, zero), 0U);
  EXPECT_GT(apart(none, usual), none.size() / 2);
}

}  // namespace
}  // namespace plotscan::record
