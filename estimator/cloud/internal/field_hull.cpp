// SPDX-License-Identifier: Apache-2.0
#include "cloud/internal/field_hull.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

#include "cloud/convex_hull.h"
#include "core/error.h"
#include "core/list_of.h"
#include "core/statistics.h"

namespace plotscan::cloud {
namespace {

constexpr double kDenseShare = 0.25;
constexpr double kLeastOfPoints = 0.5;  // in the field: a tripod's scan is dense at its stations
constexpr double kThinner = 0.25;       // squares are taken then, again and again
constexpr std::uint64_t kLeastTypical = 16;  // points: fewer tell a square's density badly
constexpr int kCoarsest = 4;                 // squares of 2^4 m
constexpr int kFirmNeighbours = 2;           // of 8
constexpr int kGroupBits = 2;                // groups are told apart on squares of 4 x 4 squares

Tile coarse(Tile tile, int bits) { return {tile.x >> bits, tile.y >> bits}; }

std::vector<TileCount> coarsened(std::span<const TileCount> counts) {
  std::map<Tile, std::uint64_t> sums;
  for (const TileCount& count : counts) sums[coarse(count.tile, 1)] += count.points;
  return list_of(sums, [](const auto& sum) { return TileCount{sum.first, sum.second}; });
}

// The count of the square that holds the median point. Unlike the median of all squares, it does
// not fall when the surroundings are wide and thinly scanned.
std::uint64_t typical_count(std::span<const TileCount> counts) {
  return self_weighted_median(list_of(counts, &TileCount::points));
}

// The dense squares with enough dense neighbours: a single square of thin surroundings may be dense
// by chance. All dense squares where the cloud is too small for that.
std::vector<Tile> dense_squares(std::span<const TileCount> counts, double least_count) {
  std::vector<Tile> dense;
  for (const TileCount& count : counts)
    if (static_cast<double>(count.points) >= least_count) dense.push_back(count.tile);
  const auto is_dense = [&](Tile tile) { return std::ranges::binary_search(dense, tile); };
  std::vector<Tile> firm = those_of(dense, [&](Tile tile) {
    int neighbours = -1;  // itself
    for (const int dx : {-1, 0, 1})
      for (const int dy : {-1, 0, 1}) neighbours += is_dense({tile.x + dx, tile.y + dy});
    return neighbours >= kFirmNeighbours;
  });
  return firm.empty() ? dense : firm;
}

// The largest group of squares whose coarse squares touch each other.
std::vector<Tile> largest_group(const std::vector<Tile>& squares) {
  std::map<Tile, std::vector<Tile>> left;
  for (const Tile square : squares) left[coarse(square, kGroupBits)].push_back(square);
  std::vector<Tile> largest;
  while (!left.empty()) {
    std::vector<Tile> group;
    std::vector<Tile> open = {left.begin()->first};
    while (!open.empty()) {
      const Tile at = open.back();
      open.pop_back();
      const auto found = left.find(at);
      if (found == left.end()) continue;
      group.insert(group.end(), found->second.begin(), found->second.end());
      left.erase(found);
      for (const int dx : {-1, 0, 1})
        for (const int dy : {-1, 0, 1}) open.push_back({at.x + dx, at.y + dy});
    }
    if (group.size() > largest.size()) largest = std::move(group);
  }
  return largest;
}

double points_in(std::vector<Tile> squares, std::span<const TileCount> counts) {
  std::ranges::sort(squares);
  double points = 0;
  for (const TileCount& count : counts)
    if (std::ranges::binary_search(squares, count.tile))
      points += static_cast<double>(count.points);
  return points;
}

// The largest group of dense squares; of thinner ones where it has less than half of the points and
// a group of those has half.
std::vector<Tile> field_squares(std::span<const TileCount> counts) {
  double all = 0;
  for (const TileCount& count : counts) all += static_cast<double>(count.points);
  const auto is_field = [&](const std::vector<Tile>& squares) {
    return points_in(squares, counts) >= kLeastOfPoints * all;
  };
  double least_count = kDenseShare * static_cast<double>(typical_count(counts));
  std::vector<Tile> dense = largest_group(dense_squares(counts, least_count));
  if (is_field(dense)) return dense;
  while (least_count > 1) {
    least_count *= kThinner;
    std::vector<Tile> thinner = largest_group(dense_squares(counts, least_count));
    if (is_field(thinner)) return thinner;
  }
  return dense;
}

}  // namespace

FieldHull::FieldHull(std::span<const Tile> tiles) {
  std::vector<Eigen::Vector2d> points;
  for (const Tile tile : tiles) {
    for (const double dx : {0.0, 1.0})
      for (const double dy : {0.0, 1.0}) points.emplace_back(tile.x + dx, tile.y + dy);
  }
  corners_ = convex_hull(std::move(points));
}

bool FieldHull::holds(Tile tile) const {
  const Eigen::Vector2d centre(tile.x + 0.5, tile.y + 0.5);
  for (std::size_t i = 0; i < corners_.size(); ++i)
    if (turn(corners_[i], corners_[(i + 1) % corners_.size()], centre) < 0) return false;
  return true;
}

Area FieldHull::bounds() const {
  Eigen::AlignedBox2d bounds;
  for (const Eigen::Vector2d& corner : corners_) bounds.extend(corner);
  return around(bounds);
}

FieldHull find_field(std::span<const TileCount> counts) {
  if (counts.empty()) throw InputError("a cloud without points has no field");
  std::vector<TileCount> squares(counts.begin(), counts.end());
  int bits = 0;
  for (; bits < kCoarsest && typical_count(squares) < kLeastTypical; ++bits)
    squares = coarsened(squares);
  // Each square's opposite corner tiles, a square further out.
  std::vector<Tile> tiles;
  for (const Tile square : field_squares(squares)) {
    const auto corner = [bits](std::int32_t index, int by) { return (index + by) * (1 << bits); };
    for (const int x : {corner(square.x, -1), corner(square.x, 2) - 1})
      for (const int y : {corner(square.y, -1), corner(square.y, 2) - 1}) tiles.push_back({x, y});
  }
  return FieldHull(tiles);
}

}  // namespace plotscan::cloud
