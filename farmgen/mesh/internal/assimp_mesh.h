// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/mesh.h"
#include "mesh/mesh_import.h"

struct aiScene;

namespace plotscan::mesh {

// As import_mesh, of a file with that extension (".obj", in small letters), in this very process:
// Assimp crashes on some files. May return a mesh without triangles.
Mesh read_with_assimp(const std::filesystem::path& path, const std::string& extension,
                      const MeshImportOptions& options, std::vector<std::string>* notes);

// The materials of a file as assimp has read it, in its order; as import_mesh says.
std::vector<Material> materials_of(const std::filesystem::path& path, const aiScene& scene,
                                   std::vector<std::string>* notes);

// The text of an OBJ file without what Assimp reads wrongly, though OBJ has it: it takes ".5" for
// no number, and leaves the vertex out, so that faces have other corners; and it refuses a comment
// behind a face. Numbers of vertices get their leading zero, and comments behind vertices and faces
// go; lines stay where they are.
std::string plain_obj(std::string_view text);

}  // namespace plotscan::mesh
