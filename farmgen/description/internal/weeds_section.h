// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "planting/model_description.h"
#include "planting/weeds_description.h"

namespace plotscan {
class YamlSection;
}

namespace plotscan::description {

// The `weeds` section of farm.yaml (docs/farm-format.md); its models are appended to `models`.
// Throws InputError as load_description does.
planting::WeedsDescription read_weeds(const YamlSection& section,
                                      std::vector<planting::ModelDescription>& models);

}  // namespace plotscan::description
