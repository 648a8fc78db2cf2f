// SPDX-License-Identifier: Apache-2.0
#include "record/recording/flight_record.h"

#include <fmt/core.h>

#include "core/error.h"

namespace plotscan::record {

void require_flown(const FlightRecord& flight, double time_s) {
  constexpr double kOutside_s = 1;
  const double duration_s = flight.reported.end_s() - flight.reported.start_s();
  if (time_s >= -kOutside_s && time_s <= duration_s + kOutside_s) return;
  throw InputError(fmt::format(
      "a point was measured {:.2f} s after the trajectory's first pose, and the trajectory takes "
      "{:.2f} s; both have to be in the same time (a LAS of another program counts from the whole "
      "second at or before its first point)",
      time_s, duration_s));
}

}  // namespace plotscan::record
