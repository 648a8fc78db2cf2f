// SPDX-License-Identifier: Apache-2.0
#include "mesh/measure.h"

#include <algorithm>
#include <limits>

#include <Eigen/Geometry>

#include "mesh/reflectance.h"

namespace plotscan::mesh {
namespace {

bool is_leaf(const Material& material) { return names_leaf(material.name); }

}  // namespace

double mesh_height(const Mesh& mesh) {
  double highest = -std::numeric_limits<double>::infinity();
  for (const Eigen::Vector3f& vertex : mesh.vertices)
    highest = std::max(highest, static_cast<double>(vertex.z()));
  return highest;
}

ScaledArea::ScaledArea(const Mesh& mesh) {
  for (const auto& triangle : mesh.triangles) add(mesh, triangle);
}

ScaledArea ScaledArea::of_leaves(const Mesh& mesh) {
  if (std::none_of(mesh.materials.begin(), mesh.materials.end(), is_leaf)) return ScaledArea(mesh);
  ScaledArea area;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    if (is_leaf(mesh.materials[mesh.material_of(i)])) area.add(mesh, mesh.triangles[i]);
  return area;
}

void ScaledArea::add(const Mesh& mesh, const std::array<std::uint32_t, 3>& triangle) {
  const Eigen::Vector3d a = mesh.vertices[triangle[0]].cast<double>();
  const Eigen::Vector3d ab = mesh.vertices[triangle[1]].cast<double>() - a;
  const Eigen::Vector3d ac = mesh.vertices[triangle[2]].cast<double>() - a;
  const Eigen::Array3d squares = ab.cross(ac).array().square();
  for (int axis = 0; axis < 3; ++axis)
    cross_squares_[static_cast<std::size_t>(axis)].push_back(squares[axis]);
}

double ScaledArea::at(const Eigen::Vector3d& scale) const {
  // The cross product of scaled edges is the cross product scaled by the other two axes.
  const Eigen::Array3d factor(scale.y() * scale.z(), scale.z() * scale.x(), scale.x() * scale.y());
  const auto squares = [&](std::size_t axis) {
    const std::vector<double>& all = cross_squares_[axis];
    const double by = factor.square()[static_cast<Eigen::Index>(axis)];
    return by * Eigen::Map<const Eigen::ArrayXd>(all.data(), static_cast<Eigen::Index>(all.size()));
  };
  return (squares(0) + squares(1) + squares(2)).sqrt().sum() / 2;
}

}  // namespace plotscan::mesh
