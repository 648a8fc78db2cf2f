// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <sdf/Geometry.hh>
#include <sdf/Mesh.hh>
#include <sdf/Visual.hh>

#include "gazebo/resources.h"
#include "mesh/mesh.h"

// Private to the library: libsdformat's headers are slow to compile.
namespace plotscan::gazebo {

struct Shape {
  std::uint32_t mesh = 0;  // index
  Eigen::Affine3d visual_from_mesh = Eigen::Affine3d::Identity();
};

// The meshes of visuals, each file and primitive once.
class ShapeCache {
 public:
  ShapeCache(const std::filesystem::path& world, const ResourceFinder& finder)
      : world_(world), finder_(finder) {}

  // The visual's geometry; absent where it has none. Throws InputError, naming the visual as
  // `what`, when a mesh is missing or broken, a size is not positive and finite, or the geometry is
  // of a kind that is not read.
  std::optional<Shape> of(const sdf::Visual& visual, const std::string& what);

  // Of a shape's mesh, in its own frame.
  const Eigen::AlignedBox3d& bounds(std::uint32_t mesh) const { return bounds_[mesh]; }
  // The mesh files read.
  const std::vector<std::filesystem::path>& files() const { return files_; }
  // What was left out of them, one line each.
  const std::vector<std::string>& notes() const { return notes_; }
  std::vector<mesh::Mesh> take() { return std::move(meshes_); }

 private:
  Shape of_mesh(const sdf::Mesh& given, const std::string& what);
  std::optional<Shape> of_element(const sdf::Geometry& geometry, const std::string& what);
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
