// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "mesh/mesh.h"

namespace plotscan::mesh {

// Renames images (textures and masks) of meshes whose files share a folder: of images with the same
// name and different bytes the second becomes NAME_2, and so on, in the order of the meshes and
// their materials.
void name_images_apart(std::span<Mesh* const> meshes);

}  // namespace plotscan::mesh
