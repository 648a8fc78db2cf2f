// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <set>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <meshoptimizer.h>

#include "core/list_of.h"
#include "mesh/mesh.h"

namespace plotscan::mesh {
namespace {

constexpr float kAnyError = std::numeric_limits<float>::max();
// More would turn what is left of a crumpled part into a sail.
constexpr double kMostWidening = 2;

// Triangles as meshoptimizer takes them: three vertices each.
using Indices = std::vector<unsigned>;

// A connected surface of one material: a leaf, a stem.
struct Part {
  std::uint16_t material = 0;
  Indices indices;         // of the mesh's vertices
  Indices farthest;        // those of its vertices that bound the whole mesh
  std::size_t budget = 0;  // triangles that may be left
};

// Vertices that bound the mesh: the highest first, since a plant's height counts most.
Indices farthest_vertices(const Mesh& mesh, const Indices& all) {
  Indices farthest;
  for (const int axis : {2, 0, 1}) {
    const auto [low, high] = std::minmax_element(
        all.begin(), all.end(),
        [&](unsigned a, unsigned b) { return mesh.vertices[a][axis] < mesh.vertices[b][axis]; });
    farthest.insert(farthest.end(), {*high, *low});
  }
  return farthest;
}

// A vertex of the connected surface of each vertex; vertices at one place are connected.
Indices surface_of_vertices(const Mesh& mesh, const Indices& all) {
  Indices parent(mesh.vertices.size());
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&](unsigned vertex) {
    while (parent[vertex] != vertex) vertex = parent[vertex] = parent[parent[vertex]];
    return vertex;
  };
  Indices joined(all.size());
  meshopt_generateShadowIndexBuffer(joined.data(), all.data(), all.size(),
                                    mesh.vertices.front().data(), mesh.vertices.size(),
                                    sizeof(Eigen::Vector3f), sizeof(Eigen::Vector3f));
  for (std::size_t i = 0; i < all.size(); ++i) {
    parent[root(all[i])] = root(joined[i]);
    parent[root(joined[i])] = root(joined[i - i % 3]);
  }
  for (unsigned vertex = 0; vertex < parent.size(); ++vertex) parent[vertex] = root(vertex);
  return parent;
}

std::vector<Part> parts_of(const Mesh& mesh) {
  Indices all;
  for (const auto& triangle : mesh.triangles)
    all.insert(all.end(), triangle.begin(), triangle.end());
  const Indices surface = surface_of_vertices(mesh, all);
  std::map<std::pair<std::uint16_t, unsigned>, Part> parts;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& triangle = mesh.triangles[i];
    Part& part = parts[{mesh.material_of(i), surface[triangle[0]]}];
    part.material = mesh.material_of(i);
    part.indices.insert(part.indices.end(), triangle.begin(), triangle.end());
  }
  const Indices farthest = farthest_vertices(mesh, all);
  std::vector<Part> list;
  for (auto& [key, part] : parts) {
    const std::set<unsigned> own(part.indices.begin(), part.indices.end());
    for (const unsigned vertex : farthest)
      if (own.contains(vertex)) part.farthest.push_back(vertex);
    list.push_back(std::move(part));
  }
  return list;
}

// Gives each part its share of the triangles; where that is less than one, the parts whose share is
// largest have one. Parts that bound the mesh stay.
void share_out(std::vector<Part>& parts, std::size_t total, std::size_t triangles) {
  std::size_t given = 0;
  std::vector<std::pair<std::size_t, std::size_t>> rest;  // remainder of the share, part
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const std::size_t share = parts[i].indices.size() / 3 * triangles;
    parts[i].budget = std::max<std::size_t>(share / total, parts[i].farthest.empty() ? 0 : 2);
    given += parts[i].budget;
    rest.emplace_back(share % total, i);
  }
  std::stable_sort(rest.begin(), rest.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  for (std::size_t i = 0; i < rest.size() && given < triangles; ++i, ++given)
    ++parts[rest[i].second].budget;
}

double area_of(const std::vector<Eigen::Vector3f>& vertices, const Indices& indices,
               std::size_t first) {
  const Eigen::Vector3d a = vertices[indices[first]].cast<double>();
  const Eigen::Vector3d b = vertices[indices[first + 1]].cast<double>();
  const Eigen::Vector3d c = vertices[indices[first + 2]].cast<double>();
  return (b - a).cross(c - a).norm() / 2;
}

double area_of(const std::vector<Eigen::Vector3f>& vertices, const Indices& indices) {
  double area = 0;
  for (std::size_t i = 0; i + 2 < indices.size(); i += 3) area += area_of(vertices, indices, i);
  return area;
}

Indices largest_triangle(const std::vector<Eigen::Vector3f>& vertices, const Indices& indices) {
  std::size_t largest = 0;
  for (std::size_t i = 3; i + 2 < indices.size(); i += 3)
    if (area_of(vertices, indices, i) > area_of(vertices, indices, largest)) largest = i;
  return {indices[largest], indices[largest + 1], indices[largest + 2]};
}

// Collapses edges, which keeps outlines; where a surface's seams and knots forbid that, joins
// whatever is near. At least one triangle is left. The indices are dense: of these vertices alone.
Indices collapsed(const std::vector<Eigen::Vector3f>& vertices, const Indices& indices,
                  std::size_t triangles) {
  const float* positions = vertices.front().data();
  constexpr std::size_t kStride = sizeof(Eigen::Vector3f);
  Indices kept(indices.size());
  kept.resize(meshopt_simplify(kept.data(), indices.data(), indices.size(), positions,
                               vertices.size(), kStride, 3 * triangles, kAnyError, 0, nullptr));
  if (kept.size() > 3 * triangles) {
    kept.resize(indices.size());
    kept.resize(meshopt_simplifySloppy(kept.data(), indices.data(), indices.size(), positions,
                                       vertices.size(), kStride, 3 * triangles, kAnyError,
                                       nullptr));
  }
  return kept.empty() ? largest_triangle(vertices, indices) : kept;
}

// The part in its budget of triangles, as indices of the mesh's vertices.
Indices coarser(const Mesh& mesh, const Part& part) {
  Indices own(part.indices);
  std::sort(own.begin(), own.end());
  own.erase(std::unique(own.begin(), own.end()), own.end());
  const std::vector<Eigen::Vector3f> vertices =
      list_of(own, [&](unsigned vertex) { return mesh.vertices[vertex]; });
  Indices dense;
  for (const unsigned vertex : part.indices) {
    dense.push_back(
        static_cast<unsigned>(std::lower_bound(own.begin(), own.end(), vertex) - own.begin()));
  }
  Indices kept = collapsed(vertices, dense, part.budget);
  for (unsigned& vertex : kept) vertex = own[vertex];
  return kept;
}

// Moves the nearest vertices in use to where the mesh reaches farthest, so that its extent and
// above all its height stay.
void keep_farthest(const Mesh& mesh, const Part& part, Indices& kept) {
  std::set<unsigned> fixed;
  for (const unsigned farthest : part.farthest) {
    const auto distance = [&](unsigned vertex) {
      return fixed.contains(vertex)
                 ? std::numeric_limits<float>::max()
                 : (mesh.vertices[vertex] - mesh.vertices[farthest]).squaredNorm();
    };
    const unsigned nearest =
        *std::min_element(kept.begin(), kept.end(),
                          [&](unsigned a, unsigned b) { return distance(a) < distance(b); });
    if (!fixed.contains(nearest)) std::replace(kept.begin(), kept.end(), nearest, farthest);
    fixed.insert(farthest);
  }
}

// Stretches the part's vertices across their longest axis by the factor: a leaf keeps its length
// and both ends.
void widen(std::vector<Eigen::Vector3f>& vertices, const Indices& kept, double factor) {
  const std::set<unsigned> part(kept.begin(), kept.end());
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (const unsigned vertex : part) centre += vertices[vertex].cast<double>();
  centre /= static_cast<double>(part.size());
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const unsigned vertex : part) {
    const Eigen::Vector3d offset = vertices[vertex].cast<double>() - centre;
    scatter += offset * offset.transpose();
  }
  // Axes in the order of rising spread.
  const Eigen::Vector3d across =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(scatter).eigenvectors().col(1);
  for (const unsigned vertex : part) {
    const Eigen::Vector3d offset = vertices[vertex].cast<double>() - centre;
    vertices[vertex] += ((factor - 1) * offset.dot(across) * across).cast<float>();
  }
}

// Gives the part the area back that it lost with its outline's corners. A bent leaf grows less than
// it is widened: hence more than once.
void keep_area(const Mesh& mesh, const Part& part, const Indices& kept,
               std::vector<Eigen::Vector3f>& vertices) {
  const double whole = area_of(mesh.vertices, part.indices);
  double widened = 1;
  for (int round = 0; round < 4; ++round) {
    const double left = area_of(vertices, kept);
    if (left <= 0 || left >= whole) break;
    const double factor = std::min(whole / left, kMostWidening / widened);
    widen(vertices, kept, factor);
    widened *= factor;
    for (const unsigned vertex : part.farthest) vertices[vertex] = mesh.vertices[vertex];
  }
}

}  // namespace

Mesh simplified(const Mesh& mesh, std::size_t triangles) {
  if (mesh.triangles.size() <= triangles || mesh.triangles.empty()) return mesh;
  Mesh coarse = mesh;
  coarse.triangles.clear();
  coarse.triangle_material.clear();
  std::vector<Part> parts = parts_of(mesh);
  share_out(parts, mesh.triangles.size(), triangles);
  for (const Part& part : parts) {
    if (part.budget == 0) continue;
    Indices kept = coarser(mesh, part);
    keep_farthest(mesh, part, kept);
    keep_area(mesh, part, kept, coarse.vertices);
    for (std::size_t i = 0; i + 2 < kept.size(); i += 3) {
      coarse.triangles.push_back({kept[i], kept[i + 1], kept[i + 2]});
      coarse.triangle_material.push_back(part.material);
    }
  }
  Eigen::AlignedBox3f extent;
  for (const Eigen::Vector3f& vertex : mesh.vertices) extent.extend(vertex);
  for (Eigen::Vector3f& vertex : coarse.vertices)
    vertex = vertex.cwiseMax(extent.min()).cwiseMin(extent.max());
  return compact(coarse);
}

}  // namespace plotscan::mesh
