// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include "core/yaml_section.h"
#include "mesh/mesh_import.h"

namespace plotscan::description {

// Values that more than one part of a farm description has, for the readers' .cpp files. They throw
// InputError as the section's own readers do.

// A file that exists, named relative to the description's folder.
std::filesystem::path file_at(const YamlSection& section, const std::string& key);

// The keys `up` and `unit_m` of a mesh file.
mesh::MeshImportOptions read_mesh_options(const YamlSection& section);

// A name for files and tables; `fallback` with '_' for what no name may hold, where the key is
// missing. Without a fallback the key is required.
std::string name_at(const YamlSection& section, const std::string& key,
                    std::optional<std::string> fallback = {});

// A diffuse reflectance, in [0, 1].
double reflectance_at(const YamlSection& section, const std::string& key);

// The key `scale`: least and greatest scale of an axis.
std::pair<double, double> scale_at(const YamlSection& section);

}  // namespace plotscan::description
