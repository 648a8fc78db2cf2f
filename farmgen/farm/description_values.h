// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "mesh/mesh_import.h"

#include "core/yaml_section.h"

namespace plotscan::farm {

// Values that more than one part of a farm description has, for the readers' .cpp files. They throw
// InputError as the section's own readers do.

// A file that exists, named relative to the description's folder.
std::filesystem::path file_at(const YamlSection& section, const std::string& key);

// The keys `up` and `unit_m` of a mesh file.
mesh::MeshImportOptions read_mesh_options(const YamlSection& section);

}  // namespace plotscan::farm
