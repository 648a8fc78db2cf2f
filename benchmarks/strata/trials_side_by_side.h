// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "core/random.h"
#include "strata/plant_draw.h"

namespace plotscan::strata {

// Places trials beside each other as stations do: 1 to 6 m apart, in one heading, along or across
// it; in a quarter of the fields all but the first are turned by 5 to 40 degrees from that.
// `trials`: each the overrides of `field` (field.yaml) that draw it alone. Returns overrides of
// trials.yaml: `trials`, and `terrain.side_m`, which holds all. Throws InputError as
// load_description.
Overrides side_by_side(const std::vector<Overrides>& trials, const std::filesystem::path& field,
                       RandomStream& random);

}  // namespace plotscan::strata
