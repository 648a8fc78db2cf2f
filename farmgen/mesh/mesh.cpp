// SPDX-License-Identifier: Apache-2.0
#include "mesh/mesh.h"

#include <algorithm>

#include "mesh/alpha_mask.h"

namespace plotscan::mesh {
namespace {

using ImagePointer = std::shared_ptr<const Image>;

bool same(const ImagePointer& a, const ImagePointer& b) {
  if (a == nullptr || b == nullptr) return a == b;
  return a == b || (a->name == b->name && a->bytes == b->bytes);
}

bool same_mask(const Material& a, const Material& b) {
  if (a.mask == nullptr || b.mask == nullptr) return a.mask == b.mask;
  return a.mask == b.mask ||
         (a.mask->cutoff() == b.mask->cutoff() && same(a.mask->image(), b.mask->image()));
}

std::uint16_t index_of(std::vector<Material>& materials, const Material& wanted) {
  const auto found = std::find(materials.begin(), materials.end(), wanted);
  const auto index = static_cast<std::uint16_t>(found - materials.begin());
  if (found == materials.end()) materials.push_back(wanted);
  return index;
}

}  // namespace

bool operator==(const Material& a, const Material& b) {
  return a.name == b.name && a.colour == b.colour && a.reflectance == b.reflectance &&
         same(a.texture, b.texture) && same_mask(a, b);
}

void append(Mesh& mesh, const Mesh& other) {
  if (!mesh.triangles.empty() && mesh.materials.empty()) mesh.materials.emplace_back();
  mesh.triangle_material.resize(mesh.triangles.size(), 0);
  std::vector<std::uint16_t> material;
  for (const Material& each : other.materials) material.push_back(index_of(mesh.materials, each));
  if (material.empty()) material.push_back(index_of(mesh.materials, Material{}));
  if (!other.texture_coordinates.empty() || !mesh.texture_coordinates.empty()) {
    mesh.texture_coordinates.resize(mesh.vertices.size(), Eigen::Vector2f::Zero());
    mesh.texture_coordinates.insert(mesh.texture_coordinates.end(),
                                    other.texture_coordinates.begin(),
                                    other.texture_coordinates.end());
    mesh.texture_coordinates.resize(mesh.vertices.size() + other.vertices.size(),
                                    Eigen::Vector2f::Zero());
  }
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (std::size_t i = 0; i < other.triangles.size(); ++i) {
    const auto& [a, b, c] = other.triangles[i];
    mesh.triangles.push_back({first + a, first + b, first + c});
    mesh.triangle_material.push_back(material[other.material_of(i)]);
  }
}

}  // namespace plotscan::mesh
