// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/geodesy.h"
#include "core/utc_time.h"

namespace plotscan::record {

// What a GPS receiver says once a second.
struct GpsFix {
  UtcTime time;
  std::optional<GeodeticPoint> position = {};  // none: the receiver knows only the time
  double speed_m_s = 0;                        // over ground
  double track_deg = 0;                        // clockwise from true north
};

// The recommended minimum sentence of NMEA 0183 version 2.3, "$GPRMC,...*CS" without CR LF, its
// position in steps of a ten millionth of a minute (0.2 mm). Without a position the status is V,
// and position, speed and track are empty.
std::string gprmc(const GpsFix& fix);

// The exclusive or of the characters between '$' and '*'.
unsigned nmea_checksum(std::string_view characters);

}  // namespace plotscan::record
