// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include <Eigen/Dense>

#include "ground/grid.h"
#include "ground/internal/solver.h"

namespace plotscan::ground {

// The matrix of the normal equations, term by term as solver.h states what is minimised.
inline Eigen::MatrixXd dense_normal(const Grid& grid, const Fit& fit) {
  const auto nodes = static_cast<Eigen::Index>(grid.nodes());
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(nodes, nodes);
  const auto add = [&](double weight, const std::vector<std::array<int, 3>>& terms) {
    Eigen::VectorXd difference = Eigen::VectorXd::Zero(nodes);
    for (const auto& [column, row, factor] : terms)
      difference[static_cast<Eigen::Index>(grid.index(column, row))] += factor;
    normal += weight * difference * difference.transpose();
  };
  const auto stiffness = [&](int c, int r) -> double { return fit.stiffness[grid.index(c, r)]; };
  for (int r = 0; r < grid.rows; ++r) {
    for (int c = 0; c < grid.columns; ++c) {
      add(fit.data[grid.index(c, r)], {{c, r, 1}});
      if (c > 0 && c + 1 < grid.columns)
        add(stiffness(c, r), {{c - 1, r, 1}, {c, r, -2}, {c + 1, r, 1}});
      if (r > 0 && r + 1 < grid.rows)
        add(stiffness(c, r), {{c, r - 1, 1}, {c, r, -2}, {c, r + 1, 1}});
      if (c + 1 == grid.columns || r + 1 == grid.rows) continue;
      const double middle = 0.25 * (stiffness(c, r) + stiffness(c + 1, r) + stiffness(c, r + 1) +
                                    stiffness(c + 1, r + 1));
      add(2 * middle, {{c, r, 1}, {c + 1, r, -1}, {c, r + 1, -1}, {c + 1, r + 1, 1}});
    }
  }
  return normal;
}

inline Eigen::VectorXd vector_of(const Field& field) {
  return Eigen::Map<const Eigen::VectorXf>(field.data(), static_cast<Eigen::Index>(field.size()))
      .cast<double>();
}

}  // namespace plotscan::ground
