// SPDX-License-Identifier: Apache-2.0
#include "cloud/field_density.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/core.h>

#include "cloud/internal/field_hull.h"
#include "cloud/point_key.h"
#include "core/error.h"
#include "core/packed_pair.h"
#include "core/statistics.h"

namespace plotscan::cloud {
namespace {

constexpr int kCoarsest_m = 256;
constexpr double kTypicalCount = 16;
constexpr double kMostSquares = 1e6;

// Points by square; a square's number is its south-west corner divided by its edge.
std::map<Tile, std::uint64_t> squares_of(std::span<const TileCount> counts, int edge_m) {
  const auto below = [&](std::int32_t at) {
    return static_cast<std::int32_t>(std::floor(static_cast<double>(at) / edge_m));
  };
  std::map<Tile, std::uint64_t> squares;
  for (const auto& [tile, points] : counts) squares[{below(tile.x), below(tile.y)}] += points;
  return squares;
}

// Counts of the squares in the hull; with `whole`, only those whose neighbours lie in it too, as
// the hull reaches one square beyond the scanned edge.
std::vector<double> counts_inside(const std::map<Tile, std::uint64_t>& squares,
                                  const FieldHull& hull, int edge_m, bool whole) {
  const auto holds = [&](int x, int y) {
    return hull.holds({x * edge_m + edge_m / 2, y * edge_m + edge_m / 2});
  };
  const Area bounds = hull.bounds();
  std::vector<double> counts;
  for (int y = static_cast<int>(std::floor(bounds[1] / edge_m)); y * edge_m < bounds[3]; ++y) {
    for (int x = static_cast<int>(std::floor(bounds[0] / edge_m)); x * edge_m < bounds[2]; ++x) {
      const int reach = whole ? 1 : 0;
      bool inside = true;
      for (int dy = -reach; dy <= reach; ++dy)
        for (int dx = -reach; dx <= reach; ++dx) inside = inside && holds(x + dx, y + dy);
      const auto found = squares.find({x, y});
      if (inside) counts.push_back(found == squares.end() ? 0 : static_cast<double>(found->second));
    }
  }
  return counts;
}

double area_of(const std::vector<Eigen::Vector2d>& corners) {
  double twice_m2 = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector2d& a = corners[i];
    const Eigen::Vector2d& b = corners[(i + 1) % corners.size()];
    twice_m2 += a.x() * b.y() - b.x() * a.y();
  }
  return twice_m2 / 2;
}

double mean_density(std::span<const TileCount> counts, const FieldHull& hull, double area_m2) {
  double points = 0;
  for (const auto& [tile, count] : counts)
    if (hull.holds(tile)) points += static_cast<double>(count);
  return points / area_m2;
}

// Squares of fewer than two points on average have no median of kTypicalCount.
int first_edge(double mean_per_m2, double area_m2) {
  int edge_m = 1;
  while (edge_m < kCoarsest_m &&
         (mean_per_m2 * edge_m * edge_m < 2 || area_m2 > kMostSquares * edge_m * edge_m))
    edge_m *= 2;
  return edge_m;
}

}  // namespace

void TileCounter::add(std::span<const Eigen::Vector3d> points) {
  for (const Eigen::Vector3d& point : points) {
    if (!is_in_reach(point)) continue;
    ++count_by_tile_[packed_pair(static_cast<std::int32_t>(std::floor(point.x())),
                                 static_cast<std::int32_t>(std::floor(point.y())))];
  }
}

std::vector<TileCount> TileCounter::counts() const {
  std::vector<TileCount> counts;
  counts.reserve(count_by_tile_.size());
  for (const auto& [key, points] : count_by_tile_) {
    const auto [x, y] = unpacked_pair(key);
    counts.push_back({{x, y}, points});
  }
  std::ranges::sort(counts, {}, &TileCount::tile);
  return counts;
}

void require_places(std::span<const TileCount> counts, const std::string& name) {
  if (!counts.empty()) return;
  throw InputError(name,
                   "its points lie beyond any place on Earth; geocentric coordinates have to be "
                   "projected first, for instance to UTM");
}

FieldDensity field_density(std::span<const TileCount> counts) {
  const FieldHull hull = find_field(counts);
  FieldDensity density{.field = hull.bounds(), .area_m2 = area_of(hull.corners())};
  const double mean = mean_density(counts, hull, density.area_m2);
  density.square_m = first_edge(mean, density.area_m2);
  for (;; density.square_m *= 2) {
    const int edge_m = density.square_m;
    const double square_m2 = static_cast<double>(edge_m) * edge_m;
    std::vector<double> inside;
    if (density.area_m2 <= kMostSquares * square_m2) {
      const std::map<Tile, std::uint64_t> squares = squares_of(counts, edge_m);
      inside = counts_inside(squares, hull, edge_m, true);
      if (inside.empty()) inside = counts_inside(squares, hull, edge_m, false);
    }
    const double median = quantile(inside, 0.5);
    if (median < kTypicalCount && edge_m < kCoarsest_m) continue;
    // A field that is smaller than a square, or without end.
    density.median = inside.empty() ? mean : median / square_m2;
    density.least5 = inside.empty() ? mean : quantile(std::move(inside), 0.05) / square_m2;
    return density;
  }
}

std::string density_text(double per_m2) {
  return per_m2 < 100 ? fmt::format("{:.3g}", per_m2) : fmt::format("{:.0f}", per_m2);
}

}  // namespace plotscan::cloud
