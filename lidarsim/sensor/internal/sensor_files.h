// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "sensor/sensor.h"

namespace plotscan::sensor {

// The text of models/sensors/NAME.yaml, which Plotscan must ship.
std::string sensor_file(const std::string& name);

// Parses that text. Throws InputError as parse_sensor does, and when the sensor in it has another
// name: a sensor is listed, flown and kept with a scan under one name.
Sensor parse_shipped_sensor(const std::string& description, const std::string& name);

}  // namespace plotscan::sensor
