// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <optional>
#include <string>

namespace plotscan {

// An instant of Coordinated Universal Time; leap seconds are not counted (as in Unix time).
using UtcTime = std::chrono::sys_time<std::chrono::microseconds>;

// The instant in a text like "2026-06-01T10:00:00Z", seconds with up to six decimals; absent if
// the text is not such an instant of the years 1980 to 2099.
std::optional<UtcTime> parse_utc(const std::string& text);
// The text of an instant in that form, with as many decimals as needed.
std::string format_utc(UtcTime time);

// The instant so many seconds later (finite, at most 1e11 either way), to the nearest microsecond.
UtcTime later(UtcTime time, double seconds);

// Seconds of GPS time since its epoch, 1980-01-06T00:00:00Z: those of UTC and the leap seconds
// until then, of which 18 are known.
double gps_seconds(UtcTime time);
// The instant of a GPS time; within a leap second, which UTC does not count, the second after it.
UtcTime utc_of_gps(double gps_s);

}  // namespace plotscan
