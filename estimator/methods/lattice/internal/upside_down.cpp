// SPDX-License-Identifier: Apache-2.0
#include "methods/lattice/internal/upside_down.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

#include "core/list_of.h"
#include "core/statistics.h"
#include "ground/columns.h"

namespace plotscan::methods::lattice {
namespace {

constexpr std::size_t kMostPoints = 1'000'000;
constexpr std::size_t kLeastReturns = 5;  // of a column
// Of a column: what is no thicker than the noise is one layer, what is thicker by this stands.
constexpr float kThickness_m = 0.15f;

std::vector<Eigen::Vector3f> sample_of(std::span<const Eigen::Vector3f> points) {
  const std::size_t step = 1 + points.size() / kMostPoints;
  std::vector<Eigen::Vector3f> sample;
  for (std::size_t i = 0; i < points.size(); i += step) sample.push_back(points[i]);
  return sample;
}

// What a column's returns reach from and to, but for the lowest and highest tenth.
struct Reach {
  float low_m = 0;
  float high_m = 0;
  float thickness() const { return high_m - low_m; }
  float middle() const { return 0.5f * (low_m + high_m); }
};

std::optional<Reach> reach_of(std::span<const ground::Return> returns) {
  if (returns.size() < kLeastReturns) return std::nullopt;
  std::vector<float> z = list_of(returns, &ground::Return::z_m);
  std::ranges::sort(z);
  const std::size_t tenth = z.size() / 10;
  return Reach{.low_m = z[tenth], .high_m = z[z.size() - 1 - tenth]};
}

// How often what stands beside a single layer begins there, and how often it ends there.
struct Beside {
  std::size_t standing = 0;
  std::size_t hanging = 0;
};

}  // namespace

bool is_upside_down(std::span<const Eigen::Vector3f> points, double noise_m) {
  constexpr std::size_t kLeastPlaces = 100;
  // Closed tops, as photogrammetry sees them, are single layers as well: up to 0.75 hang there.
  constexpr double kLeastShare = 0.98;
  constexpr int kAround = 2;
  const std::vector<Eigen::Vector3f> sample = sample_of(points);
  const ground::Columns columns =
      ground::sort_into_columns(sample, ground::grid_of(sample, std::nullopt));
  const ground::Grid& grid = columns.grid;
  std::vector<std::optional<Reach>> reaches(grid.nodes());
  for (std::size_t i = 0; i < reaches.size(); ++i) reaches[i] = reach_of(columns.at(i));
  const auto layer_m = static_cast<float>(4 * noise_m + 0.02);
  Beside beside;
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      const std::optional<Reach>& tall = reaches[grid.index(column, row)];
      if (!tall || tall->thickness() < layer_m + kThickness_m) continue;
      ground::for_around(grid, column, row, kAround, [&](std::size_t near) {
        const std::optional<Reach>& layer = reaches[near];
        if (!layer || layer->thickness() > layer_m) return;
        const float at = (layer->middle() - tall->low_m) / tall->thickness();
        beside.standing += at < 0.25f;
        beside.hanging += at > 0.75f;
      });
    }
  }
  return beside.hanging >= kLeastPlaces &&
         static_cast<double>(beside.hanging) >
             kLeastShare * static_cast<double>(beside.hanging + beside.standing);
}

}  // namespace plotscan::methods::lattice
