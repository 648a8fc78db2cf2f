// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "mesh/mesh.h"

namespace plotscan::lidar {

// The optical properties of one mesh's triangles.
class MeshOptics {
 public:
  explicit MeshOptics(const mesh::Mesh& mesh);

  // The triangle's diffuse reflectance at 903 nm, in [0, 1]; `otherwise` if neither its material
  // nor the material's name states one.
  float reflectance(std::uint32_t triangle, float otherwise) const {
    const float stated =
        reflectance_[triangle_material_.empty() ? 0 : triangle_material_[triangle]];
    return stated < 0 ? otherwise : stated;
  }

  // Whether a ray can pass through any triangle, by a hole of a mask.
  bool has_masks() const { return !masks_.empty(); }
  // Whether the triangle is opaque (no hole of its mask) at p0 + u (p1 - p0) + v (p2 - p0).
  bool is_opaque(std::uint32_t triangle, float u, float v) const;

 private:
  std::vector<float> reflectance_;                // of each material; negative: not stated
  std::vector<std::uint16_t> triangle_material_;  // empty: all have the first
  // The mask of each material, null if it has none; empty if no material has one.
  std::vector<std::shared_ptr<const mesh::AlphaMask>> masks_;
  std::vector<std::array<std::uint32_t, 3>> triangles_;
  std::vector<Eigen::Vector2f> texture_coordinates_;
};

}  // namespace plotscan::lidar
