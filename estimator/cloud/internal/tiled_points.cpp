// SPDX-License-Identifier: Apache-2.0
#include "cloud/internal/tiled_points.h"

#include "core/each_index.h"
#include "core/statistics.h"

namespace plotscan::cloud {
namespace {

constexpr int kLevelReach = 2;  // tiles to each side
constexpr std::size_t kLevelSample = 64;

}  // namespace

TileRows::TileRows(const std::vector<Tile>& tiles)
    : tiles_(tiles),
      rows_(static_cast<std::size_t>(tiles.back().y - tiles.front().y) + 2, tiles.size()) {
  for (std::size_t tile = tiles.size(); tile-- > 0;)
    rows_[static_cast<std::size_t>(tiles[tile].y - tiles.front().y)] = tile;
  for (std::size_t row = rows_.size() - 1; row-- > 0;)  // rows without tiles
    rows_[row] = std::min(rows_[row], rows_[row + 1]);
}

std::vector<double> tile_levels(const TiledPoints& cloud, const TileRows& rows, int threads) {
  std::vector<float> own(cloud.tiles.size());
  std::vector<double> result(cloud.tiles.size());
  for_each_index(own.size(), threads, [&](std::size_t tile) {
    const std::size_t step = std::max<std::size_t>(1, cloud.size(tile) / kLevelSample);
    std::vector<float> z;
    for (std::size_t i = cloud.begin[tile]; i < cloud.begin[tile + 1]; i += step)
      z.push_back(cloud.points[i].z());
    own[tile] = selected<float>(z, z.size() / 2);
  });
  for_each_index(own.size(), threads, [&](std::size_t tile) {
    std::vector<float> levels;
    rows.visit_around(tile, kLevelReach, [&](std::size_t other) { levels.push_back(own[other]); });
    result[tile] = selected<float>(levels, levels.size() / 2);
  });
  return result;
}

std::size_t take_out(TiledPoints& cloud, const std::vector<Marked>& marked) {
  const auto unmarked = [](const Marked& of_tile) { return of_tile.empty(); };
  if (std::ranges::all_of(marked, unmarked)) return 0;
  Eigen::Vector3f* const points = cloud.points.data();
  std::size_t kept = 0;
  std::size_t tiles = 0;
  for (std::size_t tile = 0; tile < cloud.tiles.size(); ++tile) {
    const std::size_t begin = kept;
    std::size_t next = cloud.begin[tile];
    const auto keep_until = [&](std::size_t end) {
      if (kept != next) std::copy(points + next, points + end, points + kept);
      kept += end - next;
      next = end + 1;
    };
    std::ranges::for_each(marked[tile], keep_until);
    keep_until(cloud.begin[tile + 1]);
    if (kept == begin) continue;
    cloud.tiles[tiles] = cloud.tiles[tile];
    cloud.begin[tiles++] = begin;
  }
  const std::size_t taken = cloud.points.size() - kept;
  cloud.tiles.resize(tiles);
  cloud.begin.resize(tiles + 1);
  cloud.begin.back() = kept;
  cloud.points.resize(kept);
  return taken;
}

}  // namespace plotscan::cloud
