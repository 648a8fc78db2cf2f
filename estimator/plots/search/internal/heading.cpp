// SPDX-License-Identifier: Apache-2.0
#include "plots/search/internal/heading.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "core/angle.h"
#include "core/statistics.h"
#include "plots/canopy/field_blocks.h"
#include "plots/layout/steps.h"

namespace plotscan::plots {
namespace {

constexpr int kAngles = 180;
constexpr int kMostSkew_deg = 15;  // of the axes, off the right angle
constexpr double kSkewDoubt = 0.25;
constexpr double kTilt_rad = 0.5 * kDegrees;  // between what the families say: one is tilted
constexpr double kHintReach_rad = 5 * kDegrees;
constexpr int kApart_deg = 10;         // between pairs of which neither family is the same
constexpr double kLeastOfBest = 0.25;  // of the best pair's worth: the other may be the plots'
constexpr double kBareAround_m = 2;    // of bare ground about the canopy

struct Cell {
  float x, y, cover;
};

struct Cells {
  std::vector<Cell> all = {};
  std::vector<Cell> row_ends = {};  // the first and the last cell of each of the raster's rows
};

// Cells [a0, a1) by [b0, b1) of a raster.
struct Window {
  int a0 = 0, a1 = 0, b0 = 0, b1 = 0;
};

// The canopy and some bare ground around it.
Window about_canopy(const CanopyRaster& raster) {
  const int around = static_cast<int>(kBareAround_m / raster.cell_m());
  const int block = std::max(1, around / 2);
  std::vector<double> covers;
  for (int a = 0; a < raster.a_cells(); a += block)
    for (int b = 0; b < raster.b_cells(); b += block)
      covers.push_back(raster.cover(a, a + block, b, b + block));
  const double least = least_cover(covers);
  Window window{raster.a_cells(), 0, raster.b_cells(), 0};
  auto cover = covers.begin();
  for (int a = 0; a < raster.a_cells(); a += block) {
    for (int b = 0; b < raster.b_cells(); b += block) {
      if (*cover++ < least) continue;
      window.a0 = std::min(window.a0, std::max(0, a - around));
      window.a1 = std::max(window.a1, std::min(raster.a_cells(), a + block + around));
      window.b0 = std::min(window.b0, std::max(0, b - around));
      window.b1 = std::max(window.b1, std::min(raster.b_cells(), b + block + around));
    }
  }
  return window;
}

// The cells about the canopy: bare ground has no lines.
Cells cells_of(const CanopyRaster& raster) {
  const auto middle = [&](int cell) { return static_cast<float>((cell + 0.5) * raster.cell_m()); };
  const Window window = about_canopy(raster);
  Cells cells;
  for (int a = window.a0; a < window.a1; ++a) {
    const std::size_t before = cells.all.size();
    for (int b = window.b0; b < window.b1; ++b) {
      if (raster.seen_cells(a, a + 1, b, b + 1) == 0) continue;
      const auto cover = static_cast<float>(raster.cover(a, a + 1, b, b + 1));
      cells.all.push_back({middle(a), middle(b), cover});
    }
    if (cells.all.size() == before) continue;
    cells.row_ends.push_back(cells.all[before]);
    cells.row_ends.push_back(cells.all.back());
  }
  return cells;
}

// The cells in bins across lines of one direction.
class LineFamily {
 public:
  LineFamily(const Cells& cells, double angle_rad, double bin_m)
      : c_(static_cast<float>(std::cos(angle_rad))), s_(static_cast<float>(std::sin(angle_rad))) {
    float low_along = 1e30F, high_along = -1e30F, low_across = 1e30F, high_across = -1e30F;
    for (const Cell& cell : cells.row_ends) {
      low_along = std::min(low_along, along(cell));
      high_along = std::max(high_along, along(cell));
      low_across = std::min(low_across, across(cell));
      high_across = std::max(high_across, across(cell));
    }
    const auto per_bin = static_cast<float>(1 / bin_m);
    least_cells_ = 0.25F * (high_along - low_along) * per_bin;
    bins_ = static_cast<std::size_t>((high_across - low_across) * per_bin) + 3;
    sums_.assign(2 * bins_, 0);
    for (const Cell& cell : cells.all) add(cell, (across(cell) - low_across) * per_bin);
  }

  // Sum of the squared steps of mean cover from line to line. Two bins on either side: single ones
  // would be sharper where lines run along the cells. Bins of a quarter of a line's cells or fewer
  // tell nothing.
  double sharpness() const {
    double total = 0;
    for (std::size_t bin = 3; bin < bins_; ++bin) {
      const float* at = &sums_[2 * (bin - 3)];
      const double low = at[1] + at[3], high = at[5] + at[7];
      if (std::min(low, high) < 2 * least_cells_) continue;
      const double step = (at[4] + at[6]) / high - (at[0] + at[2]) / low;
      total += std::min(low, high) * step * step;
    }
    return total;
  }

 private:
  float along(const Cell& cell) const { return c_ * cell.x + s_ * cell.y; }
  float across(const Cell& cell) const { return c_ * cell.y - s_ * cell.x; }
  // Cloud in cell.
  void add(const Cell& cell, float bin_across) {
    const auto bin = static_cast<std::size_t>(bin_across);
    const float share = bin_across - static_cast<float>(bin);
    float* at = &sums_[2 * bin];
    at[0] += (1 - share) * cell.cover;
    at[1] += 1 - share;
    at[2] += share * cell.cover;
    at[3] += share;
  }

  float c_, s_, least_cells_ = 0;
  std::size_t bins_ = 0;
  std::vector<float> sums_;  // cover and cells, by bin
};

// Sharpness of the lines in each direction.
std::vector<double> sharpnesses(const Cells& cells, const std::vector<double>& angles, double bin_m,
                                int threads) {
  std::vector<double> values(angles.size());
  tbb::task_arena arena(threads);
  arena.execute([&] {
    tbb::parallel_for(std::size_t{0}, angles.size(), [&](std::size_t i) {
      values[i] = LineFamily(cells, angles[i], bin_m).sharpness();
    });
  });
  return values;
}

// The sharpest direction within reach_rad of a guess, tried in steps, and the parabola's top.
double refined(const Cells& cells, double guess_rad, double reach_rad, double step_rad,
               double bin_m, int threads) {
  std::vector<double> angles;
  const int steps = static_cast<int>(std::lround(reach_rad / step_rad));
  for (int i = -steps; i <= steps; ++i) angles.push_back(guess_rad + i * step_rad);
  const std::vector<double> values = sharpnesses(cells, angles, bin_m, threads);
  const auto best = static_cast<std::size_t>(std::ranges::max_element(values) - values.begin());
  if (best == 0 || best + 1 == values.size()) return angles[best];
  return angles[best] + parabola_top(values[best - 1], values[best], values[best + 1]) * step_rad;
}

// Directions of two families of lines, whole degrees.
struct Pair {
  int first = 0, second = 90;
  double worth = 0;  // product of their sharpnesses: a field has both families
};

// Whether neither has a family of the other.
bool are_apart(const Pair& a, const Pair& b) {
  const auto apart = [](int one, int other) {
    return std::abs(std::remainder(one - other, kAngles)) > kApart_deg;
  };
  return apart(a.first, b.first) && apart(a.first, b.second) && apart(a.second, b.first) &&
         apart(a.second, b.second);
}

// The best perpendicular pair of those that may be; a skewed pair only where it is far better,
// since rows with different offsets look skewed too.
template <typename MayBe>
Pair best_pair(const std::vector<double>& values, const MayBe& may_be) {
  Pair best;
  for (int first = 0; first < kAngles; ++first) {
    for (int skew = -kMostSkew_deg; skew <= kMostSkew_deg; ++skew) {
      const int second = first + 90 + skew;
      if (!may_be(Pair{first, second})) continue;
      const double doubt = std::abs(skew) <= 1 ? 1 : kSkewDoubt;
      const double worth = doubt * values[static_cast<std::size_t>(first)] *
                           values[static_cast<std::size_t>(second % kAngles)];
      if (worth > best.worth) best = {first, second, worth};
    }
  }
  return best;
}

// The best pair, and the next where it is hardly worse: a few straight things beside the plots,
// such as a hedge and a windrow, may be sharper than these. With a hint only the best near it.
std::vector<Pair> best_pairs(const std::vector<double>& values,
                             const std::optional<double>& hint_rad) {
  const Pair best = best_pair(values, [&](const Pair& pair) {
    return !hint_rad ||
           std::abs(std::remainder(pair.first * kDegrees - *hint_rad, kPi)) <= kHintReach_rad;
  });
  if (hint_rad) return {best};
  const Pair next = best_pair(values, [&](const Pair& pair) { return are_apart(pair, best); });
  return next.worth > kLeastOfBest * best.worth ? std::vector{best, next} : std::vector{best};
}

std::vector<FieldAxes> axes_of(const Pair& pair, const Cells& cells, double bin_m, int threads) {
  const auto fine = [&](double guess_rad) {
    const double closer = refined(cells, guess_rad, 2 * kDegrees, 0.2 * kDegrees, bin_m, threads);
    return refined(cells, closer, 0.3 * kDegrees, 0.05 * kDegrees, bin_m, threads);
  };
  FieldAxes axes{fine(pair.first * kDegrees), fine(pair.second * kDegrees)};
  if (std::abs(pair.second - pair.first - 90) > 1) return {axes};
  // A perpendicular pair from each family alone: offsets of rows can tilt the lines of one family.
  const FieldAxes of_first{axes.first_rad, axes.first_rad + kPi / 2};
  const FieldAxes of_second{axes.second_rad - kPi / 2, axes.second_rad};
  if (std::abs(of_second.first_rad - of_first.first_rad) > kTilt_rad) return {of_first, of_second};
  const double sharp_first = LineFamily(cells, axes.first_rad, bin_m).sharpness();
  const double sharp_second = LineFamily(cells, axes.second_rad, bin_m).sharpness();
  return {sharp_first >= sharp_second ? of_first : of_second};
}

}  // namespace

std::vector<FieldAxes> find_axes(const CanopyRaster& raster, std::optional<double> hint_rad,
                                 int threads) {
  const Cells cells = cells_of(raster);
  if (cells.all.empty()) return {};
  const double bin_m = raster.cell_m();
  std::vector<double> angles;
  angles.reserve(kAngles);
  for (int i = 0; i < kAngles; ++i) angles.push_back(i * kDegrees);
  const std::vector<double> values = sharpnesses(cells, angles, bin_m, threads);
  std::vector<FieldAxes> found;
  for (const Pair& pair : best_pairs(values, hint_rad))
    for (const FieldAxes& axes : axes_of(pair, cells, bin_m, threads)) found.push_back(axes);
  return found;
}

}  // namespace plotscan::plots
