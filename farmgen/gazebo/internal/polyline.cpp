// SPDX-License-Identifier: Apache-2.0
#include <deque>

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <fmt/core.h>

#include "core/error.h"
#include "gazebo/internal/primitive_meshes.h"

namespace plotscan::gazebo {
namespace {

constexpr int kUnknown = -1;
constexpr std::size_t kMostPoints = 2000;  // whose edges may cross, each every other

// The number of loops that a face lies within, and the number of a vertex.
struct Depth {
  int loops = kUnknown;
};
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel>;
using FaceBase = CGAL::Constrained_triangulation_face_base_2<
    Kernel, CGAL::Triangulation_face_base_with_info_2<Depth, Kernel>>;
using Structure = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
// Loops may cross: crossings become vertices.
using Triangulation =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure, CGAL::Exact_predicates_tag>;

Triangulation triangulated(const std::vector<std::vector<Eigen::Vector2d>>& loops) {
  std::size_t points = 0;
  for (const auto& loop : loops) points += loop.size();
  if (points > kMostPoints) {
    throw InputError(
        fmt::format("a polyline has {} points; at most {} are read", points, kMostPoints));
  }
  Triangulation triangulation;
  for (const auto& loop : loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Eigen::Vector2d& a = loop[i];
      const Eigen::Vector2d& b = loop[(i + 1) % loop.size()];
      if (a != b) triangulation.insert_constraint({a.x(), a.y()}, {b.x(), b.y()});
    }
  }
  return triangulation;
}

// From outside inwards: crossing a loop's edge leads one deeper. A face's number is the least of
// all ways to it, so a bridge that a loop runs along twice, to its own hole and back, does not
// count.
void count_loops(const Triangulation& triangulation) {
  if (triangulation.dimension() < 2) return;
  struct Way {
    Triangulation::Face_handle face;
    int loops = 0;
  };
  std::deque<Way> open = {{triangulation.infinite_face(), 0}};  // fewer loops first
  while (!open.empty()) {
    const Way way = open.front();
    open.pop_front();
    if (way.face->info().loops != kUnknown) continue;
    way.face->info().loops = way.loops;
    for (int edge = 0; edge < 3; ++edge)
      if (way.face->is_constrained(edge))
        open.push_back({way.face->neighbor(edge), way.loops + 1});
      else
        open.push_front({way.face->neighbor(edge), way.loops});
  }
}

bool is_inside(Triangulation::Face_handle face) { return face->info().loops % 2 == 1; }

}  // namespace

mesh::Mesh extruded(const std::vector<std::vector<Eigen::Vector2d>>& loops, double height_m) {
  Triangulation triangulation = triangulated(loops);
  count_loops(triangulation);
  mesh::Mesh mesh;
  for (const auto vertex : triangulation.finite_vertex_handles()) {
    vertex->info() = static_cast<std::uint32_t>(mesh.vertices.size());
    const Eigen::Vector2f place(static_cast<float>(vertex->point().x()),
                                static_cast<float>(vertex->point().y()));
    mesh.vertices.emplace_back(place.x(), place.y(), 0.0F);
    mesh.vertices.emplace_back(place.x(), place.y(), static_cast<float>(height_m));
  }
  for (const auto face : triangulation.finite_face_handles()) {
    if (!is_inside(face)) continue;
    std::array<std::uint32_t, 3> low{};  // the vertices at the bottom; one more is that at the top
    for (int i = 0; i < 3; ++i) low[i] = face->vertex(i)->info();
    mesh.triangles.push_back({low[0], low[2], low[1]});
    mesh.triangles.push_back({low[0] + 1, low[1] + 1, low[2] + 1});
    for (int edge = 0; edge < 3; ++edge) {
      if (is_inside(face->neighbor(edge))) continue;
      const std::uint32_t a = low[(edge + 1) % 3];
      const std::uint32_t b = low[(edge + 2) % 3];
      mesh.triangles.push_back({a, b, b + 1});
      mesh.triangles.push_back({a, b + 1, a + 1});
    }
  }
  if (mesh.triangles.empty()) throw InputError("a polyline encloses no area");
  return mesh;
}

}  // namespace plotscan::gazebo
