// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "farm/farm.h"

namespace plotscan::farmfolder {

// truth/plants.csv: one line a plant (docs/farm-format.md).
void write_plants(const std::filesystem::path& path, const farm::Farm& farm, int threads);

// Reads what write_plants writes; `models` are those that the model column may name. Throws
// InputError on a missing column, a value that is not finite, a scale that is not positive, an
// invalid rotation, an unknown model, or ids that do not run from 1.
std::vector<farm::Plant> read_plants(const std::filesystem::path& path,
                                     const std::vector<farm::PlantModel>& models);

}  // namespace plotscan::farmfolder
