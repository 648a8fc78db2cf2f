// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <utility>

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include "core/random.h"
#include "terrain/internal/base_terrains.h"

namespace plotscan::terrain {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel>;
using Delaunay =
    CGAL::Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<VertexBase>>;
using Triangle = std::array<std::uint32_t, 3>;

}  // namespace

std::vector<Triangle> delaunay_triangles(const std::vector<Eigen::Vector2d>& points) {
  std::vector<std::pair<Kernel::Point_2, std::uint32_t>> input;
  input.reserve(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i)
    input.emplace_back(Kernel::Point_2(points[i].x(), points[i].y()), i);
  const Delaunay delaunay(input.begin(), input.end());
  std::vector<Triangle> triangles;
  triangles.reserve(delaunay.number_of_faces());
  for (const auto& face : delaunay.finite_face_handles()) {
    Triangle triangle = {face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()};
    std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()),
                triangle.end());
    triangles.push_back(triangle);
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

Terrain random_terrain(double side_m, std::uint32_t vertices, double relief_m, std::uint64_t seed) {
  const double half_m = side_m / 2;
  std::vector<Eigen::Vector2d> points = {
      {-half_m, -half_m}, {half_m, -half_m}, {half_m, half_m}, {-half_m, half_m}};
  for (std::uint32_t i = 0; i < vertices; ++i) {
    RandomStream position(seed, random_purpose("terrain/position"), i);
    const double x = position.uniform(-half_m, half_m);
    points.emplace_back(x, position.uniform(-half_m, half_m));
  }
  std::vector<Eigen::Vector3d> surface;
  surface.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    RandomStream height(seed, random_purpose("terrain/height"), i);
    surface.emplace_back(points[i].x(), points[i].y(), height.uniform(-relief_m, relief_m));
  }
  return {std::move(surface), delaunay_triangles(points)};
}

}  // namespace plotscan::terrain
