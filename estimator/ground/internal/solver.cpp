// SPDX-License-Identifier: Apache-2.0
#include "ground/internal/solver.h"

#include <algorithm>
#include <cmath>

namespace plotscan::ground {
namespace {

// The second differences of a surface, weighted: at nodes along x and along y, and in the middle of
// four nodes (index of the lower left one).
struct Bends {
  explicit Bends(std::size_t nodes) : xx(nodes), yy(nodes), xy(nodes) {}
  Field xx, yy, xy;
};

void bend(const Grid& grid, const Field& mixed, const Field& stiffness, const Field& s, int row,
          Bends& bends) {
  const int n = grid.columns;
  const std::size_t at = grid.index(0, row);
  for (int c = 1; c + 1 < n; ++c) {
    const std::size_t i = at + c;
    bends.xx[i] = stiffness[i] * (s[i - 1] - 2 * s[i] + s[i + 1]);
  }
  if (row > 0 && row + 1 < grid.rows) {
    for (int c = 0; c < n; ++c) {
      const std::size_t i = at + c;
      bends.yy[i] = stiffness[i] * (s[i - n] - 2 * s[i] + s[i + n]);
    }
  }
  if (row + 1 < grid.rows) {
    for (int c = 0; c + 1 < n; ++c) {
      const std::size_t i = at + c;
      bends.xy[i] = 2 * mixed[i] * (s[i] - s[i + 1] - s[i + n] + s[i + n + 1]);
    }
  }
}

// The adjoint: row of H^T (weighted H s). Ends of rows hold zero.
void unbend(const Grid& grid, const Bends& b, int row, float* out) {
  const int n = grid.columns;
  const std::size_t at = grid.index(0, row);
  const bool below = row > 0;
  const bool above = row + 1 < grid.rows;
  out[0] += b.xx[at + 1];
  out[n - 1] += b.xx[at + n - 2];
  for (int c = 1; c + 1 < n; ++c) {
    const std::size_t i = at + c;
    out[c] += b.xx[i - 1] - 2 * b.xx[i] + b.xx[i + 1];
  }
  for (int c = 0; c < n; ++c) out[c] -= 2 * b.yy[at + c];
  if (below) {
    const float* const yy = &b.yy[at - n];
    const float* const xy = &b.xy[at - n];
    for (int c = 0; c < n; ++c) out[c] += yy[c] - xy[c];
    for (int c = 1; c < n; ++c) out[c] += xy[c - 1];
  }
  if (above) {
    const float* const yy = &b.yy[at + n];
    const float* const xy = &b.xy[at];
    for (int c = 0; c < n; ++c) out[c] += yy[c] + xy[c];
    for (int c = 1; c < n; ++c) out[c] -= xy[c - 1];
  }
}

class Operator {
 public:
  Operator(const Grid& grid, const Fit& fit)
      : grid_(grid), fit_(fit), mixed_(grid.nodes()), bends_(grid.nodes()) {
    for_rows(grid, [&](int row) {
      if (row + 1 == grid.rows) return;
      for (int c = 0; c + 1 < grid.columns; ++c) {
        const std::size_t i = grid.index(c, row);
        mixed_[i] = middle_stiffness(grid, fit.stiffness, i);
      }
    });
  }

  void apply(const Field& s, Field& out) {
    for_rows(grid_, [&](int row) { bend(grid_, mixed_, fit_.stiffness, s, row, bends_); });
    for_rows(grid_, [&](int row) {
      const std::size_t at = grid_.index(0, row);
      for (int c = 0; c < grid_.columns; ++c) out[at + c] = fit_.data[at + c] * s[at + c];
      unbend(grid_, bends_, row, &out[at]);
    });
  }

  Field diagonal() const {
    Field diagonal(grid_.nodes());
    const int n = grid_.columns;
    const auto within = [&](int c, int r) { return c >= 0 && r >= 0 && c < n && r < grid_.rows; };
    for_rows(grid_, [&](int row) {
      for (int c = 0; c < n; ++c) {
        float sum = fit_.data[grid_.index(c, row)];
        for (int k = -1; k <= 1; ++k) {
          const float share = k == 0 ? 4.0f : 1.0f;
          if (c + k > 0 && c + k + 1 < n) sum += share * fit_.stiffness[grid_.index(c + k, row)];
          if (row + k > 0 && row + k + 1 < grid_.rows) {
            sum += share * fit_.stiffness[grid_.index(c, row + k)];
          }
        }
        for (int y = row - 1; y <= row; ++y) {
          for (int x = c - 1; x <= c; ++x) {
            if (within(x, y) && within(x + 1, y + 1)) sum += 2 * mixed_[grid_.index(x, y)];
          }
        }
        diagonal[grid_.index(c, row)] = sum;
      }
    });
    return diagonal;
  }

 private:
  const Grid& grid_;
  const Fit& fit_;
  Field mixed_;
  Bends bends_;
};

// A row of a field as an array, whose expressions the compiler turns into vector instructions.
Eigen::Map<Eigen::ArrayXf> row_of(const Grid& grid, Field& field, int row) {
  return {&field[grid.index(0, row)], grid.columns};
}
Eigen::Map<const Eigen::ArrayXf> row_of(const Grid& grid, const Field& field, int row) {
  return {&field[grid.index(0, row)], grid.columns};
}

double dot(const Grid& grid, const Field& a, const Field& b) {
  return sum_over_rows(
      grid, [&](int row) { return (row_of(grid, a, row) * row_of(grid, b, row)).sum(); });
}

}  // namespace

float middle_stiffness(const Grid& grid, const Field& stiffness, std::size_t i) {
  const std::size_t up = i + grid.columns;
  return 0.25f * (stiffness[i] + stiffness[i + 1] + stiffness[up] + stiffness[up + 1]);
}

int solve(const Grid& grid, const Fit& fit, const SolveOptions& options, Field& surface) {
  Field right(grid.nodes());
  for (std::size_t i = 0; i < right.size(); ++i) right[i] = fit.data[i] * fit.target[i];
  return solve_right_side(grid, fit, right, options, surface);
}

int solve_right_side(const Grid& grid, const Fit& fit, const Field& right,
                     const SolveOptions& options, Field& surface) {
  Operator normal(grid, fit);
  Field inverse = normal.diagonal();
  for (float& value : inverse) value = value > 0 ? 1 / value : 0;
  const std::size_t nodes = grid.nodes();
  Field residual(nodes), ahead(nodes), product(nodes);
  normal.apply(surface, product);
  for (std::size_t i = 0; i < nodes; ++i) {
    residual[i] = right[i] - product[i];
    ahead[i] = inverse[i] * residual[i];
  }
  double now = dot(grid, residual, ahead);
  const double enough = static_cast<double>(nodes) * options.tolerance_m * options.tolerance_m;
  int small_steps = 0;
  int iteration = 0;
  while (iteration < options.most_iterations && now > 0 && small_steps < 5) {
    ++iteration;
    normal.apply(ahead, product);
    const double bending = dot(grid, ahead, product);
    if (!(bending > 0)) break;
    const auto step = static_cast<float>(now / bending);
    const double moved = step * step * dot(grid, ahead, ahead);
    small_steps = moved < 0.01 * enough ? small_steps + 1 : 0;
    const double before = now;
    now = sum_over_rows(grid, [&](int row) {
      row_of(grid, surface, row) += step * row_of(grid, ahead, row);
      row_of(grid, residual, row) -= step * row_of(grid, product, row);
      return (row_of(grid, inverse, row) * row_of(grid, residual, row).square()).sum();
    });
    const auto keep = static_cast<float>(now / before);
    for_rows(grid, [&](int row) {
      row_of(grid, ahead, row) = row_of(grid, inverse, row) * row_of(grid, residual, row) +
                                 keep * row_of(grid, ahead, row);
    });
  }
  return iteration;
}

Field curvature(const Grid& grid, const Field& s) {
  Field result(grid.nodes());
  const int n = grid.columns;
  for_rows(grid, [&](int row) {
    const int r = std::clamp(row, 1, std::max(1, grid.rows - 2));
    for (int column = 0; column < n; ++column) {
      const int c = std::clamp(column, 1, std::max(1, n - 2));
      const std::size_t i = grid.index(c, r);
      const float xx = s[i - 1] - 2 * s[i] + s[i + 1];
      const float yy = s[i - n] - 2 * s[i] + s[i + n];
      const float xy = 0.25f * (s[i - n - 1] - s[i - n + 1] - s[i + n - 1] + s[i + n + 1]);
      result[grid.index(column, row)] = std::sqrt(xx * xx + yy * yy + 2 * xy * xy);
    }
  });
  return result;
}

}  // namespace plotscan::ground
