// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "gazebo/static_world.h"

namespace plotscan::gazebo {

struct ReadWorldOptions {
  // Folders to look for model:// names in before all others (docs/scan-format.md has the order).
  std::vector<std::filesystem::path> resource_paths = {};
};

// Reads an SDF world, or the file of a single model, through libsdformat: the visuals of all
// models, nested or included, as they stand when the world starts. Throws InputError when the file
// or one that it includes is missing or cannot be parsed, includes go round in a circle or to the
// network, a mesh is missing or broken, a pose or size is not finite, or nothing is left that a
// laser could meet.
StaticWorld read_world(const std::filesystem::path& file, const ReadWorldOptions& options = {});

}  // namespace plotscan::gazebo
