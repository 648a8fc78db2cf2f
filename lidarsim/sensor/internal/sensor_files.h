// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "sensor/sensor.h"

namespace plotscan::sensor {

// The text of models/sensors/NAME.yaml, which must be shipped.
std::string sensor_file(const std::string& name);

// The sensor of that text. Throws InputError as parse_sensor does, and where it has another name:
// what is listed, flown and kept with a scan is one name.
Sensor parse_shipped_sensor(const std::string& description, const std::string& name);

}  // namespace plotscan::sensor
