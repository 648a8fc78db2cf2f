// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <vector>

#include "mesh/mesh.h"

namespace plotscan::testing {

// Puts a mesh's triangles after those of another. Both are of one material or know that of each
// triangle; materials that are equal become one.
inline void append(mesh::Mesh& mesh, const mesh::Mesh& other) {
  std::vector<std::uint16_t> place;
  for (const mesh::Material& material : other.materials) {
    const auto found = std::ranges::find(mesh.materials, material);
    place.push_back(static_cast<std::uint16_t>(found - mesh.materials.begin()));
    if (found == mesh.materials.end()) mesh.materials.push_back(material);
  }
  mesh.triangle_material.resize(mesh.triangles.size(), 0);
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (std::size_t i = 0; i < other.triangles.size(); ++i) {
    const auto& [a, b, c] = other.triangles[i];
    mesh.triangles.push_back({first + a, first + b, first + c});
    mesh.triangle_material.push_back(place[other.material_of(i)]);
  }
  mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
  mesh.texture_coordinates.insert(mesh.texture_coordinates.end(), other.texture_coordinates.begin(),
                                  other.texture_coordinates.end());
}

}  // namespace plotscan::testing
