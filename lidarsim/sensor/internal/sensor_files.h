// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace plotscan::sensor {

// The text of models/sensors/NAME.yaml, which must be shipped.
std::string sensor_file(const std::string& name);

}  // namespace plotscan::sensor
