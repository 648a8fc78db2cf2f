// SPDX-License-Identifier: Apache-2.0
#include "record/velodyne/internal/nmea.h"

#include <cmath>

#include <fmt/chrono.h>

namespace plotscan::record {
namespace {

using namespace std::chrono;

constexpr double kKnot_m_s = 1852.0 / 3600.0;
constexpr double kMinuteSteps = 1e7;  // digits after the minutes' point

// "4807.0380000,N": whole degrees, then minutes. The angle is rounded before it is split, so that
// no sentence says 60 minutes.
std::string angle_text(double angle_deg, int degree_digits, char positive, char negative) {
  const auto steps = std::llround(std::abs(angle_deg) * 60 * kMinuteSteps);
  const auto degree_steps = static_cast<long long>(60 * kMinuteSteps);
  return fmt::format("{:0{}}{:010.7f},{}", steps / degree_steps, degree_digits,
                     static_cast<double>(steps % degree_steps) / kMinuteSteps,
                     angle_deg < 0 ? negative : positive);
}

std::string position_text(const GpsFix& fix) {
  if (!fix.position) return ",,,,,";
  double track_deg = std::round(10 * fix.track_deg) / 10;
  if (track_deg >= 360) track_deg -= 360;
  return angle_text(fix.position->latitude_deg, 2, 'N', 'S') + "," +
         angle_text(fix.position->longitude_deg, 3, 'E', 'W') +
         fmt::format(",{:05.1f},{:05.1f}", fix.speed_m_s / kKnot_m_s, track_deg);
}

}  // namespace

unsigned nmea_checksum(std::string_view characters) {
  unsigned sum = 0;
  for (const char character : characters) sum ^= static_cast<unsigned char>(character);
  return sum;
}

std::string gprmc(const GpsFix& fix) {
  const std::tm clock = fmt::gmtime(floor<seconds>(fix.time.time_since_epoch()).count());
  const std::string text =
      fmt::format("GPRMC,{:%H%M%S},{},{},{:%d%m%y},,,{}", clock, fix.position ? 'A' : 'V',
                  position_text(fix), clock, fix.position ? 'A' : 'N');
  return fmt::format("${}*{:02X}", text, nmea_checksum(text));
}

}  // namespace plotscan::record
