// SPDX-License-Identifier: Apache-2.0
#include "core/utc_time.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <regex>

#include <fmt/core.h>

namespace plotscan {
namespace {

using namespace std::chrono;

constexpr UtcTime kGpsEpoch = sys_days{1980y / January / 6};

// From each of these days on, UTC is a second more behind GPS time (IERS, Bulletin C; the last one
// known is that of 2017).
constexpr std::array<sys_days, 18> kLeapSeconds = {
    1981y / July / 1,    1982y / July / 1,    1983y / July / 1,    1985y / July / 1,
    1988y / January / 1, 1990y / January / 1, 1991y / January / 1, 1992y / July / 1,
    1993y / July / 1,    1994y / July / 1,    1996y / January / 1, 1997y / July / 1,
    1999y / January / 1, 2006y / January / 1, 2009y / January / 1, 2012y / July / 1,
    2015y / July / 1,    2017y / January / 1};

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
  const seconds leap(std::ranges::upper_bound(kLeapSeconds, floor<days>(time)) -
                     kLeapSeconds.begin());
  return 1e-6 * static_cast<double>((time - kGpsEpoch + leap).count());
}

UtcTime utc_of_gps(double gps_s) {
  // The leap seconds until the instant, found from below: GPS time is ahead of UTC.
  const UtcTime ahead = later(kGpsEpoch, gps_s);
  UtcTime time = later(ahead, gps_s - gps_seconds(ahead));
  return later(time, gps_s - gps_seconds(time));
}

}  // namespace plotscan
