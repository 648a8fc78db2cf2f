// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace plotscan::crop {

// The text of models/CROP/CROP.yaml as it was when the library was configured.
std::string crop_file(const std::string& crop);

}  // namespace plotscan::crop
