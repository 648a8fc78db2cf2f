// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "farm/farm.h"
#include "gazebo/export_options.h"
#include "gazebo/plant_models.h"

namespace plotscan::gazebo {

// Writes the README.md of an exported world: how it is opened, and what is in it.
void write_readme(const std::filesystem::path& path, const farm::Farm& farm,
                  const ExportOptions& options, const EntityCounts& counts);

}  // namespace plotscan::gazebo
