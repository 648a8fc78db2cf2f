// SPDX-License-Identifier: Apache-2.0
#include "series/internal/dates.h"

#include <regex>

#include "series/series.h"

namespace plotscan::series {

std::optional<UtcTime> day_of(const std::string& date) { return parse_utc(date + "T00:00:00Z"); }

std::string date_in(const std::string& name) {
  static const std::regex kDate("(^|[^0-9])([0-9]{4})([-_]?)([0-9]{2})\\3([0-9]{2})(?![0-9])");
  for (std::sregex_iterator found(name.begin(), name.end(), kDate), end; found != end; ++found) {
    std::string date = (*found)[2].str() + "-" + (*found)[4].str() + "-" + (*found)[5].str();
    if (day_of(date)) return date;
  }
  return name;
}

std::optional<int> days_between(const std::string& from, const std::string& to) {
  const std::optional<UtcTime> first = day_of(from);
  const std::optional<UtcTime> last = day_of(to);
  if (!first || !last) return std::nullopt;
  return static_cast<int>(std::chrono::duration_cast<std::chrono::days>(*last - *first).count());
}

}  // namespace plotscan::series
