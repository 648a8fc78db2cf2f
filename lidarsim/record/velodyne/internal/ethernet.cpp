// SPDX-License-Identifier: Apache-2.0
#include "record/velodyne/internal/ethernet.h"

#include <algorithm>

#include "core/error.h"

namespace plotscan::record {
namespace {

using Bytes = std::span<const std::uint8_t>;

constexpr std::size_t kEthernetSize = 14;
constexpr std::size_t kCookedSize = 16;
constexpr std::size_t kCooked2Size = 20;
constexpr std::size_t kIpSize = 20;
constexpr std::size_t kUdpSize = 8;
constexpr std::uint16_t kIpv4 = 0x0800;
constexpr std::uint16_t kVlan = 0x8100;
constexpr std::uint16_t kServiceVlan = 0x88A8;
constexpr std::uint8_t kUdp = 17;

void append16(std::vector<std::uint8_t>& bytes, std::size_t value) {
  bytes.push_back(static_cast<std::uint8_t>(value >> 8));
  bytes.push_back(static_cast<std::uint8_t>(value));
}

std::uint16_t big16_at(Bytes bytes, std::size_t at) {
  return static_cast<std::uint16_t>(bytes[at] << 8 | bytes[at + 1]);
}

// The Internet checksum of 16-bit words (RFC 1071), before its complement.
std::uint32_t word_sum(Bytes bytes) {
  std::uint32_t sum = 0;
  for (std::size_t i = 0; i + 1 < bytes.size(); i += 2) sum += big16_at(bytes, i);
  while (sum > 0xFFFF) sum = (sum & 0xFFFF) + (sum >> 16);
  return sum;
}

void put_checksum(std::vector<std::uint8_t>& bytes, std::size_t at, std::uint32_t sum) {
  bytes[at] = static_cast<std::uint8_t>(~sum >> 8);
  bytes[at + 1] = static_cast<std::uint8_t>(~sum);
}

// A link's header: its size, and where in it the protocol of what follows stands.
struct LinkHeader {
  std::size_t size = 0;
  std::size_t type_at = 0;
};

// LINKTYPE_ETHERNET, LINKTYPE_LINUX_SLL and LINKTYPE_LINUX_SLL2 of tcpdump.org/linktypes.html.
LinkHeader link_header(FrameKind kind) {
  if (kind == FrameKind::linux_cooked) return {kCookedSize, kCookedSize - 2};
  if (kind == FrameKind::linux_cooked_2) return {kCooked2Size, 0};
  return {kEthernetSize, kEthernetSize - 2};
}

// The frame from its IPv4 packet on; absent if it carries none.
std::optional<Bytes> ip_packet(FrameKind kind, Bytes frame) {
  if (kind == FrameKind::ip) return frame;
  const LinkHeader link = link_header(kind);
  std::size_t at = link.size;
  if (frame.size() < at) return std::nullopt;
  std::uint16_t type = big16_at(frame, link.type_at);
  while ((type == kVlan || type == kServiceVlan) && frame.size() >= at + 4) {
    type = big16_at(frame, at + 2);
    at += 4;
  }
  if (type != kIpv4) return std::nullopt;
  return frame.subspan(at);
}

}  // namespace

std::vector<std::uint8_t> broadcast_frame(std::uint16_t port, Bytes payload) {
  check(payload.size() <= 1472, "a datagram fits into one Ethernet frame");
  std::vector<std::uint8_t> frame = {
      0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF,  // to all
      0x60, 0x76, 0x88, 0x00, 0x00, 0x00,  // from a sensor: 60-76-88 is Velodyne's
      0x08, 0x00,                          // IPv4
      0x45, 0x00};
  frame.reserve(kUdpHeaders + payload.size());
  append16(frame, kIpSize + kUdpSize + payload.size());
  frame.insert(frame.end(), {0x00, 0x00, 0x40, 0x00,  // not to be fragmented
                             0xFF, kUdp, 0x00, 0x00,  // time to live, protocol, checksum below
                             192, 168, 1, 201, 255, 255, 255, 255});
  put_checksum(frame, kEthernetSize + 10, word_sum(Bytes(frame).subspan(kEthernetSize)));
  append16(frame, port);
  append16(frame, port);
  append16(frame, kUdpSize + payload.size());
  append16(frame, 0);  // no checksum
  frame.insert(frame.end(), payload.begin(), payload.end());
  return frame;
}

std::optional<UdpDatagram> udp_datagram(FrameKind kind, Bytes frame) {
  const auto found = ip_packet(kind, frame);
  if (!found || found->size() < kIpSize || (*found)[0] >> 4 != 4) return std::nullopt;
  const Bytes ip = *found;
  const std::size_t header = std::size_t{4} * (ip[0] & 0x0F);
  // The IP length may be wrong: a VLP-16's position packets state 1234, that of its data packets.
  // The payload's end is taken from the UDP length.
  const std::size_t length = std::min<std::size_t>(big16_at(ip, 2), ip.size());
  const bool is_fragment = (big16_at(ip, 6) & 0x3FFF) != 0;
  if (ip[9] != kUdp || is_fragment || header < kIpSize || length < header + kUdpSize)
    return std::nullopt;
  const Bytes udp = ip.subspan(header, length - header);
  const std::size_t udp_length = big16_at(udp, 4);
  if (udp_length < kUdpSize || udp_length > udp.size()) return std::nullopt;
  return UdpDatagram{
      .source_address = static_cast<std::uint32_t>(big16_at(ip, 12)) << 16 | big16_at(ip, 14),
      .destination_port = big16_at(udp, 2),
      .payload = udp.subspan(kUdpSize, udp_length - kUdpSize)};
}

}  // namespace plotscan::record
