// SPDX-License-Identifier: Apache-2.0
#include "mesh/mesh.h"

#include <algorithm>

namespace plotscan::mesh {
namespace {

bool same_texture(const Material& a, const Material& b) {
  if (a.texture == nullptr || b.texture == nullptr) return a.texture == b.texture;
  return a.texture == b.texture ||
         (a.texture->name == b.texture->name && a.texture->bytes == b.texture->bytes);
}

bool same(const Material& a, const Material& b) {
  return a.name == b.name && a.colour == b.colour && same_texture(a, b);
}

std::uint16_t index_of(std::vector<Material>& materials, const Material& wanted) {
  const auto found = std::find_if(materials.begin(), materials.end(),
                                  [&](const Material& each) { return same(each, wanted); });
  const auto index = static_cast<std::uint16_t>(found - materials.begin());
  if (found == materials.end()) materials.push_back(wanted);
  return index;
}

}  // namespace

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
