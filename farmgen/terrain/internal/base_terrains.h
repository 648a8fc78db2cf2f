// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

#include <Eigen/Core>

#include "terrain/terrain.h"
#include "terrain/terrain_description.h"

// What a terrain may be made from before it has relief.
namespace plotscan::terrain {

// The Delaunay triangulation of points in the plane: triples of indices, counter-clockwise, in an
// order that depends on the points alone. Of equal points one is used. Exact predicates (CGAL): no
// crossing edges, whatever the points.
std::vector<std::array<std::uint32_t, 3>> delaunay_triangles(
    const std::vector<Eigen::Vector2d>& points);

// The paper's terrain: a square of side_m about the origin, its four corners and `vertices` random
// points in it, each with z uniform in [-relief_m, relief_m], joined by their Delaunay
// triangulation in (x, y).
Terrain random_terrain(double side_m, std::uint32_t vertices, double relief_m, std::uint64_t seed);

// A terrain with a vertex for each pixel of a grey image, centred on the origin, each square of
// four pixels two triangles. Throws InputError on a file that is no grey PNG, or a broken one, or
// on more pixels than kMostTerrainVertices.
Terrain heightmap_terrain(const HeightmapDescription& description);

// The points of a text file: x, y and z on each line, separated by spaces, tabs, commas or
// semicolons; what follows a '#' and empty lines are passed over. Throws InputError naming file and
// line on another line, a number that is not finite, a place that is given twice, fewer than three
// points or more than kMostTerrainVertices.
std::vector<Eigen::Vector3d> read_xyz(const std::filesystem::path& path);

}  // namespace plotscan::terrain
