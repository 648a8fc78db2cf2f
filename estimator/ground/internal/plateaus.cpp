// SPDX-License-Identifier: Apache-2.0
#include "ground/internal/plateaus.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>

#include <Eigen/Core>

namespace plotscan::ground {
namespace {

constexpr float kNone = std::numeric_limits<float>::infinity();

// Half of the widest plateau: a plot and the canopy that hangs out of it.
constexpr double kReach_m = 3;
// A hill that is no steeper than this is no plateau.
constexpr double kSteepest = 0.35;
constexpr double kLeastStep_m = 0.05;
// Of the nodes with returns. A laser sees the ground through most canopies: of its clouds up to
// 1.2 % are such tops, or crests of rough ground.
constexpr double kLeastShare = 0.02;

constexpr auto kLower = [](float a, float b) { return std::min(a, b); };
constexpr auto kHigher = [](float a, float b) { return std::max(a, b); };

// At each node the extreme of its value and that of the node `offset` nodes further, where there is
// one.
template <class Extreme>
Field with_neighbour(const Grid& grid, const Field& z, const Eigen::Vector2i& offset,
                     Extreme extreme) {
  Field result = z;
  for_rows(grid, [&](int row) {
    const int other = row + offset.y();
    if (other < 0 || other >= grid.rows) return;
    const int west = std::max(0, -offset.x());
    const int east = std::min(grid.columns, grid.columns - offset.x());
    for (int column = west; column < east; ++column) {
      const std::size_t i = grid.index(column, row);
      result[i] = extreme(z[i], z[grid.index(column + offset.x(), other)]);
    }
  });
  return result;
}

// The extreme over each node and the `further` nodes behind it in a direction. Runs are doubled, so
// that the time grows with the logarithm of their length.
template <class Extreme>
Field extreme_along(const Grid& grid, Field z, int further, const Eigen::Vector2i& direction,
                    Extreme extreme) {
  int reached = 0;
  while (reached < further) {
    const int step = std::min(reached + 1, further - reached);
    z = with_neighbour(grid, z, step * direction, extreme);
    reached += step;
  }
  return z;
}

// The extreme over the square that reaches `around` nodes to either side.
template <class Extreme>
Field extreme_around(const Grid& grid, Field z, int around, Extreme extreme) {
  for (const Eigen::Vector2i& axis : {Eigen::Vector2i(1, 0), Eigen::Vector2i(0, 1)}) {
    const Field behind = extreme_along(grid, z, around, -axis, extreme);
    z = extreme_along(grid, std::move(z), around, axis, extreme);
    std::ranges::transform(z, behind, z.begin(), extreme);
  }
  return z;
}

// The highest surface under `z` that a level square of this size reaches from below everywhere.
Field opened(const Grid& grid, const Field& z, int around) {
  Field low = extreme_around(grid, z, around, kLower);
  std::ranges::replace(low, kNone, -kNone);
  return extreme_around(grid, std::move(low), around, kHigher);
}

// Lifts a node to the third lowest of its neighbours and itself: strays below the ground are
// single, gaps between plots have a length.
Field without_pits(const Grid& grid, const Field& z) {
  Field lifted = z;
  for_rows(grid, [&](int row) {
    for (int column = 0; column < grid.columns; ++column) {
      const std::size_t i = grid.index(column, row);
      std::array<float, 9> around;
      around.fill(kNone);
      int count = 0;
      for_around(grid, column, row, 1, [&](std::size_t near) { around[count++] = z[near]; });
      std::ranges::nth_element(around, around.begin() + 2);
      if (z[i] < kNone && around[2] < kNone) lifted[i] = std::max(z[i], around[2]);
    }
  });
  return lifted;
}

// Where a field's nodes lie in a grid that is wider by `margin` nodes on each side.
struct Margin {
  Grid inner;
  Grid wide;
  int margin;

  Margin(const Grid& grid, int nodes) : inner(grid), wide(grid), margin(nodes) {
    wide.columns += 2 * nodes;
    wide.rows += 2 * nodes;
  }

  // Without returns in the margin.
  Field add(const Field& z) const {
    Field padded(wide.nodes(), kNone);
    for (int row = 0; row < inner.rows; ++row)
      std::copy_n(&z[inner.index(0, row)], inner.columns,
                  &padded[wide.index(margin, row + margin)]);
    return padded;
  }

  Field remove(const Field& padded) const {
    Field z(inner.nodes());
    for (int row = 0; row < inner.rows; ++row)
      std::copy_n(&padded[wide.index(margin, row + margin)], inner.columns,
                  &z[inner.index(0, row)]);
    return z;
  }
};

// Nodes that stand out of their surroundings by a step on all sides.
std::vector<std::uint8_t> raised_nodes(const Grid& grid, const Field& z_m, double noise_m) {
  const auto step_m = static_cast<float>(kSteepest * std::numbers::sqrt2 * grid.cell_m +
                                         kLeastStep_m + 6 * noise_m);
  const auto widest = static_cast<int>(std::lround(kReach_m / grid.cell_m));
  const Margin margin(grid, widest);  // squares may reach beyond the field
  Field above = without_pits(grid, z_m);
  const Field padded = margin.add(above);
  std::vector<std::uint8_t> raised(grid.nodes(), 0);
  for (int around = 1; around <= widest; ++around) {
    Field below = margin.remove(opened(margin.wide, padded, around));
    for (std::size_t i = 0; i < below.size(); ++i)
      if (z_m[i] < kNone && above[i] > below[i] + step_m) raised[i] = 1;
    above = std::move(below);
  }
  return raised;
}

// Of the raised nodes those of whose surroundings at least half are raised: tops without gaps.
std::vector<std::uint8_t> closed_part(const Grid& grid, const Field& z_m,
                                      const std::vector<std::uint8_t>& raised) {
  constexpr int kAround = 2;
  std::vector<std::uint8_t> closed = raised;
  for_rows(grid, [&](int row) {
    for (int column = 0; column < grid.columns; ++column) {
      int seen = 0;
      int among = 0;
      for_around(grid, column, row, kAround, [&](std::size_t near) {
        seen += static_cast<int>(z_m[near] < kNone);
        among += raised[near];
      });
      if (2 * among < seen) closed[grid.index(column, row)] = 0;
    }
  });
  return closed;
}

}  // namespace

std::vector<std::uint8_t> plateaus(const Grid& grid, const Field& z_m, double noise_m) {
  std::vector<std::uint8_t> tops = closed_part(grid, z_m, raised_nodes(grid, z_m, noise_m));
  const auto seen = std::ranges::count_if(z_m, [](float z) { return z < kNone; });
  const auto closed = std::ranges::count(tops, 1);
  if (static_cast<double>(closed) < kLeastShare * static_cast<double>(seen))
    std::ranges::fill(tops, std::uint8_t{0});
  return tops;
}

}  // namespace plotscan::ground
