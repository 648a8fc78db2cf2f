// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <vector>

#include "cloud/internal/tiled_points.h"
#include "core/random.h"

namespace plotscan::cloud {

using Points = std::vector<Eigen::Vector3f>;
using Height = std::function<double(double x, double y)>;

inline TiledPoints tiled(const Points& points) {
  std::map<Tile, Points> tiles;
  for (const Eigen::Vector3f& p : points)
    tiles[{static_cast<int>(std::floor(p.x())), static_cast<int>(std::floor(p.y()))}].push_back(p);
  TiledPoints result;
  for (const auto& [tile, inside] : tiles) {
    result.tiles.push_back(tile);
    result.begin.push_back(result.points.size());
    result.points.insert(result.points.end(), inside.begin(), inside.end());
  }
  result.begin.push_back(result.points.size());
  return result;
}

// `density` points a square metre over a square of side_m, with 3 cm of noise.
inline Points scanned(double density, double side_m, const Height& height,
                      std::uint64_t index = 0) {
  RandomStream random(1, random_purpose("test/outliers"), index);
  Points points;
  for (double i = 0; i < density * side_m * side_m; ++i) {
    const double x = random.uniform(0, side_m);
    const double y = random.uniform(0, side_m);
    points.emplace_back(Eigen::Vector3d(x, y, height(x, y) + 0.03 * random.normal()).cast<float>());
  }
  return points;
}

}  // namespace plotscan::cloud
