// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "mesh/mesh.h"

namespace plotscan {
class TextFile;
}

namespace plotscan::mesh {

// Writes the mesh as Wavefront OBJ, metres, z up, its triangles grouped by material. Where the mesh
// has materials, NAME.mtl beside it holds them (Kd, map_Kd, map_d, and Pr and Pm for physically
// based renderers; reflectances as comments, see write_optics) and their images lie beside it under
// their own names. Throws WriteError when a file cannot be written.
void write_obj(const std::filesystem::path& path, const Mesh& mesh);

// Writes what a material of an MTL file states besides its look: `map_d` with the mask's image in
// the folder `images` ("" or "folder/"), and the comments "# reflectance_903nm" and "#
// alpha_cutoff" with a number each, where it states them. import_mesh reads them back.
void write_optics(TextFile& mtl, const Material& material, const std::string& images);

}  // namespace plotscan::mesh
