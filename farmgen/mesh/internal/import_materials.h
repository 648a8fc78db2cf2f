// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mesh/mesh.h"

struct aiScene;

// Private to the library.
namespace plotscan::mesh {

// The materials of a file as assimp has read it, in its order; as import_mesh says.
std::vector<Material> materials_of(const std::filesystem::path& path, const aiScene& scene,
                                   std::vector<std::string>* notes);

}  // namespace plotscan::mesh
