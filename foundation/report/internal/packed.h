// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <nlohmann/json.hpp>

namespace plotscan::report {

using Bytes = std::vector<std::uint8_t>;

// Appends whole numbers as a page reads them fast: differences from the one before (modulo 2^16),
// folded so that small ones of either sign are small (0, -1, 1, -2: 0, 1, 2, 3), all low bytes,
// then all high bytes.
void append_differences(Bytes& bytes, std::span<const std::uint16_t> numbers);

// As zlib writes them (RFC 1950).
Bytes deflated(const Bytes& bytes);

// Numbers rounded to multiples of `step`, a coarser one where their range needs it: {n, low, step,
// data}; value i is low + step * data[i], 65535 stands for NaN, and data are binary, deflated
// differences.
nlohmann::json packed_numbers(std::span<const float> numbers, double step);

}  // namespace plotscan::report
