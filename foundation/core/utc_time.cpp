// SPDX-License-Identifier: Apache-2.0
#include "core/utc_time.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <regex>

#include <fmt/core.h>

namespace plotscan {
namespace {

using namespace std::chrono;

constexpr seconds kLeapSeconds{18};
constexpr UtcTime kGpsEpoch = sys_days{1980y / January / 6};

int whole(const std::ssub_match& digits) {
  int value = 0;
  std::from_chars(&*digits.first, &*digits.first + digits.length(), value);
  return value;
}

microseconds decimals(const std::ssub_match& digits) {
  std::string text = digits.str();
  text.resize(6, '0');
  return microseconds(std::stoi(text));
}

}  // namespace

std::optional<UtcTime> parse_utc(const std::string& text) {
  static const std::regex pattern(R"((\d{4})-(\d\d)-(\d\d)T(\d\d):(\d\d):(\d\d)(?:\.(\d{1,6}))?Z)");
  std::smatch part;
  if (!std::regex_match(text, part, pattern)) return std::nullopt;
  const year_month_day date = year(whole(part[1])) / whole(part[2]) / whole(part[3]);
  const hours hour(whole(part[4]));
  const minutes minute(whole(part[5]));
  const seconds second(whole(part[6]));
  if (!date.ok() || date.year() < 1980y || date.year() > 2099y || hour >= days(1) ||
      minute >= hours(1) || second >= minutes(1))
    return std::nullopt;
  return sys_days(date) + hour + minute + second +
         (part[7].matched ? decimals(part[7]) : microseconds(0));
}

std::string format_utc(UtcTime time) {
  const sys_days day = floor<days>(time);
  const year_month_day date(day);
  const hh_mm_ss clock(time - day);
  std::string text = fmt::format(
      "{:04}-{:02}-{:02}T{:02}:{:02}:{:02}", static_cast<int>(date.year()),
      static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()),
      static_cast<int>(clock.hours().count()), static_cast<int>(clock.minutes().count()),
      static_cast<int>(clock.seconds().count()));
  if (clock.subseconds().count() != 0) {
    text += fmt::format(".{:06}", static_cast<int>(clock.subseconds().count()));
    text.erase(text.find_last_not_of('0') + 1);
  }
  return text + "Z";
}

UtcTime later(UtcTime time, double seconds) {
  constexpr double kMost_s = 1e11;  // more than 3,000 years
  return time + microseconds(std::llround(1e6 * std::clamp(seconds, -kMost_s, kMost_s)));
}

double gps_seconds(UtcTime time) {
  return 1e-6 * static_cast<double>((time - kGpsEpoch + kLeapSeconds).count());
}

}  // namespace plotscan
