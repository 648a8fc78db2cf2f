// SPDX-License-Identifier: Apache-2.0
#include <vector>

#include <gtest/gtest.h>

#include "record/velodyne/packet.h"

namespace plotscan::record {
namespace {

// Laid out by hand after figure 9-2 and tables 9-2 and 9-3 of the VLP-16's manual.
std::vector<std::uint8_t> manual_packet() {
  std::vector<std::uint8_t> bytes;
  const auto append = [&bytes](std::initializer_list<int> values) {
    for (const int value : values) bytes.push_back(static_cast<std::uint8_t>(value));
  };
  for (int block = 0; block < 12; ++block) {
    append({0xFF, 0xEE});
    // The manual's example of an azimuth: 27742 is 277.42 degrees. The others follow at 0.4
    // degrees.
    const int azimuth = 27742 + 40 * block;
    append({azimuth % 256, azimuth / 256});
    append({0x39, 0x00, 0x25});  // first return: 57 steps of 2 mm, reflectivity 37
    for (int i = 1; i < 31; ++i) append({0x00, 0x00, 0x00});
    append({0x42, 0x62, 0xFF});  // last return: 25154 steps, reflectivity 255
  }
  append({0x61, 0x67, 0xB9, 0x5A});  // the manual's example of a time: 1522100065 us
  append({0x37, 0x22});              // strongest, VLP-16
  return bytes;
}

DataPacket the_same_packet() {
  DataPacket packet;
  for (std::size_t block = 0; block < kPacketBlocks; ++block) {
    packet.blocks[block].azimuth = static_cast<std::uint16_t>(27742 + 40 * block);
    packet.blocks[block].returns.front() = {.distance = 57, .reflectivity = 37};
    packet.blocks[block].returns.back() = {.distance = 25154, .reflectivity = 255};
  }
  packet.past_hour_us = 0x5AB96761;
  packet.mode = ReturnMode::strongest;
  packet.product = 0x22;
  return packet;
}

TEST(VelodynePacket, IsLaidOutAsTheManualSays) {
  const auto expected = manual_packet();
  ASSERT_EQ(expected.size(), 1206U);
  const DataPacketBytes encoded = encode(the_same_packet());
  EXPECT_EQ(std::vector(encoded.begin(), encoded.end()), expected);
  EXPECT_EQ(decode_data_packet(expected), the_same_packet());
}

TEST(VelodynePacket, ReadsEveryMode) {
  for (const ReturnMode mode : {ReturnMode::strongest, ReturnMode::last, ReturnMode::dual}) {
    DataPacket packet = the_same_packet();
    packet.mode = mode;
    EXPECT_EQ(decode_data_packet(encode(packet)), packet);
  }
}

TEST(VelodynePacket, AnythingElseIsNone) {
  const auto with = [](std::size_t at, std::uint8_t byte) {
    auto bytes = manual_packet();
    bytes[at] = byte;
    return decode_data_packet(bytes);
  };
  auto bytes = manual_packet();
  bytes.pop_back();
  EXPECT_FALSE(decode_data_packet(bytes));
  EXPECT_FALSE(decode_data_packet({}));
  EXPECT_FALSE(with(0, 0xFE));
  EXPECT_FALSE(with(101, 0xDD));   // the second block: an HDL-64E's lower lasers
  EXPECT_FALSE(with(3, 0x8D));     // an azimuth of 361.9 degrees
  EXPECT_FALSE(with(1204, 0x00));  // firmware before 3.0.29
  EXPECT_FALSE(with(1204, 0x3A));
  EXPECT_TRUE(with(1205, 0x99));  // which products there are is not the layout's business
}

TEST(PositionPacket, IsLaidOutAsTheManualSays) {
  const std::string sentence = "$GPRMC,220516,A,5133.82,N,00042.24,W,173.8,231.8,130694,004.2,W*70";
  std::vector<std::uint8_t> expected(512, 0);
  // Table 9-3 counts from the Ethernet frame: the payload begins at 0x2A.
  const std::size_t payload = 0x2A;
  expected[0xF0 - payload] = 0x78;
  expected[0xF1 - payload] = 0x56;
  expected[0xF2 - payload] = 0x34;
  expected[0xF3 - payload] = 0x12;
  expected[0xF4 - payload] = 2;
  std::copy(sentence.begin(), sentence.end(), expected.begin() + (0xF8 - payload));
  expected[0xF8 - payload + sentence.size()] = 0x0D;
  expected[0xF8 - payload + sentence.size() + 1] = 0x0A;

  const PositionPacket packet{
      .past_hour_us = 0x12345678, .pps = PpsStatus::locked, .sentence = sentence};
  const PositionPacketBytes encoded = encode(packet);
  EXPECT_EQ(std::vector(encoded.begin(), encoded.end()), expected);
  EXPECT_EQ(decode_position_packet(expected), packet);
}

TEST(PositionPacket, AnythingElseIsNone) {
  EXPECT_FALSE(decode_position_packet(std::vector<std::uint8_t>(511, 0)));
  std::vector<std::uint8_t> bytes(512, 0);
  EXPECT_TRUE(decode_position_packet(bytes));
  bytes[202] = 4;
  EXPECT_FALSE(decode_position_packet(bytes));
  // No end of a sentence: nothing beyond the packet is read.
  const auto endless = decode_position_packet(std::vector<std::uint8_t>(512, 1));
  ASSERT_TRUE(endless);
  EXPECT_EQ(endless->sentence.size(), 512U - 206U);
}

}  // namespace
}  // namespace plotscan::record
