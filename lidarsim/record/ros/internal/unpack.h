// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace plotscan::record {

// Unpacks bytes that were packed with "lz4" (its frame format) or "zstd"; returns a copy if
// `method` is "" or "none". `size` is the unpacked size. Throws InputError on another method, on
// bytes that do not unpack to `size` bytes, and on a size beyond 1 GiB.
std::vector<char> unpacked(const std::string& method, std::span<const char> packed,
                           std::uint64_t size);

}  // namespace plotscan::record
