// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Geometry>

#include "core/text_file.h"
#include "gazebo/plant_surfaces.h"

namespace plotscan::gazebo {

// An OBJ file for Gazebo's loaders, written surface by surface. Gazebo's loaders compute no
// normals, so these are in the file, rounded to one of about `normal_steps`^2 directions and each
// written once. Memory does not grow with the surfaces. Coordinates are single precision and read
// back as the same numbers.
class ObjFile {
 public:
  // `materials` is the name of the MTL file beside it.
  ObjFile(const std::filesystem::path& path, const std::string& materials, int normal_steps);

  void use_material(const std::string& name);
  // The surface placed by `file_from_surface`; with `both_sides` its back faces as well, for
  // renderers that leave out triangles seen from behind.
  void add(const Surface& surface, const Eigen::Affine3d& file_from_surface, bool both_sides);
  // Throws WriteError when anything could not be written.
  void close();

  std::uint64_t triangles() const { return triangles_; }

 private:
  std::uint32_t normal_id(const Eigen::Vector3d& normal);
  void put_vertices(const Surface& surface, const Eigen::Affine3d& file_from_surface);
  void put_normals(const Surface& surface, const Eigen::Affine3d& file_from_surface,
                   bool both_sides);
  std::uint64_t texture_base(const Surface& surface);
  void put_corner(std::uint64_t vertex, std::uint64_t texture, std::uint32_t normal);
  void put_numbers(std::string_view key, std::initializer_list<float> values);
  void flush();

  TextFile out_;
  std::string buffer_;
  int steps_;
  std::vector<std::uint32_t> normal_ids_;  // by direction; 0: not yet written
  std::uint32_t normals_ = 0;
  std::uint64_t vertices_ = 0;
  std::uint64_t texture_coordinates_ = 0;
  std::map<const Surface*, std::uint64_t> texture_bases_;  // each surface's are written once
  std::uint64_t triangles_ = 0;
  std::vector<std::uint32_t> front_, back_;  // of the surface being added: its normals' ids
};

}  // namespace plotscan::gazebo
