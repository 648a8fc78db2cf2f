// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Geometry>

#include "farm/surface_class.h"
#include "gazebo/internal/includes.h"
#include "gazebo/internal/resource_finder.h"

namespace plotscan::gazebo {

enum class ShapeKind : std::uint8_t { mesh, box, plane, sphere, cylinder, capsule, polyline };

// A visual's geometry as its world states it; no mesh is read yet.
struct ShapeSpec {
  ShapeKind kind = ShapeKind::box;
  // Of the mesh file, of the shape of size 1, or of the very shape (capsule, polyline).
  Eigen::Affine3d visual_from_mesh = Eigen::Affine3d::Identity();
  double radius_m = 0;  // capsule
  double length_m = 0;  // capsule: of its cylinder; polyline: its height
  std::vector<std::vector<Eigen::Vector2d>> loops = {};  // polyline
  std::string uri = {};                                  // mesh
  std::filesystem::path from = {};                       // mesh: the file that names it
  std::string submesh = {};                              // mesh: its name; empty: all
  bool centred = false;                                  // mesh
};

struct PlacedVisual {
  ShapeSpec shape;
  Eigen::Affine3d world_from_visual = Eigen::Affine3d::Identity();
  farm::SurfaceClass kind = farm::SurfaceClass::other;
  std::uint32_t plot = 0;   // 0: none
  std::uint32_t plant = 0;  // 0: none
  std::string what;         // for messages: model "a", link "b", visual "c"
};

struct WorldVisuals {
  std::string name;
  std::vector<PlacedVisual> visuals;
  std::vector<std::string> notes;
};

// The visuals of a world, or of a single model, that libsdformat reads in this very process: it
// crashes on some files. Throws InputError as read_world does, but for meshes and distances.
WorldVisuals load_world(const std::filesystem::path& file, const Includes& includes,
                        const ResourceFinder& finder);

// A world's visuals as bytes, for another process of the same program.
std::string bytes_of(const WorldVisuals& world);

// The visuals back. Throws std::runtime_error where the bytes hold no visuals.
WorldVisuals world_visuals_of(std::string_view bytes);

}  // namespace plotscan::gazebo
