// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "planting/model_description.h"

namespace plotscan {
class YamlSection;
}

namespace plotscan::description {

// Reads the list at the section's key "models", appends the entries that `models` does not hold
// yet, and returns the indices of all in `models`. Throws InputError as load_description does, and
// when two entries of the list, or two different models, have one name.
std::vector<std::uint32_t> read_models(const YamlSection& section,
                                       std::vector<planting::ModelDescription>& models);

}  // namespace plotscan::description
