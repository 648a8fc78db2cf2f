// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "planting/model_description.h"

#include "farm/farm.h"

namespace plotscan::planting {

// The files that the models are read from.
std::vector<std::filesystem::path> model_files(const std::vector<ModelDescription>& models);

// Reads or grows the models. Throws InputError when a file cannot be read, a plant cannot be grown
// (naming `source`, the description), has no height, or lacks a material that is given a
// reflectance.
std::vector<farm::PlantModel> make_models(const std::vector<ModelDescription>& models,
                                          const std::filesystem::path& source);

}  // namespace plotscan::planting
