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
  for (std::size_t i = 1; i < positions.size(); ++i)
    steps.push_back(positions[i] - positions[i - 1]);
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

// Centres as measured, and their rows and columns.
struct Centers {
  std::vector<int> row, column;
  std::vector<double> r, c;
};

Centers measured_centers(const Lattice& lattice) {
  const auto r_shifts = measured_shifts(lattice, true), c_shifts = measured_shifts(lattice, false);
  Centers centers;
  for (std::size_t i = 0; i < lattice.places.size(); ++i) {
    const Place& place = lattice.places[i];
    centers.row.push_back(place.row);
    centers.column.push_back(place.column);
    centers.r.push_back(place.r_m + r_shifts[i].value_or(0));
    centers.c.push_back(place.c_m + c_shifts[i].value_or(0));
  }
  return centers;
}

double mean_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

double spread_of(const std::vector<double>& values) {
  const double mean = mean_of(values);
  double squares = 0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return squares;
}

// Means by group of values less what another grouping explains.
std::vector<double> group_means(const std::vector<int>& group, int groups,
                                const std::vector<double>& values) {
  std::vector<double> sums(static_cast<std::size_t>(groups));
  for (std::size_t i = 0; i < group.size(); ++i)
    sums[static_cast<std::size_t>(group[i])] += values[i];
  const std::vector<double> counts = counts_of(group, groups);
  for (std::size_t g = 0; g < sums.size(); ++g) sums[g] /= std::max(1.0, counts[g]);
  return sums;
}

// c of a plot = its column's place + its row's offset.
struct Columns {
  std::vector<double> column_at, row_offset;
  double rms_m = 0;
};

Columns fit_columns(const Lattice& lattice, const Centers& centers) {
  constexpr int kRounds = 8;
  Columns fit;
  fit.row_offset.assign(static_cast<std::size_t>(lattice.rows), 0);
  const std::vector<double> counts = counts_of(centers.column, lattice.columns);
  for (int round = 0; round < kRounds; ++round) {
    std::vector<double> rest(centers.c);
    for (std::size_t i = 0; i < rest.size(); ++i) {
      rest[i] -= fit.row_offset[static_cast<std::size_t>(centers.row[i])];
    }
    if (lattice.aligned) {
      fit.column_at = group_means(centers.column, lattice.columns, rest);
      const double error_m = rms_about(centers.column, fit.column_at, 0, rest, rest);
      fit.column_at = with_equal_steps(fit.column_at, counts, error_m);
    } else {
      double pitch_m = 0;
      const std::vector<double> index(centers.column.begin(), centers.column.end());
      means_and_slope(centers.row, lattice.rows, index, rest, pitch_m);
      fit.column_at.clear();
      for (int column = 0; column < lattice.columns; ++column)
        fit.column_at.push_back(pitch_m * column);
    }
    for (std::size_t i = 0; i < rest.size(); ++i) {
      rest[i] = centers.c[i] - fit.column_at[static_cast<std::size_t>(centers.column[i])];
    }
    fit.row_offset = group_means(centers.row, lattice.rows, rest);
    fit.rms_m = rms_about(centers.row, fit.row_offset, 0, rest, rest);
  }
  return fit;
}

// c that every metre along r adds, where the rows' offsets lie on a line.
struct Skew {
  double c_per_r = 0, error = 0;
  bool straight = false;
};

Skew fit_skew(const Lattice& lattice, const std::vector<double>& row_at, const Centers& centers,
              const Columns& columns) {
  std::vector<double> x, y;
  for (const int row : centers.row) {
    x.push_back(row_at[static_cast<std::size_t>(row)]);
    y.push_back(columns.row_offset[static_cast<std::size_t>(row)]);
  }
  const double spread = spread_of(x), mean_x = mean_of(x), mean_y = mean_of(y);
  if (spread <= 0) return {};
  Skew skew;
  for (std::size_t i = 0; i < x.size(); ++i)
    skew.c_per_r += (x[i] - mean_x) * (y[i] - mean_y) / spread;
  skew.error = std::max(0.005, columns.rms_m) / std::sqrt(spread);
  skew.straight = true;
  const std::vector<double> counts = counts_of(centers.row, lattice.rows);
  for (std::size_t row = 0; row < row_at.size(); ++row) {
    const double off_m = columns.row_offset[row] - mean_y - skew.c_per_r * (row_at[row] - mean_x);
    skew.straight = skew.straight &&
                    std::abs(off_m) < std::max(0.03, 3.5 * columns.rms_m / std::sqrt(counts[row]));
  }
  return skew;
}

}  // namespace

void straighten(Lattice& lattice) {
  const Centers centers = measured_centers(lattice);
  std::vector<double> row_at =
      means_and_slope(centers.row, lattice.rows, centers.c, centers.r, lattice.r_per_c);
  lattice.r_rms_m = rms_about(centers.row, row_at, lattice.r_per_c, centers.c, centers.r);
  Columns columns = fit_columns(lattice, centers);
  lattice.c_rms_m = columns.rms_m;
  const Skew skew = fit_skew(lattice, row_at, centers, columns);

  // Axes are perpendicular unless the rows' offsets say otherwise beyond doubt.
  std::vector<double> within_rows(centers.c);
  const std::vector<double> row_c = group_means(centers.row, lattice.rows, centers.c);
  for (std::size_t i = 0; i < within_rows.size(); ++i) {
    within_rows[i] -= row_c[static_cast<std::size_t>(centers.row[i])];
  }
  const double row_spread = spread_of(within_rows);
  const double row_error =
      row_spread > 0 ? std::max(0.005, lattice.r_rms_m) / std::sqrt(row_spread) : 1;
  const double between = lattice.view.r_axis().dot(lattice.view.c_axis());
  const double off = skew.c_per_r + (between + lattice.r_per_c) / (1 + between * lattice.r_per_c);
  const double error = std::hypot(skew.error, row_error);
  const bool rows_tell = row_spread > 1;
  const bool columns_tell = skew.straight && lattice.rows >= 2;
  lattice.perpendicular = !columns_tell || !rows_tell ||
                          std::abs(off) < std::max(0.001, 3 * error) ||
                          (lattice.rows < 3 && std::abs(off) > 0.01);
  const bool straight =
      columns_tell && (!lattice.perpendicular || std::abs(off) < std::max(0.001, 3 * error));
  if (!rows_tell) {
    lattice.c_per_r = skew.c_per_r;
    lattice.r_per_c = -(between + skew.c_per_r) / (1 + between * skew.c_per_r);
  } else if (!lattice.perpendicular) {
    lattice.c_per_r = skew.c_per_r;
  } else if (straight) {
    const double share = skew.error * skew.error / (error * error);
    lattice.c_per_r = skew.c_per_r - share * off;
    lattice.r_per_c -= (1 - share) * off;
  } else {
    lattice.c_per_r = skew.c_per_r - off;
  }

  std::vector<double> rest(centers.r);
  for (std::size_t i = 0; i < rest.size(); ++i) rest[i] -= lattice.r_per_c * centers.c[i];
  row_at = with_equal_steps(group_means(centers.row, lattice.rows, rest),
                            counts_of(centers.row, lattice.rows), lattice.r_rms_m);
  if (straight) {
    std::vector<double> offsets;
    for (std::size_t i = 0; i < centers.r.size(); ++i) {
      offsets.push_back(columns.row_offset[static_cast<std::size_t>(centers.row[i])] -
                        lattice.c_per_r * centers.r[i]);
    }
    const double offset = mean_of(offsets);
    const std::vector<double> mean_r = group_means(centers.row, lattice.rows, centers.r);
    for (std::size_t row = 0; row < row_at.size(); ++row) {
      columns.row_offset[row] = offset + lattice.c_per_r * mean_r[row];
    }
  }
  const std::vector<double> mean_r = group_means(centers.row, lattice.rows, centers.r);
  for (std::size_t i = 0; i < lattice.places.size(); ++i) {
    Place& place = lattice.places[i];
    const auto row = static_cast<std::size_t>(place.row);
    const double c =
        columns.column_at[static_cast<std::size_t>(place.column)] + columns.row_offset[row];
    place.r_m = row_at[row] + lattice.r_per_c * c;
    place.c_m = c + lattice.c_per_r * (place.r_m - mean_r[row]);
  }
}

}  // namespace plotscan::plots
