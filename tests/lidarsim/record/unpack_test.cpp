// SPDX-License-Identifier: Apache-2.0
#include "record/ros/internal/unpack.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <lz4frame.h>
#include <zstd.h>

#include "core/error.h"
#include "temporary_folder.h"

namespace plotscan::record {
namespace {

using ::testing::HasSubstr;
using testing::message_of;

std::vector<char> sample() {
  std::vector<char> bytes(300'000);
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<char>(i * i / 7000);
  return bytes;
}

std::vector<char> packed_by(const std::string& method, const std::vector<char>& bytes) {
  if (method == "none") return bytes;
  std::vector<char> packed(2 * bytes.size() + 1000);
  packed.resize(
      method == "zstd"
          ? ZSTD_compress(packed.data(), packed.size(), bytes.data(), bytes.size(), 3)
          : LZ4F_compressFrame(packed.data(), packed.size(), bytes.data(), bytes.size(), nullptr));
  return packed;
}

TEST(Unpack, TakesBackWhatWasPacked) {
  const auto bytes = sample();
  for (const std::string method : {"none", "lz4", "zstd"})
    EXPECT_TRUE(unpacked(method, packed_by(method, bytes), bytes.size()) == bytes) << method;
}

TEST(Unpack, RefusesSizesThatDoNotFit) {
  const auto bytes = sample();
  for (const std::string method : {"none", "lz4", "zstd"}) {
    const auto packed = packed_by(method, bytes);
    for (const std::uint64_t size :
         {bytes.size() - 1, bytes.size() + 1, std::size_t{0}, ~std::size_t{0}})
      EXPECT_THAT(message_of<InputError>([&] { unpacked(method, packed, size); }),
                  HasSubstr("does not unpack"))
          << method << " " << size;
    const std::span<const char> half(packed.data(), packed.size() / 2);
    EXPECT_THAT(message_of<InputError>([&] { unpacked(method, half, bytes.size()); }),
                HasSubstr("does not unpack"));
  }
  EXPECT_THAT(message_of<InputError>([&] { unpacked("bz2", bytes, bytes.size()); }),
              HasSubstr("compressed by bz2"));
}

}  // namespace
}  // namespace plotscan::record
