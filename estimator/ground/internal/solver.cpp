// SPDX-License-Identifier: Apache-2.0
#include "ground/internal/solver.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

#include <Eigen/Core>

namespace plotscan::ground {
namespace {

using Row = Eigen::ArrayXf;

// A row of a field as an array, whose expressions the compiler turns into vector instructions.
Eigen::Map<Row> row_of(const Grid& grid, Field& field, int row) {
  return {&field[grid.index(0, row)], grid.columns};
}
Eigen::Map<const Row> row_of(const Grid& grid, const Field& field, int row) {
  return {&field[grid.index(0, row)], grid.columns};
}

// Calls body(first row, end of rows) for bands of rows, each worth a task of its own.
template <class Body>
void for_bands(const Grid& grid, const Body& body) {
  constexpr int kNodesATask = 1 << 13;
  tbb::parallel_for(tbb::blocked_range<int>(0, grid.rows, std::max(1, kNodesATask / grid.columns)),
                    [&](const tbb::blocked_range<int>& rows) { body(rows.begin(), rows.end()); });
}

// The second differences of a surface, weighted, in the rows around one: at nodes along x and along
// y, and in the middle of four nodes (index of the lower left one). A zero more on either side of
// each row, and zeros where there is no row.
class Bends {
 public:
  // `twice_mixed`: twice the stiffness in the middle of four nodes.
  Bends(const Grid& grid, const Field& stiffness, const Field& twice_mixed, const Field& s)
      : grid_(grid), stiffness_(stiffness), twice_mixed_(twice_mixed), s_(s) {
    for (Row* row : {&xx_, &yy_[0], &yy_[1], &yy_[2], &xy_[0], &xy_[1]})
      row->setZero(grid.columns + 2);
  }

  // Before the first row that is unbent.
  void start(int row) {
    bend_y(row - 1);
    bend_y(row);
    bend_xy(row - 1);
  }

  // The adjoint: adds to a row of `out` that of H^T (weighted H s). Rows follow each other.
  void unbend(int row, Eigen::Map<Row> out) {
    bend_y(row + 1);
    bend_xy(row);
    bend_x(row);
    const Eigen::Index n = grid_.columns;
    const Row& below = xy_of(row - 1);
    const Row& above = xy_of(row);
    out = out + (xx_.head(n) - 2 * xx_.segment(1, n) + xx_.tail(n)) - 2 * yy_of(row).segment(1, n) +
          (yy_of(row - 1).segment(1, n) - below.segment(1, n)) + below.head(n) +
          (yy_of(row + 1).segment(1, n) + above.segment(1, n)) - above.head(n);
  }

 private:
  Row& yy_of(int row) { return yy_[static_cast<std::size_t>(row + 3) % 3]; }
  Row& xy_of(int row) { return xy_[static_cast<std::size_t>(row + 2) % 2]; }

  void bend_x(int row) {
    const auto s = row_of(grid_, s_, row);
    const Eigen::Index n = grid_.columns - 2;
    xx_.segment(2, n) = row_of(grid_, stiffness_, row).segment(1, n) *
                        (s.head(n) - 2 * s.segment(1, n) + s.tail(n));
  }

  void bend_y(int row) {
    auto yy = yy_of(row).segment(1, grid_.columns);
    if (row <= 0 || row + 1 >= grid_.rows) {
      yy.setZero();
    } else {
      yy = row_of(grid_, stiffness_, row) *
           (row_of(grid_, s_, row - 1) - 2 * row_of(grid_, s_, row) + row_of(grid_, s_, row + 1));
    }
  }

  void bend_xy(int row) {
    const Eigen::Index n = grid_.columns - 1;
    auto xy = xy_of(row).segment(1, n);
    if (row < 0 || row + 1 >= grid_.rows) {
      xy.setZero();
    } else {
      const auto s = row_of(grid_, s_, row);
      const auto up = row_of(grid_, s_, row + 1);
      xy = row_of(grid_, twice_mixed_, row).head(n) *
           (s.head(n) - s.tail(n) - up.head(n) + up.tail(n));
    }
  }

  const Grid& grid_;
  const Field& stiffness_;
  const Field& twice_mixed_;
  const Field& s_;
  Row xx_;
  std::array<Row, 3> yy_;  // of the rows before, at and after the one that is unbent
  std::array<Row, 2> xy_;  // of the rows before and at it
};

class Operator {
 public:
  Operator(const Grid& grid, const Fit& fit) : grid_(grid), fit_(fit), twice_mixed_(grid.nodes()) {
    for_rows(grid, [&](int row) {
      if (row + 1 == grid.rows) return;
      for (int c = 0; c + 1 < grid.columns; ++c) {
        const std::size_t i = grid.index(c, row);
        twice_mixed_[i] = 2 * middle_stiffness(grid, fit.stiffness, i);
      }
    });
  }

  struct Products {
    double with_result = 0;
    double with_itself = 0;
  };

  // The inner products of s with the result and with itself, of rows added in their order.
  Products apply(const Field& s, Field& out) const {
    std::vector<Products> of_rows(static_cast<std::size_t>(grid_.rows));
    for_bands(grid_, [&](int first, int end) {
      Bends bends(grid_, fit_.stiffness, twice_mixed_, s);
      bends.start(first);
      for (int row = first; row < end; ++row) {
        const auto here = row_of(grid_, s, row);
        auto result = row_of(grid_, out, row);
        result = row_of(grid_, fit_.data, row) * here;
        bends.unbend(row, result);
        of_rows[static_cast<std::size_t>(row)] = {.with_result = (here * result).sum(),
                                                  .with_itself = (here * here).sum()};
      }
    });
    Products products;
    for (const Products& of_row : of_rows) {
      products.with_result += of_row.with_result;
      products.with_itself += of_row.with_itself;
    }
    return products;
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
            if (within(x, y) && within(x + 1, y + 1)) sum += twice_mixed_[grid_.index(x, y)];
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
  Field twice_mixed_;
};

// Sum of body(row) over the rows, added in their order whatever the number of threads.
template <class Body>
double sum_of_rows(const Grid& grid, const Body& body) {
  std::vector<double> sums(static_cast<std::size_t>(grid.rows));
  for_bands(grid, [&](int first, int end) {
    for (int row = first; row < end; ++row) sums[static_cast<std::size_t>(row)] = body(row);
  });
  return std::accumulate(sums.begin(), sums.end(), 0.0);
}

double dot(const Grid& grid, const Field& a, const Field& b) {
  return sum_of_rows(grid,
                     [&](int row) { return (row_of(grid, a, row) * row_of(grid, b, row)).sum(); });
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
  const Operator normal(grid, fit);
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
    const auto [bending, length] = normal.apply(ahead, product);
    if (!(bending > 0)) break;
    const auto step = static_cast<float>(now / bending);
    const double moved = step * step * length;
    small_steps = moved < 0.01 * enough ? small_steps + 1 : 0;
    const double before = now;
    now = sum_of_rows(grid, [&](int row) {
      row_of(grid, surface, row) += step * row_of(grid, ahead, row);
      row_of(grid, residual, row) -= step * row_of(grid, product, row);
      return (row_of(grid, inverse, row) * row_of(grid, residual, row).square()).sum();
    });
    const auto keep = static_cast<float>(now / before);
    for_bands(grid, [&](int first, int end) {
      for (int row = first; row < end; ++row)
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
