// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "gazebo/internal/load_world.h"
#include "gazebo/internal/resource_finder.h"
#include "mesh/mesh.h"

namespace plotscan::gazebo {

// The meshes of visuals, each file and primitive once.
class ShapeCache {
 public:
  ShapeCache(const std::filesystem::path& world, const ResourceFinder& finder)
      : world_(world), finder_(finder) {}

  // The mesh of a visual's geometry: its index. Throws InputError, naming the visual as `what`,
  // when a mesh is missing or broken, or a polyline encloses no area.
  std::uint32_t of(const ShapeSpec& given, const std::string& what);

  // Bounding box of a shape's mesh, in its own frame.
  const Eigen::AlignedBox3d& bounds(std::uint32_t mesh) const { return bounds_[mesh]; }
  // The mesh files read.
  const std::vector<std::filesystem::path>& files() const { return files_; }
  // What was left out of them, one line each.
  const std::vector<std::string>& notes() const { return notes_; }
  std::vector<mesh::Mesh> take() { return std::move(meshes_); }

 private:
  std::uint32_t of_mesh(const ShapeSpec& given, const std::string& what);
  std::uint32_t of_polyline(const ShapeSpec& given, const std::string& what);
  template <class Make>
  std::uint32_t index(const std::string& key, Make&& make);

  std::filesystem::path world_;
  const ResourceFinder& finder_;
  std::map<std::string, std::uint32_t> index_;  // by what makes the mesh
  std::vector<mesh::Mesh> meshes_;
  std::vector<Eigen::AlignedBox3d> bounds_;  // of meshes_
  std::vector<std::filesystem::path> files_;
  std::vector<std::string> notes_;
};

}  // namespace plotscan::gazebo
