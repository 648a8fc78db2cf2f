// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/QR>

#include "core/statistics.h"
#include "plots/lattice/internal/centers.h"
#include "plots/lattice/lattice.h"
#include "plots/layout/steps.h"

namespace plotscan::plots {
namespace {

// From the usual step. Of plots that touch it is known; rows are seen up to a hand beside them, as
// leaves lean to where there is light. Chosen.
constexpr double kLeastOddStep_m = 0.06, kLeastAlley_m = 0.35;
constexpr double kLeastError_m = 0.005;  // of centres about the lattice, however few they are

// Which row, or which column, each plot lies in.
class PlotGroups {
 public:
  PlotGroups(std::vector<int> of_plots, int count)
      : of_plots_(std::move(of_plots)), counts_(static_cast<std::size_t>(count)) {
    for (const int group : of_plots_) counts_[static_cast<std::size_t>(group)] += 1;
  }

  std::size_t plots() const { return of_plots_.size(); }
  std::size_t count() const { return counts_.size(); }
  std::size_t of(std::size_t plot) const { return static_cast<std::size_t>(of_plots_[plot]); }
  const std::vector<double>& counts() const { return counts_; }

  std::vector<double> means(const std::vector<double>& values) const {
    return means(values, std::vector<double>(plots(), 1));
  }
  // Weighted mean of each group; unweighted where all weights of a group are 0.
  std::vector<double> means(const std::vector<double>& values,
                            const std::vector<double>& weights) const {
    std::vector<double> sums(count()), weighted(count()), weight(count());
    for (std::size_t i = 0; i < plots(); ++i) {
      sums[of(i)] += values[i];
      weighted[of(i)] += weights[i] * values[i];
      weight[of(i)] += weights[i];
    }
    for (std::size_t g = 0; g < count(); ++g)
      sums[g] = weight[g] > 0 ? weighted[g] / weight[g] : sums[g] / std::max(1.0, counts_[g]);
    return sums;
  }
  // The plots' values minus those of their groups.
  std::vector<double> less(const std::vector<double>& values,
                           const std::vector<double>& of_groups) const {
    std::vector<double> rest(values);
    for (std::size_t i = 0; i < plots(); ++i) rest[i] -= of_groups[of(i)];
    return rest;
  }
  // Gives each plot the value of its group.
  std::vector<double> spread_out(const std::vector<double>& of_groups) const {
    std::vector<double> values;
    for (std::size_t i = 0; i < plots(); ++i) values.push_back(of_groups[of(i)]);
    return values;
  }

 private:
  std::vector<int> of_plots_;
  std::vector<double> counts_;
};

double sum_of_squares(const std::vector<double>& values) {
  double squares = 0;
  for (const double value : values) squares += value * value;
  return squares;
}

double spread_of(std::vector<double> values) {
  const double middle = mean(values);
  for (double& value : values) value -= middle;
  return sum_of_squares(values);
}

// Root mean square of residuals about a fit of one mean for each group and one slope.
double rms_of(const std::vector<double>& rest, const PlotGroups& groups) {
  const double free = static_cast<double>(rest.size()) - static_cast<double>(groups.count()) - 1;
  return std::sqrt(sum_of_squares(rest) / std::max(1.0, free));
}

// y = at[group] + slope * x.
struct LinesOfGroups {
  std::vector<double> at;
  double slope = 0, rms_m = 0;
};

LinesOfGroups fit_lines(const PlotGroups& groups, const std::vector<double>& x,
                        const std::vector<double>& y) {
  const std::vector<double> mean_x = groups.means(x), mean_y = groups.means(y);
  const std::vector<double> from_x = groups.less(x, mean_x), from_y = groups.less(y, mean_y);
  const double xx = sum_of_squares(from_x);
  double xy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) xy += from_x[i] * from_y[i];
  LinesOfGroups lines{.at = mean_y, .slope = xx > 0 ? xy / xx : 0};
  for (std::size_t g = 0; g < groups.count(); ++g) lines.at[g] -= lines.slope * mean_x[g];
  std::vector<double> rest = groups.less(y, lines.at);
  for (std::size_t i = 0; i < x.size(); ++i) rest[i] -= lines.slope * x[i];
  lines.rms_m = rms_of(rest, groups);
  return lines;
}

// The positions of rows or columns, and the number of parameters of their fit.
struct Positions {
  std::vector<double> at;
  double parameters = 0;
  std::vector<double> in_place = std::vector<double>(at.size(), 1);  // 0: its plots lie beside it
};

// Rows or columns as measured, each the mean of `counts` centres of error sigma_m.
struct MeasuredLines {
  const std::vector<double>& at;
  const std::vector<double>& counts;
  double sigma_m = 0;
  double step_m = 0;  // the usual one
  double least_alley_m = 0;

  // Whether the way from one to another differs from as many usual steps, beyond its error: -1
  // shorter, 1 longer, 0 neither.
  int unusual(std::size_t from, std::size_t to) const {
    const double error_m = sigma_m * std::sqrt(1 / counts[from] + 1 / counts[to]);
    const double off_m = at[to] - at[from] - static_cast<double>(to - from) * step_m;
    if (std::abs(off_m) <= std::max(least_alley_m, 4 * error_m)) return 0;
    return off_m > 0 ? 1 : -1;
  }
};

double median_step_m(const std::vector<double>& at) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < at.size(); ++i) steps.push_back(at[i] - at[i - 1]);
  return quantile(steps, 0.5);
}

// Whether a row lies between a step that is too wide and one that is too narrow, two usual ones
// together, while the steps beyond are as usual: its plots are lodged, or leaves were taken for
// plots. (Where wide and narrow steps alternate, the field was sown so.)
bool is_out_of_place(std::size_t row, const std::vector<int>& unusual, const MeasuredLines& lines) {
  if (row == 0 || row == unusual.size() || unusual[row - 1] * unusual[row] != -1) return false;
  const bool alone_before = row < 2 || unusual[row - 2] == 0;
  const bool alone_behind = row + 1 >= unusual.size() || unusual[row + 1] == 0;
  return alone_before && alone_behind && lines.unusual(row - 1, row + 1) == 0;
}

// The lines that follow a step that is no usual one.
std::vector<std::size_t> alleys_before(const std::vector<int>& unusual,
                                       const std::vector<double>& weights) {
  std::vector<std::size_t> alleys;
  for (std::size_t i = 0; i < unusual.size(); ++i)
    if (unusual[i] != 0 && weights[i] > 0 && weights[i + 1] > 0) alleys.push_back(i + 1);
  return alleys;
}

// Positions of rows or columns, each a mean of `counts` centres of error sigma_m, smoothed: equal
// steps, of that size if it is known, except at alleys that clearly differ.
Positions with_equal_steps(const std::vector<double>& positions, const std::vector<double>& counts,
                           double sigma_m, std::optional<double> known_step_m) {
  const auto size = static_cast<Eigen::Index>(positions.size());
  Positions as_they_are{.at = positions, .parameters = static_cast<double>(size)};
  if (size < (known_step_m ? 2 : 3)) return as_they_are;
  const MeasuredLines lines{.at = positions,
                            .counts = counts,
                            .sigma_m = sigma_m,
                            .step_m = known_step_m.value_or(median_step_m(positions)),
                            .least_alley_m = known_step_m ? kLeastAlley_m : kLeastOddStep_m};
  std::vector<int> unusual;
  for (std::size_t row = 1; row < positions.size(); ++row)
    unusual.push_back(lines.unusual(row - 1, row));
  std::vector<double> in_place, weights;
  for (std::size_t row = 0; row < positions.size(); ++row) {
    in_place.push_back(is_out_of_place(row, unusual, lines) ? 0 : 1);
    weights.push_back(in_place.back() * std::sqrt(counts[row]));
  }
  const std::vector<std::size_t> alleys = alleys_before(unusual, weights);
  const auto unknowns = static_cast<Eigen::Index>((known_step_m ? 1 : 2) + alleys.size());
  if (unknowns >= size - std::ranges::count(weights, 0.0)) return as_they_are;
  const Eigen::VectorXd numbers =
      Eigen::VectorXd::LinSpaced(size, 0, static_cast<double>(size - 1));
  Eigen::MatrixXd design = Eigen::MatrixXd::Zero(size, unknowns);
  design.col(0).setOnes();
  if (!known_step_m) design.col(1) = numbers;
  Eigen::Index column = known_step_m ? 1 : 2;
  for (const std::size_t alley : alleys)
    design.col(column++).tail(size - static_cast<Eigen::Index>(alley)).setOnes();
  const Eigen::VectorXd known = known_step_m.value_or(0) * numbers;
  const Eigen::Map<const Eigen::VectorXd> at(positions.data(), size), weight(weights.data(), size);
  const Eigen::VectorXd fitted = (weight.asDiagonal() * design)
                                     .colPivHouseholderQr()
                                     .solve(weight.asDiagonal() * (at - known));
  const Eigen::VectorXd smooth = design * fitted + known;
  return {.at = {smooth.begin(), smooth.end()},
          .parameters = static_cast<double>(unknowns),
          .in_place = std::move(in_place)};
}

// Centres as measured, and their rows and columns.
struct Centers {
  PlotGroups row, column;
  std::vector<double> r, c;
};

// Shifts of the plots' centres. A lodged plot does not show where it was sown: it has the mean
// shift of its row or column, which it thus does not change.
std::vector<double> shifts_of(const Lattice& lattice,
                              const std::vector<std::optional<double>>& measured,
                              const PlotGroups& groups) {
  std::vector<double> shifts, weights;
  for (std::size_t i = 0; i < measured.size(); ++i) {
    shifts.push_back(measured[i].value_or(0));
    weights.push_back(lattice.places[i].lodged ? 0 : 1);
  }
  const std::vector<double> of_groups = groups.spread_out(groups.means(shifts, weights));
  for (std::size_t i = 0; i < shifts.size(); ++i)
    if (lattice.places[i].lodged) shifts[i] = of_groups[i];
  return shifts;
}

Centers measured_centers(const Lattice& lattice) {
  std::vector<int> rows, columns;
  for (const Place& place : lattice.places) {
    rows.push_back(place.row);
    columns.push_back(place.column);
  }
  Centers centers{.row = {std::move(rows), lattice.rows},
                  .column = {std::move(columns), lattice.columns},
                  .r = {},
                  .c = {}};
  centers.r = shifts_of(lattice, measured_shifts(lattice), centers.row);
  centers.c = shifts_of(lattice, measured_shifts(lattice.turned()),
                        lattice.aligned ? centers.column : centers.row);
  for (std::size_t i = 0; i < lattice.places.size(); ++i) {
    centers.r[i] += lattice.places[i].r_m;
    centers.c[i] += lattice.places[i].c_m;
  }
  return centers;
}

// c of a plot = its column's place + its row's offset.
struct Columns {
  Positions column;
  std::vector<double> row_offset;
  double rms_m = 0;
};

// Positions of the columns, from plots' c without their rows' offsets.
Positions columns_at(const Lattice& lattice, const Centers& centers, const std::vector<double>& c) {
  if (lattice.aligned) {
    std::vector<double> at = centers.column.means(c);
    const double error_m = rms_of(centers.column.less(c, at), centers.column);
    return with_equal_steps(at, centers.column.counts(), error_m, lattice.c.touching_m);
  }
  std::vector<double> numbers(centers.column.count());
  for (std::size_t column = 0; column < numbers.size(); ++column)
    numbers[column] = static_cast<double>(column);
  const double pitch_m = lattice.c.touching_m.value_or(
      fit_lines(centers.row, centers.column.spread_out(numbers), c).slope);
  for (double& number : numbers) number *= pitch_m;
  return {.at = std::move(numbers), .parameters = 1};
}

// Fits the columns' places and the rows' offsets in turn.
Columns fit_columns(const Lattice& lattice, const Centers& centers) {
  constexpr int kRounds = 8;
  Columns fit;
  fit.row_offset.assign(centers.row.count(), 0);
  for (int round = 0; round < kRounds; ++round) {
    fit.column = columns_at(lattice, centers, centers.row.less(centers.c, fit.row_offset));
    const std::vector<double> rest = centers.column.less(centers.c, fit.column.at);
    fit.row_offset = centers.row.means(rest, centers.column.spread_out(fit.column.in_place));
    fit.rms_m = rms_of(centers.row.less(rest, fit.row_offset), centers.row);
  }
  return fit;
}

// The change of c per metre along r, where the rows' offsets lie on a line.
struct Skew {
  double c_per_r = 0, error = 0;
  bool straight = false;
};

Skew fit_skew(const Centers& centers, const std::vector<double>& row_at, const Columns& columns) {
  const std::vector<double> x = centers.row.spread_out(row_at);
  const std::vector<double> y = centers.row.spread_out(columns.row_offset);
  const double spread = spread_of(x), mean_x = mean(x), mean_y = mean(y);
  if (spread <= 0) return {};
  Skew skew{.error = std::max(kLeastError_m, columns.rms_m) / std::sqrt(spread), .straight = true};
  for (std::size_t i = 0; i < x.size(); ++i)
    skew.c_per_r += (x[i] - mean_x) * (y[i] - mean_y) / spread;
  for (std::size_t row = 0; row < row_at.size(); ++row) {
    const double off_m = columns.row_offset[row] - mean_y - skew.c_per_r * (row_at[row] - mean_x);
    const double error_m = columns.rms_m / std::sqrt(centers.row.counts()[row]);
    skew.straight = skew.straight && std::abs(off_m) < std::max(0.03, 3.5 * error_m);
  }
  return skew;
}

// How rows and columns run: slopes to the view's axes.
struct Directions {
  double r_per_c = 0, c_per_r = 0;
  double error = 0;               // standard error of either slope
  bool columns_straight = false;  // the rows' offsets are those of straight columns
};

// Axes are perpendicular unless the rows' offsets say otherwise beyond doubt. `between` is the
// cosine between the view's axes.
Directions directions_of(const Centers& centers, const LinesOfGroups& rows, const Skew& skew,
                         double between) {
  const double along_rows = spread_of(centers.row.less(centers.c, centers.row.means(centers.c)));
  const double row_error =
      along_rows > 0 ? std::max(kLeastError_m, rows.rms_m) / std::sqrt(along_rows) : 1;
  const double off = skew.c_per_r + (between + rows.slope) / (1 + between * rows.slope);
  const double error = std::hypot(skew.error, row_error);
  const bool rows_tell = along_rows > 1;
  const bool columns_tell = skew.straight && centers.row.count() >= 2;
  const bool right_angle = std::abs(off) < std::max(0.001, 3 * error);
  const bool skewed = columns_tell && rows_tell && !right_angle &&
                      (centers.row.count() >= 3 || std::abs(off) <= 0.01);
  const bool straight = columns_tell && (skewed || right_angle);
  const double by_columns = -(between + skew.c_per_r) / (1 + between * skew.c_per_r);
  if (!rows_tell) return {by_columns, skew.c_per_r, skew.error, straight};
  if (skewed) return {rows.slope, skew.c_per_r, std::max(row_error, skew.error), straight};
  if (!straight) return {rows.slope, skew.c_per_r - off, row_error, straight};
  const double share = skew.error * skew.error / (error * error);
  return {rows.slope - (1 - share) * off, skew.c_per_r - share * off,
          row_error * skew.error / error, straight};
}

// The rows' offsets on one line along the columns.
std::vector<double> offsets_on_line(const Centers& centers, const Columns& columns,
                                    double c_per_r) {
  std::vector<double> offsets = centers.row.spread_out(columns.row_offset);
  for (std::size_t i = 0; i < offsets.size(); ++i) offsets[i] -= c_per_r * centers.r[i];
  const double offset_m = mean(offsets);
  std::vector<double> on_line = centers.row.means(centers.r);
  for (double& row : on_line) row = offset_m + c_per_r * row;
  return on_line;
}

// The usual step between neighbouring lines that hold plots; `before` where there are none.
double pitch_of(const Positions& lines, const PlotGroups& plots, double before) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < lines.at.size(); ++i) {
    if (plots.counts()[i - 1] > 0 && plots.counts()[i] > 0)
      steps.push_back(lines.at[i] - lines.at[i - 1]);
  }
  return steps.empty() ? before : usual_step(std::move(steps));
}

}  // namespace

void straighten(Lattice& lattice) {
  const Centers centers = measured_centers(lattice);
  const LinesOfGroups rows = fit_lines(centers.row, centers.c, centers.r);
  Columns columns = fit_columns(lattice, centers);
  // Rows with offsets of their own do not show the direction of the plots' sides, even if the
  // offsets lie on a line.
  const Skew skew = lattice.aligned ? fit_skew(centers, rows.at, columns) : Skew{};
  const Directions directions =
      directions_of(centers, rows, skew, lattice.view.r_axis().dot(lattice.view.c_axis()));
  lattice.r_per_c = directions.r_per_c;
  lattice.c_per_r = directions.c_per_r;
  lattice.turn_error_rad = directions.error;
  lattice.r.rms_m = rows.rms_m;
  lattice.c.rms_m = columns.rms_m;

  std::vector<double> r_at_0 = centers.r;
  for (std::size_t i = 0; i < r_at_0.size(); ++i) r_at_0[i] -= lattice.r_per_c * centers.c[i];
  const Positions row = with_equal_steps(centers.row.means(r_at_0), centers.row.counts(),
                                         lattice.r.rms_m, lattice.r.touching_m);
  if (directions.columns_straight)
    columns.row_offset = offsets_on_line(centers, columns, lattice.c_per_r);
  lattice.r.parameters = row.parameters + 1;  // the rows' slope
  lattice.c.parameters =
      columns.column.parameters +
      (directions.columns_straight ? 1 : static_cast<double>(centers.row.count() - 1));
  lattice.r.pitch_m = pitch_of(row, centers.row, lattice.r.pitch_m);
  lattice.c.pitch_m = pitch_of(columns.column, centers.column, lattice.c.pitch_m);
  const std::vector<double> row_middle = centers.row.means(centers.r);
  for (std::size_t i = 0; i < lattice.places.size(); ++i) {
    Place& place = lattice.places[i];
    const std::size_t of_row = centers.row.of(i);
    const double c_m = columns.column.at[centers.column.of(i)] + columns.row_offset[of_row];
    place.r_m = row.at[of_row] + lattice.r_per_c * c_m;
    place.c_m = c_m + lattice.c_per_r * (place.r_m - row_middle[of_row]);
  }
}

}  // namespace plotscan::plots
