// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "core/utc_time.h"

namespace plotscan::series {

// The day's beginning; absent unless the text is a day of the calendar, "2026-06-01".
std::optional<UtcTime> day_of(const std::string& date);

// The date in a folder's name ("wheat_2026-06-01", "20260601_wheat"), as YYYY-MM-DD; the whole name
// where there is none.
std::string date_in(const std::string& name);

}  // namespace plotscan::series
