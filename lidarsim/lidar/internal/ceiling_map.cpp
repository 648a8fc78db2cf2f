// SPDX-License-Identifier: Apache-2.0
#include "lidar/internal/ceiling_map.h"

#include <algorithm>
#include <cmath>

namespace plotscan::lidar {
namespace {

// Cells along the longer side: each about a centimetre for a plant of medium size.
constexpr double kCells = 96;
// Gives cells to a mesh without extent.
constexpr double kLeastExtent_m = 1e-6;

Eigen::AlignedBox2d footprint_of(const mesh::Mesh& mesh, double margin) {
  Eigen::AlignedBox2d box(Eigen::Vector2d::Zero());
  for (const Eigen::Vector3f& vertex : mesh.vertices)
    box.extend(Eigen::Vector2d(vertex.head<2>().cast<double>()));
  const Eigen::Vector2d around = Eigen::Vector2d::Constant(margin + kLeastExtent_m);
  return {box.min() - around, box.max() + around};
}

// The slope of a triangle's plane along x and y; infinite if it is vertical.
Eigen::Vector2d gradient_of(const std::array<Eigen::Vector3d, 3>& corners) {
  const Eigen::Vector3d normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
  if (normal.z() == 0) return Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity());
  return -normal.head<2>() / normal.z();
}

}  // namespace

CeilingMap::CeilingMap(const Eigen::AlignedBox2d& box, double cells, double margin)
    : margin_(margin),
      low_(box.min()),
      cells_per_metre_(cells / box.sizes().maxCoeff()),
      columns_(std::ceil(cells_per_metre_ * box.sizes().x())),
      rows_(std::ceil(cells_per_metre_ * box.sizes().y())),
      whole_columns_(static_cast<std::ptrdiff_t>(columns_)),
      ceilings_(static_cast<std::size_t>(columns_ * rows_), kNothing) {}

CeilingMap::CeilingMap(const mesh::Mesh& mesh, double margin)
    : CeilingMap(footprint_of(mesh, margin), kCells, margin) {
  for (const Eigen::Vector3f& vertex : mesh.vertices)
    reach_ = std::max(reach_, vertex.head<2>().cast<double>().norm());
  reach_ += margin;
  const Eigen::Vector3d around(margin, margin, 0);
  for (const auto& triangle : mesh.triangles) {
    std::array<Eigen::Vector3d, 3> corners;
    Eigen::AlignedBox3d box;
    for (std::size_t i = 0; i < 3; ++i) {
      corners[i] = mesh.vertices[triangle[i]].cast<double>();
      box.extend(corners[i]);
    }
    raise({box.min() - around, box.max() + around}, corners[0], gradient_of(corners));
  }
}

CeilingMap CeilingMap::of_any_turn(const mesh::Mesh& mesh, double margin) {
  double radius = margin;
  for (const Eigen::Vector3f& vertex : mesh.vertices)
    radius = std::max(radius, vertex.cast<double>().norm() + margin);
  const Eigen::Vector2d corner = Eigen::Vector2d::Constant(radius + kLeastExtent_m);
  CeilingMap map({-corner, corner}, 1, margin);
  map.reach_ = radius;
  map.ceilings_.assign(map.ceilings_.size(), static_cast<float>(radius));
  return map;
}

CeilingMap::Steps CeilingMap::steps_over(const Eigen::Vector2d& start,
                                         const Eigen::Vector2d& step) const {
  // In cells: rounding cannot lead beyond the grid's edge, and so near to it there is nothing.
  constexpr double kInside = 1e-6;
  const Eigen::Vector2d cells(columns_, rows_);
  Steps steps{.first = -std::numeric_limits<double>::infinity(),
              .last = std::numeric_limits<double>::infinity()};
  for (int axis = 0; axis < 2; ++axis) {
    const double at_low = (kInside - start[axis]) / step[axis];
    const double at_high = (cells[axis] - kInside - start[axis]) / step[axis];
    steps.first = std::max(steps.first, std::min(at_low, at_high));
    steps.last = std::min(steps.last, std::max(at_low, at_high));
  }
  return steps;
}

// Within a cell a triangle is no higher than its plane there, and than its highest corner.
void CeilingMap::raise(const Eigen::AlignedBox3d& triangle, const Eigen::Vector3d& on_plane,
                       const Eigen::Vector2d& gradient) {
  const double cell = 1 / cells_per_metre_;
  // How far the plane rises from a cell's middle to its corner and the margin beyond; 1 % more for
  // rounding.
  const double rise = 1.01 * (cell / 2 + margin_) * gradient.cwiseAbs().sum();
  const Eigen::Vector2d first =
      (cells_per_metre_ * (triangle.min().head<2>() - low_)).array().floor().max(0);
  const Eigen::Vector2d last = cells_per_metre_ * (triangle.max().head<2>() - low_);
  for (double row = first.y(); row <= last.y() && row < rows_; ++row) {
    for (double column = first.x(); column <= last.x() && column < columns_; ++column) {
      const Eigen::Vector2d middle = low_ + cell * Eigen::Vector2d(column + 0.5, row + 0.5);
      const double plane = on_plane.z() + gradient.dot(middle - on_plane.head<2>()) + rise;
      const double ceiling = plane < triangle.max().z() ? plane : triangle.max().z();
      float& highest = ceilings_[static_cast<std::size_t>(row * columns_ + column)];
      highest = std::max(highest, static_cast<float>(ceiling));
    }
  }
}

}  // namespace plotscan::lidar
