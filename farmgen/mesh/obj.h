// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "mesh/mesh.h"

namespace plotscan::mesh {

// Writes the mesh as Wavefront OBJ, metres, z up, its triangles grouped by material. Where the mesh
// has materials, NAME.mtl beside it holds them (Kd, map_Kd, and Pr and Pm for physically
// based renderers) and their images lie beside it under
// their own names. Throws InputError when a file cannot be written.
void write_obj(const std::filesystem::path& path, const Mesh& mesh);

}  // namespace plotscan::mesh
