// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "lidarsim/record/hovering.h"
#include "record/velodyne/encoder.h"
#include "temporary_folder.h"

namespace plotscan::record {
namespace {

using ::testing::HasSubstr;
using testing::hovering;
using testing::message_of;
using testing::return_of;

std::vector<SentPacket> packets_of(const FlightRecord& flight,
                                   const std::vector<scan::LabelledPoint>& points) {
  std::vector<SentPacket> packets;
  VelodyneEncoder encoder(flight, [&](const SentPacket& packet) { packets.push_back(packet); });
  // In two pieces, as points come from files.
  const std::size_t half = points.size() / 2;
  encoder.write(std::span(points).first(half));
  encoder.write(std::span(points).subspan(half));
  encoder.close();
  return packets;
}

// VLP-16: 24 firing sequences of 55.296 us a packet.
TEST(VelodyneEncoder, PutsReturnsWhereTheManualSays) {
  const FlightRecord flight = hovering("vlp16", 0.01);
  const auto packets =
      packets_of(flight, {return_of(flight, 0, 0, 10.0, 30), return_of(flight, 1, 3, 20.002, 99.6F),
                          return_of(flight, 23, 15, 99.998, 255), return_of(flight, 24, 1, 0.4, 0),
                          return_of(flight, 150, 7, 5, 1)});
  ASSERT_EQ(packets.size(), 8U);  // 180 sequences: the last packet is filled up
  const auto& first = packets[0].data.blocks;
  EXPECT_EQ(first[0].returns[0], (PacketReturn{.distance = 5000, .reflectivity = 30}));
  EXPECT_EQ(first[0].returns[16 + 3], (PacketReturn{.distance = 10001, .reflectivity = 100}));
  EXPECT_EQ(first[11].returns[31], (PacketReturn{.distance = 49999, .reflectivity = 255}));
  EXPECT_EQ(packets[1].data.blocks[0].returns[1], (PacketReturn{.distance = 200}));
  EXPECT_EQ(packets[6].data.blocks[3].returns[7],
            (PacketReturn{.distance = 2500, .reflectivity = 1}));
  std::size_t returns = 0;
  for (const SentPacket& packet : packets) {
    for (const PacketBlock& block : packet.data.blocks)
      returns += std::ranges::count_if(block.returns, [](auto r) { return r.distance > 0; });
  }
  EXPECT_EQ(returns, 5U);  // every other shot is a miss
  EXPECT_EQ(packets[0].data.mode, ReturnMode::strongest);
  EXPECT_EQ(packets[0].data.product, 0x22);
}

TEST(VelodyneEncoder, AzimuthsAndTimesAdvanceSteadily) {
  FlightRecord flight = hovering("vlp16", 0.25);
  flight.start = *parse_utc("2026-06-01T10:59:59.9Z");
  const auto packets = packets_of(flight, {});
  ASSERT_GT(packets.size(), 180U);
  for (std::size_t n = 0; n < packets.size(); ++n) {
    const double fired_us = 24 * 55.296 * static_cast<double>(n);
    EXPECT_NEAR(packets[n].fired_s, 1e-6 * fired_us, 1e-12);
    EXPECT_NEAR(packets[n].sent_s, 1e-6 * (fired_us + 24 * 55.296), 1e-12);
    EXPECT_EQ(packets[n].data.past_hour_us,
              static_cast<std::uint64_t>(std::llround(3'599'900'000 + fired_us)) % 3'600'000'000);
    for (std::size_t block = 0; block < kPacketBlocks; ++block) {
      // 10 turns a second: 3600 degrees, in hundredths.
      const double steps = 0.36 * (fired_us + 2 * 55.296 * static_cast<double>(block));
      EXPECT_EQ(packets[n].data.blocks[block].azimuth, std::llround(steps) % 36'000);
    }
  }
}

TEST(VelodyneEncoder, DualModeTellsTheLastAndTheStrongestOfTheOthers) {
  FlightRecord flight = hovering("vlp16", 0.01);
  flight.returns = ReturnMode::dual;
  // 12 firing sequences a packet: two blocks tell of two of them.
  const auto packets =
      packets_of(flight, {return_of(flight, 0, 0, 10, 80), return_of(flight, 0, 0, 11, 20),
                          return_of(flight, 0, 1, 12, 10), return_of(flight, 0, 1, 14, 90),
                          return_of(flight, 3, 2, 7, 33), return_of(flight, 12, 0, 30, 1),
                          return_of(flight, 12, 0, 31, 2), return_of(flight, 12, 0, 32, 3)});
  ASSERT_EQ(packets.size(), 15U);
  const auto& blocks = packets[0].data.blocks;
  // The strongest is not the last.
  EXPECT_EQ(blocks[0].returns[0], (PacketReturn{.distance = 5500, .reflectivity = 20}));
  EXPECT_EQ(blocks[1].returns[0], (PacketReturn{.distance = 5000, .reflectivity = 80}));
  // The strongest is the last: the second strongest is told.
  EXPECT_EQ(blocks[0].returns[1], (PacketReturn{.distance = 7000, .reflectivity = 90}));
  EXPECT_EQ(blocks[1].returns[1], (PacketReturn{.distance = 6000, .reflectivity = 10}));
  // One return: both are the same.
  EXPECT_EQ(blocks[2].returns[16 + 2], (PacketReturn{.distance = 3500, .reflectivity = 33}));
  EXPECT_EQ(blocks[3].returns[16 + 2], blocks[2].returns[16 + 2]);
  // Three returns.
  EXPECT_EQ(packets[1].data.blocks[0].returns[0].distance, 16000);
  EXPECT_EQ(packets[1].data.blocks[1].returns[0].distance, 15500);
  for (std::size_t block = 0; block < kPacketBlocks; block += 2) {
    EXPECT_EQ(blocks[block].azimuth, blocks[block + 1].azimuth);
    EXPECT_EQ(blocks[block].azimuth, std::lround(0.36 * 55.296 * static_cast<double>(block)));
  }
  EXPECT_EQ(packets[0].data.mode, ReturnMode::dual);
}

TEST(VelodyneEncoder, SingleModesChooseTheirReturn) {
  FlightRecord flight = hovering("vlp16", 0.01);
  const std::vector<scan::LabelledPoint> points = {return_of(flight, 0, 0, 10, 80),
                                                   return_of(flight, 0, 0, 11, 20)};
  EXPECT_EQ(packets_of(flight, points)[0].data.blocks[0].returns[0].distance, 5000);
  flight.returns = ReturnMode::last;
  EXPECT_EQ(packets_of(flight, points)[0].data.blocks[0].returns[0].distance, 5500);
}

TEST(VelodyneEncoder, ForeignPointsAreRefused) {
  const FlightRecord flight = hovering("vlp16", 0.01);
  const auto refusal = [&](std::vector<scan::LabelledPoint> points) {
    return message_of<InputError>([&] { packets_of(flight, points); });
  };
  EXPECT_THAT(refusal({return_of(flight, 5, 0, 10), return_of(flight, 4, 0, 10)}),
              HasSubstr("not in the order of firing"));
  scan::LabelledPoint point = return_of(flight, 5, 0, 10);
  point.time += 1.1e-6;
  EXPECT_THAT(refusal({point}), HasSubstr("no shot of the flight"));
  EXPECT_THAT(refusal({return_of(flight, 181, 0, 10)}), HasSubstr("no shot of the flight"));
  point = return_of(flight, 5, 0, 10);
  point.ring = 16;
  EXPECT_THAT(refusal({point}), HasSubstr("no shot of the flight"));
  point.ring = 0;
  point.z += 0.1F;
  EXPECT_THAT(refusal({point}), HasSubstr("does not lie on its shot"));
  point.z = std::nanf("");
  EXPECT_THAT(refusal({point}), HasSubstr("does not lie on its shot"));
}

TEST(VelodyneEncoder, OtherSensorsAreRefused) {
  FlightRecord flight = hovering("vlp16", 0.01);
  flight.sensor.packets.reset();
  EXPECT_THAT(message_of<InputError>([&] { packets_of(flight, {}); }),
              HasSubstr("sends no Velodyne packets"));
}

}  // namespace
}  // namespace plotscan::record
