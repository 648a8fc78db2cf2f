// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "mesh/mesh.h"

namespace plotscan::crop {

enum class Detail {
  scan,   // what a laser should see: every leaf's shape
  light,  // the same plant in few triangles, for programs that show thousands
};

// A round or flattened organ about a path: stem, petiole, pod, grain.
struct Tube {
  std::vector<Eigen::Vector3d> path;  // from base to tip, two points or more
  std::vector<double> radius_m;       // at each point; 0 closes the tube in one vertex there
  int sides = 6;                      // of its cross-section; 2: a flat ribbon
  bool closed_tip = false;            // a lid where the last radius is not 0
  // The direction in which the radius is meant; across it the organ is `flatness` times as thick.
  // Zero: any direction.
  Eigen::Vector3d across = Eigen::Vector3d::Zero();
  double flatness = 1;
  // In light detail: the points of the path that are kept, at least 2, and the sides.
  int light_points = 2;
  int light_sides = 3;
};

// A leaf, a sheet about its midrib: a leaflet, a grass blade. Its one-sided area is the same in
// both details.
struct Blade {
  std::vector<Eigen::Vector3d> midrib;  // from base to tip, two points or more
  std::vector<double> half_width_m;     // at each point of the midrib; 0: a point of the outline
  // At each point, or one for all: towards the blade's left edge, not along the midrib. Made
  // perpendicular to the midrib, so a blade twists when they turn about it.
  std::vector<Eigen::Vector3d> across;
  double fold_rad = 0;  // by which each half is turned upward (along x across) about the midrib
  // In light detail: the points of the midrib that are kept, at least 2. The blade is then flat
  // across, and its widths are scaled so that it keeps its area.
  int light_points = 3;
};

// Joins the organs of one plant to a mesh. Coordinates are whole hundredths of a millimetre, so
// that the mesh is the same with every mathematical library.
class PlantBuilder {
 public:
  // The materials' diffuse colours by name.
  PlantBuilder(Detail detail, const std::map<std::string, Eigen::Vector3f>& colours)
      : detail_(detail), colours_(colours) {}

  bool light() const { return detail_ == Detail::light; }

  // Each adds one organ of a material that has a colour. Texture coordinates: v from 0 at the base
  // to 1 at the tip by length; u across from 0 to 1: of a blade 0.5 at the midrib and 0 and 1 at
  // the edges where it is widest, of a tube once around.
  void tube(const Tube& tube, const std::string& material);
  void blade(const Blade& blade, const std::string& material);
  // Three half axes: along `axis` from the centre, along `across`, and along their cross product.
  void ellipsoid(const Eigen::Vector3d& centre, const Eigen::Vector3d& axis,
                 const Eigen::Vector3d& across, const Eigen::Vector3d& half_axes_m,
                 const std::string& material);

  // The plant, materials in the order in which they were first used. Texture coordinates stay only
  // when a texture will be put on a material.
  mesh::Mesh take(bool textured = false);

 private:
  using Row = std::vector<std::uint32_t>;  // vertices across an organ at one of its points

  Row tube_row(const Eigen::Vector3d& centre, const Eigen::Matrix3d& frame, double radius_m,
               const Tube& tube, int sides, double v);
  void join(const Row& lower, const Row& upper);
  std::uint32_t add_vertex(const Eigen::Vector3d& point, double u, double v);
  void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c);
  void use(const std::string& material);

  Detail detail_;
  std::map<std::string, Eigen::Vector3f> colours_;
  mesh::Mesh mesh_;
  std::uint16_t material_ = 0;  // of the organ that is being added
};

}  // namespace plotscan::crop
