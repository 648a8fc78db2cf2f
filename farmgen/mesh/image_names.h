// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "mesh/mesh.h"

namespace plotscan::mesh {

// For meshes whose files share a folder: of images that have one name and different bytes, textures
// and masks, the second is called NAME_2, and so on, in the order of the meshes and their
// materials.
void name_images_apart(std::span<Mesh* const> meshes);

}  // namespace plotscan::mesh
