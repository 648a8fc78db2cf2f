// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace plotscan::heights {

// The text of a calibration that is part of the library.
std::string calibration_file(const std::string& name);

}  // namespace plotscan::heights
