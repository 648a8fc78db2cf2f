// SPDX-License-Identifier: Apache-2.0
#include "record/velodyne/internal/nmea.h"

#include <charconv>
#include <cmath>
#include <vector>

#include <fmt/core.h>

namespace plotscan::record {
namespace {

using namespace std::chrono;

constexpr double kKnot_m_s = 1852.0 / 3600.0;
constexpr double kMinuteSteps = 1e7;  // digits after the minutes' point

// "4807.0380000,N": whole degrees, then minutes. Rounded as a whole, so that no sentence says 60
// minutes.
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

std::vector<std::string_view> fields_of(std::string_view text) {
  std::vector<std::string_view> fields;
  while (true) {
    const std::size_t comma = text.find(',');
    fields.push_back(text.substr(0, comma));
    if (comma == std::string_view::npos) return fields;
    text.remove_prefix(comma + 1);
  }
}

std::optional<double> number(std::string_view text) {
  double value = 0;
  const auto end = text.data() + text.size();
  const auto parsed = std::from_chars(text.data(), end, value, std::chars_format::fixed);
  if (text.empty() || parsed.ec != std::errc() || parsed.ptr != end || value < 0)
    return std::nullopt;
  return value;
}

std::optional<UtcTime> time_of(std::string_view clock, std::string_view date) {
  if (clock.size() < 6 || date.size() != 6) return std::nullopt;
  const auto part = [](std::string_view text, std::size_t at) {
    return std::string(text.substr(at, 2));
  };
  // Two digits of the year: GPS began in 1980.
  const char* century = part(date, 4) < "80" ? "20" : "19";
  return parse_utc(century + part(date, 4) + "-" + part(date, 2) + "-" + part(date, 0) + "T" +
                   part(clock, 0) + ":" + part(clock, 2) + ":" + part(clock, 4) +
                   std::string(clock.substr(6)) + "Z");
}

std::optional<double> angle_of(std::string_view text, std::string_view side, char negative) {
  const auto value = number(text);
  if (!value || side.size() != 1) return std::nullopt;
  const double degrees = std::floor(*value / 100);
  const double angle_deg = degrees + (*value - 100 * degrees) / 60;
  return side.front() == negative ? -angle_deg : angle_deg;
}

}  // namespace

unsigned nmea_checksum(std::string_view characters) {
  unsigned sum = 0;
  for (const char character : characters) sum ^= static_cast<unsigned char>(character);
  return sum;
}

std::string gprmc(const GpsFix& fix) {
  const sys_days day = floor<days>(fix.time);
  const year_month_day date(day);
  const hh_mm_ss clock(floor<seconds>(fix.time - day));
  const auto two_digits = [](auto value) { return fmt::format("{:02}", static_cast<int>(value)); };
  const std::string text =
      "GPRMC," + two_digits(clock.hours().count()) + two_digits(clock.minutes().count()) +
      two_digits(clock.seconds().count()) + (fix.position ? ",A," : ",V,") + position_text(fix) +
      "," + two_digits(static_cast<unsigned>(date.day())) +
      two_digits(static_cast<unsigned>(date.month())) +
      two_digits(static_cast<int>(date.year()) % 100) + ",,," + (fix.position ? "A" : "N");
  return "$" + text + fmt::format("*{:02X}", nmea_checksum(text));
}

std::optional<GpsFix> parse_rmc(const std::string& sentence) {
  const std::size_t star = sentence.find('*');
  if (!(sentence.starts_with("$GPRMC,") || sentence.starts_with("$GNRMC,")) ||
      star == std::string::npos)
    return std::nullopt;
  const std::string_view text = std::string_view(sentence).substr(1, star - 1);
  if (sentence.substr(star + 1) != fmt::format("{:02X}", nmea_checksum(text))) return std::nullopt;
  const auto fields = fields_of(text);
  if (fields.size() < 10) return std::nullopt;
  const auto time = time_of(fields[1], fields[9]);
  if (!time) return std::nullopt;
  GpsFix fix{.time = *time};
  const auto latitude_deg = angle_of(fields[3], fields[4], 'S');
  const auto longitude_deg = angle_of(fields[5], fields[6], 'W');
  if (fields[2] == "A" && latitude_deg && longitude_deg)
    fix.position = {.latitude_deg = *latitude_deg, .longitude_deg = *longitude_deg};
  fix.speed_m_s = number(fields[7]).value_or(0) * kKnot_m_s;
  fix.track_deg = number(fields[8]).value_or(0);
  return fix;
}

}  // namespace plotscan::record
