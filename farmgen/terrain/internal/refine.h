// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Geometry>

#include "terrain/internal/lattice.h"
#include "terrain/internal/relief.h"
#include "terrain/terrain.h"

namespace plotscan::terrain {

// More vertices are refused as a likely mistake: truth/terrain.ply would have over 170 MB.
inline constexpr std::size_t kMostTerrainVertices = 4'000'000;

// A rectangle in which a terrain gets new vertices, on a lattice.
struct Patch {
  Eigen::AlignedBox2d box;
  LatticeLayout layout;
};

// Estimated number of vertices of the base with the patches, not counting those along its edges.
double refined_vertices(const Terrain& base, const std::vector<Patch>& patches);

// The base with the relief added to its heights. In the patches (the later ones count where they
// overlap) vertices of a lattice are added, and vertices along the base's edges where the base is
// bent there, about as close, so that its breaklines stay; all are joined by the Delaunay
// triangulation. Every vertex has exactly the height base + relief. Without patches the triangles
// are the base's. Throws InputError where the base's edges take too many vertices.
Terrain refined(const Terrain& base, const Relief& relief, const std::vector<Patch>& patches);

}  // namespace plotscan::terrain
