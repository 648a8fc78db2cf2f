// SPDX-License-Identifier: Apache-2.0
#include "ground/internal/uncertainty.h"

#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "ground/internal/cascade.h"
#include "ground/internal/solver.h"

namespace plotscan::ground {
namespace {

constexpr int kDraws = 32;
constexpr int kCoarser = 2;           // the draws' grid is as many times coarser
constexpr int kBendsAround = 2;       // nodes on either side whose bends say how rough a place is
constexpr double kLeastDoubt = 0.03;  // of the noise: what even bare ground leaves
constexpr double kLeastBend_m = 5e-4;
constexpr double kUnknownBend_m = 0.1;  // without any evidence

// Every second node, with all data around it.
Grid coarse_grid(const Grid& grid) {
  return {.cell_m = kCoarser * grid.cell_m,
          .columns = std::max(3, (grid.columns + kCoarser - 1) / kCoarser),
          .rows = std::max(3, (grid.rows + kCoarser - 1) / kCoarser)};
}

std::size_t fine_index(const Grid& grid, int column, int row) {
  return grid.index(std::min(kCoarser * column, grid.columns - 1),
                    std::min(kCoarser * row, grid.rows - 1));
}

// The node of the coarse grid that a place of the fine one belongs to.
std::size_t coarse_index(const Grid& coarse, int column, int row) {
  return coarse.index(std::min(column / kCoarser, coarse.columns - 1),
                      std::min(row / kCoarser, coarse.rows - 1));
}

// Precision of the evidence around each coarse node, 1 / m^2.
Field coarse_data(const Grid& grid, const Grid& coarse, const Evidence& evidence) {
  Field sums(coarse.nodes(), 0);
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      const std::size_t i = grid.index(column, row);
      if (evidence.data[i] <= 0) continue;
      sums[coarse_index(coarse, column, row)] += evidence.support[i] * evidence.data[i];
    }
  }
  return sums;
}

// Mean doubt of the evidence around each coarse node.
Field coarse_doubt(const Grid& grid, const Grid& coarse, const Evidence& evidence, double noise_m) {
  Field sums(coarse.nodes(), 0), counts(coarse.nodes(), 0);
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      const std::size_t i = grid.index(column, row);
      const std::size_t at = coarse_index(coarse, column, row);
      sums[at] += evidence.doubt_m[i];
      counts[at] += 1;
    }
  }
  const auto least = static_cast<float>(kLeastDoubt * noise_m);
  for (std::size_t i = 0; i < sums.size(); ++i) {
    sums[i] = std::max(least, counts[i] > 0 ? sums[i] / counts[i] : 0);
  }
  return sums;
}

// Mean square of the bends to expect at each node: half from the bends around it, half from all
// bends where there is evidence.
Field bend_variances(const Grid& grid, const Field& surface, const Field& data) {
  const Field bends = curvature(grid, surface);
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < bends.size(); ++i) {
    if (data[i] <= 0) continue;
    sum += bends[i] * bends[i];
    ++count;
  }
  const double usual = std::max(kLeastBend_m * kLeastBend_m,
                                count > 0 ? sum / count : kUnknownBend_m * kUnknownBend_m);
  Field variances(grid.nodes());
  for_rows(grid, [&](int row) {
    for (int column = 0; column < grid.columns; ++column) {
      double here = 0;
      int nodes = 0;
      for_around(grid, column, row, kBendsAround, [&](std::size_t i) {
        const double bend = bends[i];
        here += bend * bend;
        ++nodes;
      });
      variances[grid.index(column, row)] = static_cast<float>(0.5 * usual + 0.5 * here / nodes);
    }
  });
  return variances;
}

// The right-hand side whose solution is a draw (Papandreou and Yuille, 2010): every term of the
// least squares, weighted by the root of its precision, times a standard normal number.
Field random_right_side(const Grid& grid, const Fit& fit, std::uint64_t draw) {
  RandomStream stream(0, random_purpose("ground/error"), draw);
  Field right(grid.nodes());
  for (std::size_t i = 0; i < right.size(); ++i) {
    right[i] = std::sqrt(fit.data[i]) * static_cast<float>(stream.normal());
  }
  const int n = grid.columns;
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < n; ++column) {
      const std::size_t i = grid.index(column, row);
      const auto [a, b] = stream.normal_pair();
      const float straight = std::sqrt(fit.stiffness[i]);
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
        const float xy = std::sqrt(2 * middle_stiffness(grid, fit.stiffness, i)) *
                         static_cast<float>(stream.normal());
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

ErrorDraws draw_errors(const Grid& grid, const Field& surface, const Evidence& evidence,
                       double noise_m) {
  const Grid coarse = coarse_grid(grid);
  Fit fit{.target = {}, .data = coarse_data(grid, coarse, evidence), .stiffness = {}};
  Field heights(coarse.nodes());
  for (int row = 0; row < coarse.rows; ++row) {
    for (int column = 0; column < coarse.columns; ++column) {
      heights[coarse.index(column, row)] = surface[fine_index(grid, column, row)];
    }
  }
  fit.stiffness = bend_variances(coarse, heights, fit.data);
  for (float& value : fit.stiffness) value = 1 / value;
  ErrorDraws errors{.grid = coarse,
                    .draws = kDraws,
                    .heights_m = std::vector<float>(kDraws * coarse.nodes()),
                    .doubt_m = coarse_doubt(grid, coarse, evidence, noise_m)};
  const Cascade cascade(coarse, fit);
  tbb::parallel_for(0, kDraws, [&](int draw) {
    const Field error = cascade.solve(random_right_side(coarse, fit, draw),
                                      {.most_iterations = 80, .tolerance_m = 1e-4});
    std::copy(error.begin(), error.end(),
              errors.heights_m.begin() + static_cast<long>(draw * coarse.nodes()));
  });
  return errors;
}

Field spread_of(const Grid& grid, const ErrorDraws& errors) {
  Field spread(grid.nodes());
  const std::size_t nodes = errors.grid.nodes();
  std::vector<double> squares(nodes);
  for (std::size_t i = 0; i < nodes; ++i) squares[i] = errors.doubt_m[i] * errors.doubt_m[i];
  for (int draw = 0; draw < errors.draws; ++draw) {
    for (std::size_t i = 0; i < nodes; ++i) {
      const double error = errors.heights_m[draw * nodes + i];
      squares[i] += error * error / errors.draws;
    }
  }
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      const int c = std::min(column / kCoarser, errors.grid.columns - 1);
      const int r = std::min(row / kCoarser, errors.grid.rows - 1);
      double sum = 0;
      int count = 0;
      for_around(errors.grid, c, r, 1, [&](std::size_t i) {
        sum += squares[i];
        ++count;
      });
      spread[grid.index(column, row)] = static_cast<float>(std::sqrt(sum / count));
    }
  }
  return spread;
}

}  // namespace plotscan::ground
