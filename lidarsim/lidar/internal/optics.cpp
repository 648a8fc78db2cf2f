// SPDX-License-Identifier: Apache-2.0
#include "lidar/internal/optics.h"

#include <algorithm>

#include "core/error.h"
#include "mesh/alpha_mask.h"
#include "mesh/reflectance.h"

namespace plotscan::lidar {

MeshOptics::MeshOptics(const mesh::Mesh& mesh) {
  for (const mesh::Material& material : mesh.materials)
    reflectance_.push_back(mesh::reflectance_of(material).value_or(-1.0F));
  if (reflectance_.empty()) reflectance_.push_back(-1);
  const auto has_mask = [](const mesh::Material& material) { return material.mask != nullptr; };
  const bool masked = !mesh.texture_coordinates.empty() &&
                      std::any_of(mesh.materials.begin(), mesh.materials.end(), has_mask);
  const bool alike = std::all_of(reflectance_.begin(), reflectance_.end(),
                                 [&](float each) { return each == reflectance_.front(); });
  if (!alike || masked) triangle_material_ = mesh.triangle_material;
  if (!masked) return;
  check(mesh.texture_coordinates.size() == mesh.vertices.size(), "every vertex has its texture's");
  for (const mesh::Material& material : mesh.materials) masks_.push_back(material.mask);
  triangles_ = mesh.triangles;
  texture_coordinates_ = mesh.texture_coordinates;
}

bool MeshOptics::is_opaque(std::uint32_t triangle, float u, float v) const {
  const auto& mask = masks_[triangle_material_.empty() ? 0 : triangle_material_[triangle]];
  if (mask == nullptr) return true;
  const auto& [a, b, c] = triangles_[triangle];
  return mask->is_opaque((1 - u - v) * texture_coordinates_[a] + u * texture_coordinates_[b] +
                         v * texture_coordinates_[c]);
}

}  // namespace plotscan::lidar
