// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace plotscan::record {

// Bytes of Ethernet, IPv4 and UDP headers before a datagram's payload.
inline constexpr std::size_t kUdpHeaders = 42;

// A datagram as a Velodyne sensor broadcasts it from its factory settings: from 192.168.1.201 to
// 255.255.255.255, with the same source and destination port and, like a VLP-16, no UDP checksum
// (0, RFC 768).
std::vector<std::uint8_t> broadcast_frame(std::uint16_t port,
                                          std::span<const std::uint8_t> payload);

struct UdpDatagram {
  std::uint32_t source_address = 0;
  std::uint16_t destination_port = 0;
  std::span<const std::uint8_t> payload;  // a part of the frame
};

// The outermost protocol of a recording's frames.
enum class FrameKind { ethernet, linux_cooked, linux_cooked_2, ip };

// The whole UDP datagram in a frame; VLAN tags (IEEE 802.1Q) are skipped. Absent if there is none:
// another protocol, a fragment, or fewer bytes than UDP's header promises.
std::optional<UdpDatagram> udp_datagram(FrameKind kind, std::span<const std::uint8_t> frame);

}  // namespace plotscan::record
