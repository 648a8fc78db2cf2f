// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include <Eigen/Core>

#include "farm/mesh.h"

namespace plotscan::farm {

// Writes the mesh as Wavefront OBJ, metres, z up, under a comment line that says so.
void write_obj(const std::filesystem::path& path, const Mesh& mesh);

// The same with a material of one colour (red, green, blue in [0, 1]) in a .mtl file beside it.
void write_coloured_obj(const std::filesystem::path& path, const Mesh& mesh,
                        const Eigen::Vector3f& colour);

}  // namespace plotscan::farm
