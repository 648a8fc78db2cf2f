// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace plotscan::sensor {

// Which of a shot's returns a sensor reports; `dual`: both the strongest and the last, or, if these
// are the same, also the second strongest (VLP-16 User Manual 63-9243, page 57). The numbers are
// the mode byte in Velodyne's packets (same manual, section 9.3).
enum class ReturnMode : std::uint8_t { strongest = 0x37, last = 0x38, dual = 0x39 };

// The names: "strongest", "last", "dual".
const std::vector<std::string>& return_mode_names();

// The mode of that name; absent if there is none.
std::optional<ReturnMode> return_mode(const std::string& name);

}  // namespace plotscan::sensor
