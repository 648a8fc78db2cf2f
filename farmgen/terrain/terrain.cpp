// SPDX-License-Identifier: Apache-2.0
#include "terrain/terrain.h"

#include <algorithm>
#include <utility>

#include <fmt/core.h>

#include "core/error.h"
#include "core/list_of.h"
#include "core/plot_box.h"

namespace plotscan::terrain {
namespace {

using Triangle = std::array<std::uint32_t, 3>;
using Vertices = std::vector<Eigen::Vector3d>;

// Beyond an edge by this share of the triangle's size, a point is still on the triangle: where
// rounding puts a point on a shared edge outside both of its triangles, it has a height all the
// same.
constexpr double kEdgeTolerance = 1e-9;

// Twice the signed area seen from above.
double double_area(const Vertices& vertices, const Triangle& triangle) {
  const Eigen::Vector2d a = vertices[triangle[0]].head<2>();
  const Eigen::Vector2d b = vertices[triangle[1]].head<2>();
  const Eigen::Vector2d c = vertices[triangle[2]].head<2>();
  return plane_cross(b - a, c - a);
}

void require_sound(const Vertices& vertices, const std::vector<Triangle>& triangles) {
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (!vertices[i].allFinite())
      throw InputError(fmt::format("terrain vertex {} is not finite", i));
    if (vertices[i].cwiseAbs().maxCoeff() > kFarthest_m)
      throw InputError(
          fmt::format("terrain vertex {} is more than 100 km from the farm's centre", i));
  }
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (const std::uint32_t vertex : triangles[i]) {
      if (vertex < vertices.size()) continue;
      throw InputError(
          fmt::format("terrain triangle {} names vertex {} of {}", i, vertex, vertices.size()));
    }
  }
}

std::vector<Triangle> facing_up(const Vertices& vertices, std::vector<Triangle> triangles) {
  require_sound(vertices, triangles);
  std::erase_if(triangles,
                [&](const Triangle& triangle) { return double_area(vertices, triangle) == 0; });
  if (triangles.empty()) throw InputError("terrain has no triangle with an area seen from above");
  for (Triangle& triangle : triangles)
    if (double_area(vertices, triangle) < 0) std::swap(triangle[1], triangle[2]);
  return triangles;
}

// Shares of the triangle's corners in the point, summing to 1. At a corner exactly one of them is
// not zero, so that the height there is the vertex's own.
Eigen::Vector3d barycentric(const Vertices& vertices, const Triangle& triangle,
                            const Eigen::Vector2d& point) {
  const Eigen::Vector2d a = vertices[triangle[0]].head<2>() - point;
  const Eigen::Vector2d b = vertices[triangle[1]].head<2>() - point;
  const Eigen::Vector2d c = vertices[triangle[2]].head<2>() - point;
  const Eigen::Vector3d shares(plane_cross(b, c), plane_cross(c, a), plane_cross(a, b));
  return shares / shares.sum();
}

}  // namespace

Terrain::Terrain(Vertices vertices, std::vector<Triangle> triangles)
    : vertices_(std::move(vertices)),
      triangles_(facing_up(vertices_, std::move(triangles))),
      grid_(vertices_, triangles_) {}

Terrain::Place Terrain::place_in(std::uint32_t index, const Eigen::Vector2d& point) const {
  const Triangle& triangle = triangles_[index];
  const Eigen::Vector3d shares = barycentric(vertices_, triangle, point);
  return {.z = shares.x() * vertices_[triangle[0]].z() + shares.y() * vertices_[triangle[1]].z() +
               shares.z() * vertices_[triangle[2]].z(),
          .least_share = shares.minCoeff()};
}

std::optional<double> Terrain::height(double x, double y) const {
  const Eigen::Vector2d point(x, y);
  std::optional<double> highest;
  std::optional<double> nearest;  // of the triangle that misses the point by least
  double least_share = -kEdgeTolerance;
  for (const std::uint32_t index : grid_.candidates(x, y)) {
    const auto [z, share] = place_in(index, point);
    if (!(share >= least_share)) continue;
    if (share >= 0)
      highest = std::max(z, highest.value_or(z));
    else
      nearest = z;
    least_share = std::min(share, 0.0);
  }
  return highest ? highest : nearest;
}

std::optional<double> Terrain::height_near(double x, double y, std::uint32_t& triangle) const {
  const Eigen::Vector2d point(x, y);
  if (const Place place = place_in(triangle, point); place.least_share >= 0) return place.z;
  for (const std::uint32_t index : grid_.candidates(x, y)) {
    const Place place = place_in(index, point);
    if (!(place.least_share >= 0)) continue;
    triangle = index;
    return place.z;
  }
  return height(x, y);  // on an edge, to rounding
}

mesh::Mesh mesh_of(const Terrain& terrain) {
  const auto single = [](const Eigen::Vector3d& vertex) { return vertex.cast<float>(); };
  return {.vertices = list_of<Eigen::Vector3f>(terrain.vertices(), single),
          .triangles = terrain.triangles()};
}

}  // namespace plotscan::terrain
