// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "farm/surface_class.h"
#include "mesh/mesh.h"

namespace plotscan::gazebo {

// A mesh where a visual shows it.
struct PlacedSurface {
  std::uint32_t mesh = 0;  // index into StaticWorld::meshes
  Eigen::Affine3d world_from_mesh = Eigen::Affine3d::Identity();
  farm::SurfaceClass kind = farm::SurfaceClass::other;
  std::uint32_t plot = 0;   // 0: none
  std::uint32_t plant = 0;  // 0: none
};

// All surfaces of an SDF world as it starts, metres, z up.
struct StaticWorld {
  std::string name;
  std::vector<mesh::Mesh> meshes;  // each file and shape once
  std::vector<PlacedSurface> surfaces;
  std::vector<std::filesystem::path> files = {};  // all that were read, the world's first
  std::vector<std::string> notes = {};  // what was left out or taken as still, one line each
};

}  // namespace plotscan::gazebo
