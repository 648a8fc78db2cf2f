// SPDX-License-Identifier: Apache-2.0
#include "core/utc_time.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <regex>

#include <fmt/chrono.h>

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
  const auto whole = [&](std::size_t i) { return std::stoi(part[i]); };
  const year_month_day date = year(whole(1)) / whole(2) / whole(3);
  const hours hour(whole(4));
  const minutes minute(whole(5));
  const seconds second(whole(6));
  if (!date.ok() || date.year() < 1980y || date.year() > 2099y || hour >= days(1) ||
      minute >= hours(1) || second >= minutes(1))
    return std::nullopt;
  return sys_days(date) + hour + minute + second +
         (part[7].matched ? decimals(part[7]) : microseconds(0));
}

std::string format_utc(UtcTime time) {
  const auto second = floor<seconds>(time);
  std::string text =
      fmt::format("{:%Y-%m-%dT%H:%M:%S}", fmt::gmtime(second.time_since_epoch().count()));
  if (time != second) {
    text += fmt::format(".{:06}", (time - second).count());
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
