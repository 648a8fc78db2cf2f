// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <nlohmann/json.hpp>

namespace plotscan::report {

using Bytes = std::vector<std::uint8_t>;

// Appends whole numbers in a form that a page reads fast: each as its difference from the one
// before (modulo 2^16), mapped so that small differences of either sign give small numbers (0, -1,
// 1, -2 become 0, 1, 2, 3); first all low bytes, then all high bytes.
void append_differences(Bytes& bytes, std::span<const std::uint16_t> numbers);

// The bytes compressed as a zlib stream (RFC 1950).
Bytes deflated(const Bytes& bytes);

// Packs numbers, rounded to multiples of `step`, or of a coarser step if their range needs it: {n,
// low, step, data}; value i is low + step * data[i], 65535 stands for NaN, and data are binary,
// deflated differences.
nlohmann::json packed_numbers(std::span<const float> numbers, double step);

}  // namespace plotscan::report
