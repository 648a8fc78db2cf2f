// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace plotscan::sensor {

// Which of a shot's returns a sensor reports; `dual` both the strongest and the last, and where
// these are the same the second strongest (VLP-16 User Manual 63-9243, page 57). The numbers are
// those of the mode byte in Velodyne's packets (the same, section 9.3).
enum class ReturnMode : std::uint8_t { strongest = 0x37, last = 0x38, dual = 0x39 };

// "strongest", "last", "dual".
const std::vector<std::string>& return_mode_names();

// Absent where it is no mode's name.
std::optional<ReturnMode> return_mode(const std::string& name);

}  // namespace plotscan::sensor
