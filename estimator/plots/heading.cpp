// SPDX-License-Identifier: Apache-2.0
#include "plots/heading.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace plotscan::plots {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDegree = kPi / 180;

struct Cell {
  float x, y, cover;
};

std::vector<Cell> cells_of(const CanopyRaster& raster) {
  std::vector<Cell> cells;
  const double step = raster.cell_m();
  for (int i = 0; i < raster.a_cells(); ++i) {
    for (int j = 0; j < raster.b_cells(); ++j) {
      if (raster.seen_cells(i, i + 1, j, j + 1) == 0) continue;
      cells.push_back({static_cast<float>((i + 0.5) * step), static_cast<float>((j + 0.5) * step),
                       static_cast<float>(raster.cover(i, i + 1, j, j + 1))});
    }
  }
  return cells;
}

// Sum of the squared steps of the lines' mean cover, for lines in direction angle_rad.
double sharpness(const std::vector<Cell>& cells, double angle_rad, double bin_m, double block_m) {
  const auto c = static_cast<float>(std::cos(angle_rad)),
             s = static_cast<float>(std::sin(angle_rad));
  float low_along = 1e30F, high_along = -1e30F, low_across = 1e30F, high_across = -1e30F;
  for (const Cell& cell : cells) {
    const float along = c * cell.x + s * cell.y, across = c * cell.y - s * cell.x;
    low_along = std::min(low_along, along);
    high_along = std::max(high_along, along);
    low_across = std::min(low_across, across);
    high_across = std::max(high_across, across);
  }
  const auto per_bin = static_cast<float>(1 / bin_m), per_block = static_cast<float>(1 / block_m);
  const auto bins = static_cast<std::size_t>((high_across - low_across) * per_bin) + 3;
  const auto blocks = static_cast<std::size_t>((high_along - low_along) * per_block) + 1;
  std::vector<float> sums(2 * bins * blocks, 0);
  for (const Cell& cell : cells) {
    const float across = (c * cell.y - s * cell.x - low_across) * per_bin;
    const auto block = static_cast<std::size_t>((c * cell.x + s * cell.y - low_along) * per_block);
    const auto bin = static_cast<std::size_t>(across);
    const float share = across - static_cast<float>(bin);  // cloud in cell
    float* at = &sums[2 * (block * bins + bin)];
    at[0] += (1 - share) * cell.cover;
    at[1] += 1 - share;
    at[2] += share * cell.cover;
    at[3] += share;
  }
  const double least = 0.25 * block_m / bin_m;
  double total = 0;
  for (std::size_t block = 0; block < blocks; ++block) {
    for (std::size_t bin = 3; bin < bins; ++bin) {
      // Two bins on either side: single ones would be sharper where lines run along the cells.
      const float* at = &sums[2 * (block * bins + bin - 3)];
      const double low = at[1] + at[3], high = at[5] + at[7];
      if (std::min(low, high) < 2 * least) continue;
      const double step = (at[4] + at[6]) / high - (at[0] + at[2]) / low;
      total += std::min(low, high) * step * step;
    }
  }
  return total;
}

std::vector<double> sharpnesses(const std::vector<Cell>& cells, const std::vector<double>& angles,
                                double bin_m, double block_m, int threads) {
  std::vector<double> values(angles.size());
  tbb::task_arena arena(threads);
  arena.execute([&] {
    tbb::parallel_for(std::size_t{0}, angles.size(), [&](std::size_t i) {
      values[i] = sharpness(cells, angles[i], bin_m, block_m);
    });
  });
  return values;
}

// The sharpest direction within reach_rad of a guess, tried in steps, and the parabola's top.
double refined(const std::vector<Cell>& cells, double guess_rad, double reach_rad, double step_rad,
               double bin_m, double block_m, int threads) {
  std::vector<double> angles;
  const int steps = static_cast<int>(std::lround(reach_rad / step_rad));
  for (int i = -steps; i <= steps; ++i) angles.push_back(guess_rad + i * step_rad);
  const std::vector<double> values = sharpnesses(cells, angles, bin_m, block_m, threads);
  const auto best = static_cast<std::size_t>(std::ranges::max_element(values) - values.begin());
  if (best == 0 || best + 1 == values.size()) return angles[best];
  const double left = values[best - 1], top = values[best], right = values[best + 1];
  const double bend = left - 2 * top + right;
  return angles[best] + (bend < 0 ? 0.5 * (left - right) / bend * step_rad : 0);
}

}  // namespace

FieldAxes find_axes(const CanopyRaster& raster, std::optional<double> hint_rad, int threads) {
  constexpr double kBlock_m = 6, kLongBlock_m = 24;
  constexpr int kAngles = 180;
  const std::vector<Cell> cells = cells_of(raster);
  if (cells.empty()) return {};
  const double bin_m = raster.cell_m();
  std::vector<double> angles;
  for (int i = 0; i < kAngles; ++i) angles.push_back(i * kDegree);
  const std::vector<double> values = sharpnesses(cells, angles, bin_m, kBlock_m, threads);
  FieldAxes axes;
  int best_first = 0, best_second = 90;
  double best = -1;
  for (int i = 0; i < kAngles; ++i) {
    if (hint_rad && std::abs(std::remainder(i * kDegree - *hint_rad, kPi)) > 5 * kDegree) continue;
    for (int d = 60; d <= 120; ++d) {
      // A skewed lattice is rarer than rows with offsets of their own, which look like one.
      const double doubt = 1 - 0.03 * std::clamp(std::abs(d - 90) - 1, 0, 6);
      const double sum = doubt * (values[static_cast<std::size_t>(i)] +
                                  values[static_cast<std::size_t>((i + d) % kAngles)]);
      if (sum > best) {
        best = sum;
        best_first = i;
        best_second = i + d;
      }
    }
  }
  std::vector<double> sorted = values;
  std::ranges::nth_element(sorted, sorted.begin() + kAngles / 2);
  axes.sharpness = best / std::max(1e-9, 2 * sorted[kAngles / 2]);
  const auto fine = [&](double guess_rad) {
    const double closer =
        refined(cells, guess_rad, 1.2 * kDegree, 0.2 * kDegree, bin_m, kBlock_m, threads);
    return refined(cells, closer, 0.3 * kDegree, 0.05 * kDegree, bin_m, kLongBlock_m, threads);
  };
  axes.first_rad = fine(best_first * kDegree);
  axes.second_rad = fine(best_second * kDegree);
  return axes;
}

}  // namespace plotscan::plots
