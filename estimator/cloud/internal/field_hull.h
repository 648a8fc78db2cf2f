// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "cloud/cloud_map.h"
#include "cloud/tile_store.h"
#include <Eigen/Core>

namespace plotscan::cloud {

// The convex outline of a field, counter-clockwise, whole metres.
class FieldHull {
 public:
  // Of the tiles with all their corners. At least one tile.
  explicit FieldHull(std::span<const Tile> tiles);
  // Whether the tile's centre lies inside.
  bool holds(Tile tile) const;
  Area bounds() const;
  const std::vector<Eigen::Vector2d>& corners() const { return corners_; }

 private:
  std::vector<Eigen::Vector2d> corners_;
};

// The densely scanned field in a cloud of which a lidar also saw the thin surroundings: the hull of
// the dense squares of the largest group of these, grown by a square. A square is dense when it
// holds at least a quarter of what the square of the median point holds, and two of its eight
// neighbours do; squares have the edge of
// 1, 2, 4, 8 or 16 m at which the latter is at least 16 points. Groups are apart when no dense
// squares of theirs are nearer than 4 to 8 squares, so that the strips of one survey are one field,
// with the gaps between them. Throws InputError when there is no tile.
FieldHull find_field(std::span<const TileCount> counts);

}  // namespace plotscan::cloud
