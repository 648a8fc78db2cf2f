// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/mesh.h"

namespace plotscan::mesh {

// Writes the mesh as Wavefront OBJ, metres, z up, its triangles grouped by material. Where the mesh
// has materials, NAME.mtl beside it holds them (Kd, map_Kd, map_d, and Pr and Pm for physically
// based renderers; reflectances as comments, see write_mtl) and their images lie beside it under
// their own names. Throws WriteError when a file cannot be written.
void write_obj(const std::filesystem::path& path, const Mesh& mesh);

// A material of an MTL file.
struct MtlEntry {
  std::string name;
  Material material;
  std::string images = {};  // the folder of its images with a slash behind; empty: beside the file
};

// Writes an MTL file: diffuse and ambient colour, the lines `matt` (how a material shines), map_Kd
// with the texture, map_d with the mask's image, and the comments "# reflectance_903nm" and "#
// alpha_cutoff" with a number each, where a material states them. import_mesh reads them back.
void write_mtl(const std::filesystem::path& path, const std::vector<MtlEntry>& entries,
               std::string_view matt);

// Writes the images of the material into the folder, under their own names.
void write_images(const std::filesystem::path& folder, const Material& material);

// The text with '_' for each character but ASCII letters, digits and those of `also`.
std::string plain_name(std::string text, std::string_view also);

// A plain name for each material, no two alike; `nameless` is for those without a name.
std::vector<std::string> distinct_names(const std::vector<Material>& materials,
                                        const std::string& nameless, std::string_view also);

}  // namespace plotscan::mesh
