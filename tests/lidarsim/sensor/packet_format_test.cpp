// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "sensor/sensor.h"
#include "temporary_folder.h"

namespace plotscan::sensor {
namespace {

using ::testing::HasSubstr;
using testing::message_of;

// The VLP-16 with another `packets` line.
std::string vlp16_with(const std::string& packets) {
  std::string text = load_sensor("vlp16").description;
  const std::size_t at = text.find("packets:");
  return text.replace(at, text.find('\n', at) - at, packets);
}

TEST(PacketFormat, IsReadWhereThereIsOne) {
  const Sensor sensor = load_sensor("vlp16");
  EXPECT_EQ(sensor.packets->product, 0x22);
  EXPECT_EQ(sensor.packets->distance_step_m, 0.002);
  EXPECT_FALSE(parse_sensor(vlp16_with("# none"), "mine.yaml").packets);
}

TEST(PacketFormat, WhatVelodynesPacketsCannotHoldIsRefused) {
  const auto refusal = [](const std::string& text) {
    return message_of<InputError>([&] { parse_sensor(text, "mine.yaml"); });
  };
  EXPECT_THAT(refusal(vlp16_with("packets: {product: 256, distance_mm: 2}")),
              HasSubstr("[0, 255]"));
  EXPECT_THAT(refusal(vlp16_with("packets: {product: 34, distance_mm: 1}")),
              HasSubstr("65535 steps"));
  EXPECT_THAT(refusal(vlp16_with("packets: {product: 34, distance_mm: 2, port: 1}")),
              HasSubstr("port"));
  std::string text = vlp16_with("packets: {product: 34, distance_mm: 2}");
  const std::size_t at = text.find("  - {fires_us: 34.560");
  text.erase(at, text.find('\n', at) + 1 - at);
  EXPECT_THAT(refusal(text), HasSubstr("16 or 32 lasers"));
  text = vlp16_with("packets: {product: 34, distance_mm: 2}");
  for (const auto& [key, other] : {std::pair{"firing_sequence_us: 55.296", "columns_per_turn: 512"},
                                   {"spin_jitter_deg: 0.005", "spin_jitter_deg: 0"}})
    text.replace(text.find(key), std::string(key).size(), other);
  EXPECT_THAT(refusal(text), HasSubstr("fire by the clock"));
}

}  // namespace
}  // namespace plotscan::sensor
