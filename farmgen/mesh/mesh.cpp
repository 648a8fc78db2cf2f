// SPDX-License-Identifier: Apache-2.0
#include "mesh/mesh.h"

#include <algorithm>

#include <meshoptimizer.h>

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

// The mesh's triangles with that material, or none.
std::vector<unsigned> indices_with(const Mesh& mesh, std::uint16_t material) {
  std::vector<unsigned> indices;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (mesh.material_of(i) != material) continue;
    indices.insert(indices.end(), mesh.triangles[i].begin(), mesh.triangles[i].end());
  }
  return indices;
}

// Without the vertices that no triangle names.
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

Mesh simplified(const Mesh& mesh, std::size_t triangles) {
  if (mesh.triangles.size() <= triangles) return mesh;
  Mesh coarse = mesh;
  coarse.triangles.clear();
  coarse.triangle_material.clear();
  const std::size_t materials = std::max<std::size_t>(1, mesh.materials.size());
  for (std::uint16_t material = 0; material < materials; ++material) {
    const std::vector<unsigned> indices = indices_with(mesh, material);
    if (indices.empty()) continue;
    // Each material keeps its share of the triangles.
    const std::size_t wanted = 3 * (indices.size() / 3 * triangles / mesh.triangles.size());
    std::vector<unsigned> kept(indices.size());
    kept.resize(meshopt_simplifySloppy(kept.data(), indices.data(), indices.size(),
                                       mesh.vertices.front().data(), mesh.vertices.size(),
                                       sizeof(Eigen::Vector3f), wanted, 1.0F, nullptr));
    for (std::size_t i = 0; i + 2 < kept.size(); i += 3) {
      coarse.triangles.push_back({kept[i], kept[i + 1], kept[i + 2]});
      coarse.triangle_material.push_back(material);
    }
  }
  return compact(coarse);
}

}  // namespace plotscan::mesh
