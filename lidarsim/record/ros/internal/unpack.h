// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace plotscan::record {

// The `size` bytes that were packed by "lz4" (its frame format) or "zstd"; a copy where `method` is
// "" or "none". Throws InputError on another method, on bytes that do not unpack to that size, and
// on a size beyond 1 GiB.
std::vector<char> unpacked(const std::string& method, std::span<const char> packed,
                           std::uint64_t size);

}  // namespace plotscan::record
