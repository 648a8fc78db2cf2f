// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "record/recording/flight_record.h"
#include "record/velodyne/internal/nmea.h"
#include "record/velodyne/packet.h"

namespace plotscan::record {

// What a GPS receiver at the body's origin reports for a whole second, from the reported
// trajectory, held at its ends. Without an anchor the fix has no position.
GpsFix gps_fix(const FlightRecord& flight, UtcTime second);

// The position packet that the sensor sends `time_s` after the flight's start: it holds the fix of
// the last whole second, with the clock locked to the receiver's pulse.
PositionPacket position_packet(const FlightRecord& flight, double time_s);

}  // namespace plotscan::record
