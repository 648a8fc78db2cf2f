// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <Eigen/Core>

#include "gazebo/static_world.h"

namespace plotscan::testing {

// A world's file around its content.
inline std::string world_text(const std::string& content) {
  return "<?xml version='1.0'?>\n<sdf version='1.9'>\n<world name='by_hand'>\n" + content +
         "\n</world>\n</sdf>\n";
}

inline std::string visual_text(const std::string& geometry, const std::string& more = "",
                               const std::string& name = "v") {
  return "<visual name='" + name + "'>" + more + "<geometry>" + geometry + "</geometry></visual>";
}

// A static model of one link and its visuals.
inline std::string model_text(const std::string& name, const std::string& pose,
                              const std::string& visuals) {
  return "<model name='" + name + "'><static>true</static><pose>" + pose +
         "</pose><link name='link'>" + visuals + "</link></model>";
}

// The vertices of a surface where they stand in the world.
inline std::vector<Eigen::Vector3d> world_vertices(const gazebo::StaticWorld& world,
                                                   const gazebo::PlacedSurface& surface) {
  std::vector<Eigen::Vector3d> vertices;
  for (const Eigen::Vector3f& vertex : world.meshes.at(surface.mesh).vertices)
    vertices.emplace_back(surface.world_from_mesh * vertex.cast<double>());
  return vertices;
}

// A triangle with corners (0, 0, 0), (1, 0, 0) and (0, 2, 3), and one far away in another object.
inline std::string two_objects_obj() {
  return "o near\nv 0 0 0\nv 1 0 0\nv 0 2 3\nf 1 2 3\n"
         "o far\nv 10 0 0\nv 12 0 0\nv 10 4 6\nf 4 5 6\n";
}

}  // namespace plotscan::testing
