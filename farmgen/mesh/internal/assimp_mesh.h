// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mesh/mesh.h"
#include "mesh/mesh_import.h"

// Private to the library.
namespace plotscan::mesh {

// As import_mesh, of a file with that extension (".obj", in small letters), in this very process:
// Assimp crashes on some files. May return a mesh without triangles.
Mesh read_with_assimp(const std::filesystem::path& path, const std::string& extension,
                      const MeshImportOptions& options, std::vector<std::string>* notes);

}  // namespace plotscan::mesh
