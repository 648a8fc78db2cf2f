// SPDX-License-Identifier: Apache-2.0
#include "record/velodyne/internal/ethernet.h"

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace plotscan::record {
namespace {

// The same datagram after each kind of header (tcpdump.org/linktypes.html).
TEST(Ethernet, DatagramsAreFoundOnEveryLink) {
  const std::vector<std::uint8_t> payload = {1, 2, 3, 4, 5};
  const std::vector<std::uint8_t> ethernet = broadcast_frame(2368, payload);
  const std::vector<std::uint8_t> ip(ethernet.begin() + 14, ethernet.end());
  const auto after = [&](std::vector<std::uint8_t> header) {
    header.insert(header.end(), ip.begin(), ip.end());
    return header;
  };
  std::vector<std::uint8_t> cooked(16), cooked_2(20);
  cooked[14] = cooked_2[0] = 0x08;  // IPv4
  for (const auto& [kind, frame] : {std::pair(FrameKind::ip, ip),
                                    {FrameKind::linux_cooked, after(cooked)},
                                    {FrameKind::linux_cooked_2, after(cooked_2)}}) {
    const auto udp = udp_datagram(kind, frame);
    ASSERT_TRUE(udp);
    EXPECT_EQ(std::vector(udp->payload.begin(), udp->payload.end()), payload);
    for (std::size_t size = 0; size < frame.size(); ++size)
      EXPECT_FALSE(udp_datagram(kind, std::span(frame).first(size)));
  }
}

TEST(Ethernet, DatagramsAreFoundThroughVlanTags) {
  const std::vector<std::uint8_t> payload = {1, 2, 3, 4, 5};
  std::vector<std::uint8_t> frame = broadcast_frame(2368, payload);
  for (int tags = 0; tags < 3; ++tags) {
    const auto udp = udp_datagram(FrameKind::ethernet, frame);
    ASSERT_TRUE(udp);
    EXPECT_EQ(udp->source_address, 0xC0A801C9U);
    EXPECT_EQ(udp->destination_port, 2368);
    EXPECT_EQ(std::vector(udp->payload.begin(), udp->payload.end()), payload);
    for (std::size_t size = 0; size < frame.size(); ++size)
      EXPECT_FALSE(udp_datagram(FrameKind::ethernet, std::span(frame).first(size)));
    const std::array<std::uint8_t, 4> tag = {0x81, 0x00, 0x00, 0x05};
    frame.insert(frame.begin() + 12, tag.begin(), tag.end());
  }
}

}  // namespace
}  // namespace plotscan::record
