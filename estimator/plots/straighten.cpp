// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include <Eigen/QR>

#include "plots/centers.h"
#include "plots/lattice.h"
#include "plots/statistics.h"

namespace plotscan::plots {
namespace {

// One mean for each row (or column) and a common slope within them.
std::vector<double> means_and_slope(const std::vector<int>& group, int groups,
                                    const std::vector<double>& x, const std::vector<double>& y,
                                    double& slope) {
  std::vector<double> count(static_cast<std::size_t>(groups)), mean_x(count), mean_y(count);
  for (std::size_t i = 0; i < group.size(); ++i) {
    const auto g = static_cast<std::size_t>(group[i]);
    count[g] += 1;
    mean_x[g] += x[i];
    mean_y[g] += y[i];
  }
  for (std::size_t g = 0; g < count.size(); ++g) {
    mean_x[g] /= std::max(1.0, count[g]);
    mean_y[g] /= std::max(1.0, count[g]);
  }
  double xx = 0, xy = 0;
  for (std::size_t i = 0; i < group.size(); ++i) {
    const auto g = static_cast<std::size_t>(group[i]);
    xx += (x[i] - mean_x[g]) * (x[i] - mean_x[g]);
    xy += (x[i] - mean_x[g]) * (y[i] - mean_y[g]);
  }
  slope = xx > 0 ? xy / xx : 0;
  for (std::size_t g = 0; g < count.size(); ++g) mean_y[g] -= slope * mean_x[g];
  return mean_y;
}

// Positions of rows or columns, each a mean of `counts` centres of error sigma_m, smoothed: equal
// steps, but for those alleys that clearly differ.
std::vector<double> with_equal_steps(const std::vector<double>& positions,
                                     const std::vector<double>& counts, double sigma_m) {
  const auto size = static_cast<Eigen::Index>(positions.size());
  if (size < 3) return positions;
  std::vector<double> steps;
  for (std::size_t i = 1; i < positions.size(); ++i) steps.push_back(positions[i] - positions[i - 1]);
  const double step_m = median(steps);
  std::vector<std::size_t> alleys;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const double error_m = sigma_m * std::sqrt(1 / counts[i] + 1 / counts[i + 1]);
    if (std::abs(steps[i] - step_m) > std::max(0.06, 4 * error_m)) alleys.push_back(i);
  }
  const auto unknowns = static_cast<Eigen::Index>(2 + alleys.size());
  if (unknowns >= size) return positions;
  Eigen::MatrixXd design = Eigen::MatrixXd::Zero(size, unknowns);
  Eigen::VectorXd right(size);
  for (Eigen::Index i = 0; i < size; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const double weight = std::sqrt(counts[at]);
    design(i, 0) = weight;
    design(i, 1) = weight * static_cast<double>(i);
    for (std::size_t k = 0; k < alleys.size(); ++k) {
      design(i, static_cast<Eigen::Index>(2 + k)) = at > alleys[k] ? weight : 0;
    }
    right(i) = weight * positions[at];
  }
  const Eigen::VectorXd fitted = design.colPivHouseholderQr().solve(right);
  std::vector<double> smooth;
  for (Eigen::Index i = 0; i < size; ++i) {
    smooth.push_back(design.row(i).dot(fitted) / design(i, 0));
  }
  return smooth;
}

std::vector<double> counts_of(const std::vector<int>& group, int groups) {
  std::vector<double> counts(static_cast<std::size_t>(groups));
  for (const int g : group) counts[static_cast<std::size_t>(g)] += 1;
  return counts;
}

double rms_about(const std::vector<int>& group, const std::vector<double>& at, double slope,
                 const std::vector<double>& x, const std::vector<double>& y) {
  double squares = 0;
  for (std::size_t i = 0; i < y.size(); ++i) {
    const double rest = y[i] - at[static_cast<std::size_t>(group[i])] - slope * x[i];
    squares += rest * rest;
  }
  // Each mean took a degree of freedom, and so did the slope.
  const double free = static_cast<double>(y.size()) - static_cast<double>(at.size()) - 1;
  return std::sqrt(squares / std::max(1.0, free));
}

}  // namespace

void straighten(Lattice& lattice) {
  std::vector<int> row, column;
  std::vector<double> r, c;
  const auto r_shifts = measured_shifts(lattice, true), c_shifts = measured_shifts(lattice, false);
  for (std::size_t i = 0; i < lattice.places.size(); ++i) {
    const Place& place = lattice.places[i];
    row.push_back(place.row);
    column.push_back(place.column);
    r.push_back(place.r_m + r_shifts[i].value_or(0));
    c.push_back(place.c_m + c_shifts[i].value_or(0));
  }
  std::vector<double> row_at = means_and_slope(row, lattice.rows, c, r, lattice.r_per_c);
  row_at = with_equal_steps(row_at, counts_of(row, lattice.rows),
                            rms_about(row, row_at, lattice.r_per_c, c, r));
  std::vector<double> column_at;
  if (lattice.aligned) {
    column_at = means_and_slope(column, lattice.columns, r, c, lattice.c_per_r);
    column_at = with_equal_steps(column_at, counts_of(column, lattice.columns),
                                 rms_about(column, column_at, lattice.c_per_r, r, c));
  } else {
    std::vector<double> index(column.begin(), column.end());
    column_at = means_and_slope(row, lattice.rows, index, c, lattice.c_pitch_m);
  }
  double r_squares = 0, c_squares = 0;
  for (std::size_t i = 0; i < lattice.places.size(); ++i) {
    Place& place = lattice.places[i];
    place.r_m = row_at[static_cast<std::size_t>(place.row)] + lattice.r_per_c * c[i];
    place.c_m = lattice.aligned
                    ? column_at[static_cast<std::size_t>(place.column)] + lattice.c_per_r * r[i]
                    : column_at[static_cast<std::size_t>(place.row)] + lattice.c_pitch_m * place.column;
    r_squares += (place.r_m - r[i]) * (place.r_m - r[i]);
    c_squares += (place.c_m - c[i]) * (place.c_m - c[i]);
  }
  const double count = std::max<double>(1, static_cast<double>(lattice.places.size()));
  lattice.r_rms_m = std::sqrt(r_squares / count);
  lattice.c_rms_m = std::sqrt(c_squares / count);
}

}  // namespace plotscan::plots
