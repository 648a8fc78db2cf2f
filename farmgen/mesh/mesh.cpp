// SPDX-License-Identifier: Apache-2.0
#include "mesh/mesh.h"

#include "mesh/alpha_mask.h"

namespace plotscan::mesh {
namespace {

using ImagePointer = std::shared_ptr<const Image>;

bool same(const ImagePointer& a, const ImagePointer& b) { return a == b || (a && b && *a == *b); }

bool same_mask(const Material& a, const Material& b) {
  return a.mask == b.mask || (a.mask && b.mask && a.mask->cutoff() == b.mask->cutoff() &&
                              same(a.mask->image(), b.mask->image()));
}

}  // namespace

bool operator==(const Material& a, const Material& b) {
  return a.name == b.name && a.colour == b.colour && a.reflectance == b.reflectance &&
         same(a.texture, b.texture) && same_mask(a, b);
}

Mesh compact(const Mesh& mesh) {
  constexpr std::uint32_t kUnused = ~0u;
  std::vector<std::uint32_t> place(mesh.vertices.size(), kUnused);
  Mesh kept{.vertices = {},
            .triangles = mesh.triangles,
            .materials = mesh.materials,
            .triangle_material = mesh.triangle_material,
            .texture_coordinates = {}};
  for (auto& triangle : kept.triangles) {
    for (std::uint32_t& vertex : triangle) {
      std::uint32_t& moved = place[vertex];
      if (moved == kUnused) {
        moved = static_cast<std::uint32_t>(kept.vertices.size());
        kept.vertices.push_back(mesh.vertices[vertex]);
        if (!mesh.texture_coordinates.empty())
          kept.texture_coordinates.push_back(mesh.texture_coordinates[vertex]);
      }
      vertex = moved;
    }
  }
  return kept;
}

}  // namespace plotscan::mesh
