// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "farm/farm.h"
#include "gazebo/export_options.h"
#include "mesh/mesh.h"

namespace plotscan::gazebo {

// The triangles of a mesh that have one material, over vertices of their own.
struct Surface {
  std::size_t material = 0;  // index into PlantSurfaces::materials
  std::vector<Eigen::Vector3f> vertices;
  std::vector<Eigen::Vector3f> normals;              // of unit length, one a vertex, smooth
  std::vector<Eigen::Vector2f> texture_coordinates;  // one a vertex, or empty
  std::vector<std::array<std::uint32_t, 3>> triangles;
  bool closed = false;  // nobody sees its inside: every edge belongs to two triangles
};

// The plant meshes of a farm, cut by material.
struct PlantSurfaces {
  std::vector<mesh::Material> materials;  // of all models; equal ones once
  std::vector<std::string> names;  // of the materials: letters, digits, '-', '_'; no two alike
  std::vector<std::vector<Surface>> models;  // by farm::Farm::models
};

// The surfaces of a mesh that shows its materials' names; `materials` gains those it lacks.
std::vector<Surface> surfaces_of(const mesh::Mesh& mesh, std::vector<mesh::Material>& materials);

PlantSurfaces plant_surfaces(const farm::Farm& farm, Detail lod);

}  // namespace plotscan::gazebo
