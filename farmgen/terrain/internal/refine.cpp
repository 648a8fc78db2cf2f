// SPDX-License-Identifier: Apache-2.0
#include "terrain/internal/refine.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include <fmt/core.h>

#include "core/error.h"
#include "core/list_of.h"
#include "terrain/internal/base_terrains.h"

namespace plotscan::terrain {
namespace {

using Points = std::vector<Eigen::Vector2d>;
using Triangle = std::array<std::uint32_t, 3>;

// A base is flat across an edge when the far corner of one triangle lies this close to the plane of
// the other: rounding, not relief.
constexpr double kFlat_m = 1e-9;

// No lattice point lies closer to a point on an edge than this share of the edge points' greatest
// distance s. A point in the circle about a piece of the edge is within s / sqrt(2) of one of its
// ends; where none is, the piece is an edge of the Delaunay triangulation.
constexpr double kClearance = 0.7072;

double step_of(const Patch& patch) {
  return std::min(patch.layout.column_step_m, patch.layout.row_step_m);
}

struct Edge {
  std::array<std::uint32_t, 2> ends;  // the lower one first
  std::uint32_t apex;                 // the triangle's third corner
};

std::vector<Edge> sorted_edges(const std::vector<Triangle>& triangles) {
  std::vector<Edge> edges;
  edges.reserve(3 * triangles.size());
  for (const Triangle& triangle : triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [low, high] = std::minmax(triangle[i], triangle[(i + 1) % 3]);
      edges.push_back({{low, high}, triangle[(i + 2) % 3]});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
    return std::pair(a.ends, a.apex) < std::pair(b.ends, b.apex);
  });
  return edges;
}

bool is_flat(const std::vector<Eigen::Vector3d>& vertices, const Edge& one, const Edge& other) {
  const Eigen::Vector3d& origin = vertices[one.ends[0]];
  const Eigen::Vector3d normal =
      (vertices[one.ends[1]] - origin).cross(vertices[one.apex] - origin).normalized();
  return std::abs(normal.dot(vertices[other.apex] - origin)) <= kFlat_m;
}

// The edges at which the surface is bent or ends.
std::vector<std::array<std::uint32_t, 2>> breaklines(const Terrain& base) {
  const std::vector<Edge> edges = sorted_edges(base.triangles());
  std::vector<std::array<std::uint32_t, 2>> lines;
  for (std::size_t i = 0; i < edges.size();) {
    std::size_t end = i + 1;
    while (end < edges.size() && edges[end].ends == edges[i].ends) ++end;
    const bool flat = end - i == 2 && is_flat(base.vertices(), edges[i], edges[i + 1]);
    if (!flat) lines.push_back(edges[i].ends);
    i = end;
  }
  return lines;
}

// The greatest distance of vertices along the segment: that of the last patch it passes through;
// endless outside all of them.
double step_along(const std::vector<Patch>& patches, const Eigen::Vector2d& a,
                  const Eigen::Vector2d& b) {
  Eigen::AlignedBox2d box(a);
  box.extend(b);
  for (auto patch = patches.rbegin(); patch != patches.rend(); ++patch)
    if (patch->box.intersects(box)) return step_of(*patch);
  return std::numeric_limits<double>::infinity();
}

// Adds the points that halve the segment until its pieces are short enough.
void divide(const std::vector<Patch>& patches, const Eigen::Vector2d& a, const Eigen::Vector2d& b,
            Points& points) {
  if ((b - a).norm() <= step_along(patches, a, b)) return;
  const Eigen::Vector2d middle = (a + b) / 2;
  points.push_back(middle);
  divide(patches, a, middle, points);
  divide(patches, middle, b, points);
}

[[noreturn]] void fail_too_many_edges() {
  throw InputError(fmt::format(
      "terrain: its base has so many bent edges that following them takes more than {} vertices; a "
      "greater terrain.step_m, a smaller terrain.detail_m or a coarser base would fit",
      kMostTerrainVertices));
}

// The base's vertices and the points along its breaklines.
Points base_points(const Terrain& base, const std::vector<Patch>& patches) {
  Points points;
  for (const Eigen::Vector3d& vertex : base.vertices()) points.emplace_back(vertex.head<2>());
  for (const auto& [from, to] : breaklines(base)) {
    divide(patches, base.vertices()[from].head<2>(), base.vertices()[to].head<2>(), points);
    if (points.size() > kMostTerrainVertices) fail_too_many_edges();
  }
  return points;
}

// Which points of a lattice are too close to one of the others.
class Crowded {
 public:
  Crowded(const Lattice& lattice, double clearance_m)
      : lattice_(lattice),
        clearance_m_(clearance_m),
        crowded_(static_cast<std::size_t>(lattice.rows * lattice.columns)) {}

  void add(const Eigen::Vector2d& point) {
    const double across_m = lattice_.across.norm();
    const double along_m = lattice_.along.norm();
    const Eigen::Vector2d offset = point - lattice_.origin;
    const double row = offset.dot(lattice_.across) / (across_m * across_m);
    const double column = offset.dot(lattice_.along) / (along_m * along_m);
    const double row_reach = clearance_m_ / across_m;
    const double column_reach = clearance_m_ / along_m + 0.5;  // every other row is shifted
    for_each_index(row, row_reach, lattice_.rows, [&](Eigen::Index r) {
      for_each_index(column, column_reach, lattice_.columns, [&](Eigen::Index c) {
        if ((lattice_.point(r, c) - point).norm() < clearance_m_) crowded_[place(r, c)] = true;
      });
    });
  }

  bool at(Eigen::Index row, Eigen::Index column) const { return crowded_[place(row, column)]; }

 private:
  std::size_t place(Eigen::Index row, Eigen::Index column) const {
    return static_cast<std::size_t>(row * lattice_.columns + column);
  }

  template <class Visit>
  static void for_each_index(double middle, double reach, Eigen::Index count, Visit visit) {
    const auto end = static_cast<double>(count);
    const auto first = static_cast<Eigen::Index>(std::clamp(std::ceil(middle - reach), 0.0, end));
    const auto last =
        static_cast<Eigen::Index>(std::clamp(std::floor(middle + reach), -1.0, end - 1));
    for (Eigen::Index i = first; i <= last; ++i) visit(i);
  }

  const Lattice& lattice_;
  double clearance_m_;
  std::vector<bool> crowded_;
};

void add_lattice_vertices(const Terrain& base, const Relief& relief,
                          const std::vector<Patch>& patches, std::size_t which,
                          const Points& others, std::vector<Eigen::Vector3d>& vertices) {
  const Patch& patch = patches[which];
  const Lattice lattice = lattice_over(patch.box, patch.layout);
  Crowded crowded(lattice, kClearance * step_of(patch));
  for (const Eigen::Vector2d& point : others) crowded.add(point);
  const Eigen::MatrixXd relief_m = relief.heights(lattice);
  for (Eigen::Index row = 0; row < lattice.rows; ++row) {
    for (Eigen::Index column = 0; column < lattice.columns; ++column) {
      const Eigen::Vector2d point = lattice.point(row, column);
      const bool finer =
          std::any_of(patches.begin() + static_cast<std::ptrdiff_t>(which) + 1, patches.end(),
                      [&](const Patch& later) { return later.box.contains(point); });
      if (finer || !patch.box.contains(point) || crowded.at(row, column)) continue;
      const auto base_m = base.height(point.x(), point.y());
      if (base_m) vertices.emplace_back(point.x(), point.y(), *base_m + relief_m(row, column));
    }
  }
}

std::vector<Triangle> triangles_on(const Terrain& base,
                                   const std::vector<Eigen::Vector3d>& vertices) {
  const Points points = list_of<Eigen::Vector2d>(
      vertices, [](const Eigen::Vector3d& vertex) { return vertex.head<2>(); });
  std::vector<Triangle> triangles = delaunay_triangles(points);
  // The triangulation fills the convex hull; the base need not.
  std::erase_if(triangles, [&](const Triangle& triangle) {
    const Eigen::Vector2d middle =
        (points[triangle[0]] + points[triangle[1]] + points[triangle[2]]) / 3;
    return !base.height(middle.x(), middle.y());
  });
  return triangles;
}

Terrain raised(const Terrain& base, const Relief& relief) {
  std::vector<Eigen::Vector3d> vertices = base.vertices();
  for (Eigen::Vector3d& vertex : vertices) vertex.z() += relief.height(vertex.head<2>());
  return {std::move(vertices), base.triangles()};
}

}  // namespace

double refined_vertices(const Terrain& base, const std::vector<Patch>& patches) {
  auto count = static_cast<double>(base.vertices().size());
  for (const Patch& patch : patches)
    count += patch.box.volume() / (patch.layout.column_step_m * patch.layout.row_step_m);
  return count;
}

Terrain refined(const Terrain& base, const Relief& relief, const std::vector<Patch>& patches) {
  if (patches.empty()) return raised(base, relief);
  const Points points = base_points(base, patches);
  std::vector<Eigen::Vector3d> vertices;
  for (const Eigen::Vector2d& point : points) {
    const auto base_m = base.height(point.x(), point.y());
    if (base_m) vertices.emplace_back(point.x(), point.y(), *base_m + relief.height(point));
  }
  for (std::size_t i = 0; i < patches.size(); ++i)
    add_lattice_vertices(base, relief, patches, i, points, vertices);
  return {vertices, triangles_on(base, vertices)};
}

}  // namespace plotscan::terrain
