// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include <Eigen/Core>

#include "crop/internal/form.h"
#include "mesh/mesh.h"

namespace plotscan::crop {

// How the surface of an organ is drawn.
enum class Pattern {
  net_veins,       // a midrib with side veins to both sides: the leaflets of soybean
  parallel_veins,  // a midrib with veins along it: the blades of grasses
  fibres,          // stripes along the organ: stems, husks, tassels
  spikelets,       // scales in rows that overlap: the ears of wheat
  pod,             // a downy skin over a row of seeds
};

// The pattern of a form's material by its name: "leaf" of soybean. Materials of other names are
// fibres.
Pattern pattern_of(Form form, const std::string& material);

// A PNG in shades of `colour` (red, green, blue in [0, 1]), which is about its mean. Texture
// coordinates are those of PlantBuilder: u across the organ, v from its base to its tip. The name
// states crop and colour: "soybean_leaf_3f7d2a.png". The same arguments give the same bytes (with
// the same zlib).
std::shared_ptr<const mesh::Image> organ_texture(Form form, const std::string& crop,
                                                 const std::string& material,
                                                 const Eigen::Vector3f& colour);

// Gives every material of the mesh the texture of its name and colour. The colours become white,
// since a texture is multiplied with them. The mesh must have texture coordinates.
void add_textures(mesh::Mesh& mesh, Form form, const std::string& crop);

}  // namespace plotscan::crop
