// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "cloud/area.h"
#include "cloud/tile_store.h"

namespace plotscan::cloud {

// The convex outline of a field, counter-clockwise, whole metres.
class FieldHull {
 public:
  // The hull of all corners of the tiles, of which there must be at least one.
  explicit FieldHull(std::span<const Tile> tiles);
  // Whether the tile's centre lies inside.
  bool holds(Tile tile) const;
  Area bounds() const;
  const std::vector<Eigen::Vector2d>& corners() const { return corners_; }

 private:
  std::vector<Eigen::Vector2d> corners_;
};

// The densely scanned field in a cloud that also shows thinly scanned surroundings: the hull of the
// largest group of dense squares, grown by one square. A square is dense when it and two of its
// eight neighbours each hold at least a quarter of the typical count, which is that of the square
// of the median point. A tripod's scan is dense at its stations only: where the group has less than
// half of the points, it is sought with a 16th of the typical count, a 64th and so on, until it has
// half. The edge of the squares is the smallest of 1, 2, 4, 8 and 16 m at which the typical count
// is at least 16 points. Two groups are separate when their dense squares are at least 4 to 8
// squares apart; the strips of one survey are thus one field, with the gaps between them. Throws
// InputError when there is no tile.
FieldHull find_field(std::span<const TileCount> counts);

}  // namespace plotscan::cloud
