// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "terrain/terrain.h"
#include <Eigen/Core>

namespace plotscan::terrain {

// The Delaunay triangulation of points in the plane: triples of indices, counter-clockwise, in an
// order that depends on the points alone. Of equal points one is used. Exact
// predicates (CGAL): no crossing edges, whatever the points.
std::vector<std::array<std::uint32_t, 3>> delaunay_triangles(
    const std::vector<Eigen::Vector2d>& points);

// The paper's terrain: a square of side_m about the origin, its four corners and `vertices` random
// points in it, each with z uniform in [-relief_m, relief_m], joined by their Delaunay
// triangulation in (x, y).
Terrain random_terrain(double side_m, std::uint32_t vertices, double relief_m, std::uint64_t seed);

}  // namespace plotscan::terrain
