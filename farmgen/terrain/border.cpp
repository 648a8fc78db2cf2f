// SPDX-License-Identifier: Apache-2.0
#include "terrain/border.h"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace plotscan::terrain {

Border::Border(const Terrain& terrain) {
  // Triangles run counter-clockwise: the neighbour beyond an edge has it the other way round.
  using Edge = std::pair<std::uint32_t, std::uint32_t>;
  std::vector<Edge> edges;
  edges.reserve(3 * terrain.triangles().size());
  for (const auto& [a, b, c] : terrain.triangles()) {
    edges.emplace_back(a, b);
    edges.emplace_back(b, c);
    edges.emplace_back(c, a);
  }
  std::ranges::sort(edges);
  for (const auto& [from, to] : edges) {
    if (std::ranges::binary_search(edges, Edge(to, from))) continue;
    Eigen::AlignedBox2d& box = edges_.emplace_back();
    for (const std::uint32_t vertex : {from, to})
      box.extend(Eigen::Vector2d(terrain.vertices()[vertex].head<2>()));
  }
}

bool Border::may_meet(const Eigen::AlignedBox2d& rectangle) const {
  return std::ranges::any_of(
      edges_, [&](const Eigen::AlignedBox2d& edge) { return edge.intersects(rectangle); });
}

}  // namespace plotscan::terrain
