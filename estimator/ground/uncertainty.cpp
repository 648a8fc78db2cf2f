// SPDX-License-Identifier: Apache-2.0
#include "ground/uncertainty.h"

#include <algorithm>
#include <cmath>

#include "ground/solver.h"

#include "core/random.h"

namespace plotscan::ground {
namespace {

constexpr int kDraws = 32;
constexpr int kCoarser = 2;          // the draws' grid is as many times coarser
constexpr double kEfficiency = 0.5;  // of the data's precision: neighbours share their errors
constexpr double kLeastBend_m = 5e-4;

// Every second node, with all data around it.
Grid coarse_grid(const Grid& grid) {
  return {.origin = grid.origin,
          .cell_m = kCoarser * grid.cell_m,
          .columns = std::max(3, (grid.columns + kCoarser - 1) / kCoarser),
          .rows = std::max(3, (grid.rows + kCoarser - 1) / kCoarser)};
}

std::size_t fine_index(const Grid& grid, int column, int row) {
  return grid.index(std::min(kCoarser * column, grid.columns - 1),
                    std::min(kCoarser * row, grid.rows - 1));
}

Field coarse_data(const Grid& grid, const Grid& coarse, const Field& data) {
  Field sums(coarse.nodes(), 0);
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      const int c = std::min(column / kCoarser, coarse.columns - 1);
      const int r = std::min(row / kCoarser, coarse.rows - 1);
      sums[coarse.index(c, r)] += static_cast<float>(kEfficiency) * data[grid.index(column, row)];
    }
  }
  return sums;
}

// Mean square of the bends between nodes with data.
double bend_variance(const Grid& grid, const Field& surface, const Field& data) {
  const Field bends = curvature(grid, surface);
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < bends.size(); ++i) {
    if (data[i] <= 0) continue;
    sum += bends[i] * bends[i];
    ++count;
  }
  return std::max(kLeastBend_m * kLeastBend_m, count > 0 ? sum / count : 0.01);
}

// The right-hand side whose solution is a draw (Papandreou and Yuille, 2010): every term of the
// least squares, weighted by the root of its precision, times a standard normal number.
Field random_right_side(const Grid& grid, const Fit& fit, std::uint64_t draw) {
  RandomStream stream(0, random_purpose("ground/error"), draw);
  Field right(grid.nodes());
  for (std::size_t i = 0; i < right.size(); ++i) {
    right[i] = std::sqrt(fit.data[i]) * static_cast<float>(stream.normal());
  }
  const float straight = std::sqrt(fit.stiffness[0]);
  const float askew = std::sqrt(2.0f) * straight;
  const int n = grid.columns;
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < n; ++column) {
      const std::size_t i = grid.index(column, row);
      const auto [a, b] = stream.normal_pair();
      if (column > 0 && column + 1 < n) {
        const float x = straight * static_cast<float>(a);
        right[i - 1] += x;
        right[i] -= 2 * x;
        right[i + 1] += x;
      }
      if (row > 0 && row + 1 < grid.rows) {
        const float y = straight * static_cast<float>(b);
        right[i - n] += y;
        right[i] -= 2 * y;
        right[i + n] += y;
      }
      if (column + 1 < n && row + 1 < grid.rows) {
        const float xy = askew * static_cast<float>(stream.normal());
        right[i] += xy;
        right[i + 1] -= xy;
        right[i + n] -= xy;
        right[i + n + 1] += xy;
      }
    }
  }
  return right;
}

}  // namespace

ErrorDraws draw_errors(const Grid& grid, const Field& surface, const Field& data, double noise_m) {
  const Grid coarse = coarse_grid(grid);
  Fit fit{.target = {}, .data = coarse_data(grid, coarse, data), .stiffness = {}};
  Field heights(coarse.nodes());
  for (int row = 0; row < coarse.rows; ++row) {
    for (int column = 0; column < coarse.columns; ++column) {
      heights[coarse.index(column, row)] = surface[fine_index(grid, column, row)];
    }
  }
  const double variance = bend_variance(coarse, heights, fit.data);
  fit.stiffness.assign(coarse.nodes(), static_cast<float>(1 / variance));
  ErrorDraws errors{.cell_m = coarse.cell_m,
                    .columns = coarse.columns,
                    .rows = coarse.rows,
                    .draws = kDraws,
                    .common_m = 0.05 * noise_m,
                    .heights_m = std::vector<float>(kDraws * coarse.nodes())};
  tbb::parallel_for(0, kDraws, [&](int draw) {
    const Field right = random_right_side(coarse, fit, draw);
    Field error(coarse.nodes(), 0);
    solve_right_side(coarse, fit, right, {.most_iterations = 150, .tolerance_m = 1e-3}, error);
    std::copy(error.begin(), error.end(),
              errors.heights_m.begin() + static_cast<long>(draw * coarse.nodes()));
  });
  return errors;
}

Field spread_of(const Grid& grid, const ErrorDraws& errors) {
  Field spread(grid.nodes());
  const std::size_t nodes = static_cast<std::size_t>(errors.columns) * errors.rows;
  std::vector<double> squares(nodes, errors.common_m * errors.common_m);
  for (int draw = 0; draw < errors.draws; ++draw) {
    for (std::size_t i = 0; i < nodes; ++i) {
      const double error = errors.heights_m[draw * nodes + i];
      squares[i] += error * error / errors.draws;
    }
  }
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      const int c = std::min(column / kCoarser, errors.columns - 1);
      const int r = std::min(row / kCoarser, errors.rows - 1);
      double sum = 0;
      int count = 0;
      for (int y = std::max(0, r - 1); y <= std::min(errors.rows - 1, r + 1); ++y) {
        for (int x = std::max(0, c - 1); x <= std::min(errors.columns - 1, c + 1); ++x) {
          sum += squares[static_cast<std::size_t>(y) * errors.columns + x];
          ++count;
        }
      }
      spread[grid.index(column, row)] = static_cast<float>(std::sqrt(sum / count));
    }
  }
  return spread;
}

}  // namespace plotscan::ground
