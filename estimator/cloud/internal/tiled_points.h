// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "cloud/point_key.h"

namespace plotscan::cloud {

// Points by tile, tiles in their order.
struct TiledPoints {
  std::vector<Tile> tiles = {};
  std::vector<std::size_t> begin = {};  // of each tile's points; one more than tiles, ends the last
  std::vector<Eigen::Vector3f> points = {};  // z up, metres

  std::size_t size(std::size_t tile) const { return begin[tile + 1] - begin[tile]; }
  std::span<const Eigen::Vector3f> of(std::size_t tile) const {
    return std::span(points).subspan(begin[tile], size(tile));
  }
};

// Indices of points, ascending.
using Marked = std::vector<std::size_t>;

// Finds the tiles around a tile. The tiles must outlive this object; there must be at least one.
class TileRows {
 public:
  explicit TileRows(const std::vector<Tile>& tiles);

  // Calls visit(tile) for each tile at most `reach` tiles away, and for the tile itself.
  template <class Visit>
  void visit_around(std::size_t tile, int reach, const Visit& visit) const {
    const Tile middle = tiles_[tile];
    const std::int32_t last_row = static_cast<std::int32_t>(rows_.size()) - 2;
    const std::int32_t row = middle.y - tiles_.front().y;
    for (int y = std::max(row - reach, 0); y <= std::min(row + reach, last_row); ++y) {
      const auto end = tiles_.begin() + static_cast<std::ptrdiff_t>(rows_[y + 1]);
      auto at = std::lower_bound(tiles_.begin() + static_cast<std::ptrdiff_t>(rows_[y]), end,
                                 middle.x - reach, [](Tile a, std::int32_t x) { return a.x < x; });
      for (; at != end && at->x <= middle.x + reach; ++at)
        visit(static_cast<std::size_t>(at - tiles_.begin()));
    }
  }

 private:
  const std::vector<Tile>& tiles_;
  std::vector<std::size_t> rows_;  // first tile of each row of tiles; one more ends the last
};

// Greatest distance of a field's points from their tile's level. Farther points are trees, birds,
// clouds, mirror images.
inline constexpr double kFarthest_m = 10;

// Each tile's level, metres: the median, over the tiles at most 2 away, of the median height of a
// sample of their points.
std::vector<double> tile_levels(const TiledPoints& cloud, const TileRows& rows, int threads);

// Removes the marked points (one list for each tile), and tiles that become empty. Returns how many
// points were removed.
std::size_t take_out(TiledPoints& cloud, const std::vector<Marked>& marked);

}  // namespace plotscan::cloud
