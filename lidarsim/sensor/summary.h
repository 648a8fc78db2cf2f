// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "sensor/sensor.h"

namespace plotscan::sensor {

// Sensors' main figures, as in a data sheet.

// A table as text: a line of headings, then one line per sensor.
std::vector<std::string> summary_lines(const std::vector<Sensor>& sensors);

// `shots_per_second` is at the default spin. A spinning sensor, which sees all around, has its
// lowest and highest laser and its spin; a Risley scanner the full angle of its field of view.
nlohmann::json summary_json(const Sensor& sensor);

}  // namespace plotscan::sensor
