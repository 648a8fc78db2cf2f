// SPDX-License-Identifier: Apache-2.0
#include "heights/internal/semivariogram.h"

#include <algorithm>
#include <cmath>

#include "core/csv.h"
#include "heights/internal/box_cells.h"

namespace plotscan::heights {
namespace {

constexpr double kFarLag_m = 0.32;
constexpr double kNearer = 0.7, kFarther = 1.4;  // of a lag: the pairs that count for it
constexpr double kMost = 1.5;
// Fewer pairs say nothing.
constexpr std::size_t kLeastPairs = 30;
// Of a lag are compared so many returns, or so many a cell where that is more.
constexpr double kCompared = 1500, kComparedOfCell = 2;

struct Pairs {
  double squares_m2 = 0;
  std::size_t count = 0;

  // NaN of too few.
  double semivariance(double noise_m) const {
    return count < kLeastPairs ? NAN
                               : squares_m2 / (2 * static_cast<double>(count)) - noise_m * noise_m;
  }
};
using PairsAbove = std::array<Pairs, kPairsAbove.size()>;

// Returns, cell by cell.
struct InCells {
  std::vector<std::size_t> first;  // of each cell, and of the one after the last
  std::vector<Eigen::Vector3f> returns;

  std::span<const Eigen::Vector3f> of(std::size_t cell) const {
    return std::span(returns).subspan(first[cell], first[cell + 1] - first[cell]);
  }
};

InCells in_cells(const BoxCells& cells, std::span<const Eigen::Vector3f> returns) {
  std::vector<std::size_t> cell_of(returns.size());
  InCells sorted{.first = std::vector<std::size_t>(cells.count() + 1, 0),
                 .returns = std::vector<Eigen::Vector3f>(returns.size())};
  for (std::size_t k = 0; k < returns.size(); ++k) {
    cell_of[k] = cells.index(returns[k]);
    ++sorted.first[cell_of[k] + 1];
  }
  for (std::size_t cell = 0; cell < cells.count(); ++cell)
    sorted.first[cell + 1] += sorted.first[cell];
  std::vector<std::size_t> next(sorted.first);
  for (std::size_t k = 0; k < returns.size(); ++k) sorted.returns[next[cell_of[k]]++] = returns[k];
  return sorted;
}

// A share of the returns, at equal steps of their rank in height: the same in whatever order they
// came.
std::vector<Eigen::Vector3f> thinned(std::span<const Eigen::Vector3f> descending, double share) {
  if (share >= 1) return {descending.begin(), descending.end()};
  std::vector<Eigen::Vector3f> kept;
  for (std::size_t k = 0; k < descending.size(); ++k) {
    const auto rank = static_cast<double>(k);
    if (std::floor((rank + 1) * share) > std::floor(rank * share)) kept.push_back(descending[k]);
  }
  return kept;
}

// Adds the pairs of a return with others that lie a lag away.
void compare(const Eigen::Vector3f& point, std::span<const Eigen::Vector3f> others, double lag_m,
             double top_m, PairsAbove& pairs) {
  const double nearest_m2 = kNearer * kNearer * lag_m * lag_m;
  const double farthest_m2 = kFarther * kFarther * lag_m * lag_m;
  for (const Eigen::Vector3f& other : others) {
    const double distance_m2 = (point.head<2>() - other.head<2>()).squaredNorm();
    if (distance_m2 < nearest_m2 || distance_m2 > farthest_m2) continue;
    const double difference_m = point.z() - other.z();
    const double lower_m = std::min(point.z(), other.z());
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      if (lower_m < kPairsAbove[i] * top_m) break;
      pairs[i].squares_m2 += difference_m * difference_m;
      ++pairs[i].count;
    }
  }
}

PairsAbove pairs_apart(const PlotBox& box, std::span<const Eigen::Vector3f> descending,
                       double lag_m, double top_m) {
  const BoxCells cells(box, kFarther * lag_m);
  const double most = std::max(kCompared, kComparedOfCell * static_cast<double>(cells.count()));
  const InCells compared =
      in_cells(cells, thinned(descending, most / static_cast<double>(descending.size())));
  PairsAbove pairs;
  for (std::size_t cell = 0; cell < cells.count(); ++cell) {
    const auto own = compared.of(cell);
    for (std::size_t k = 0; k < own.size(); ++k)
      compare(own[k], own.subspan(k + 1), lag_m, top_m, pairs);
    for (const std::size_t near : cells.around(cell)) {
      if (near <= cell) continue;
      for (const Eigen::Vector3f& point : own)
        compare(point, compared.of(near), lag_m, top_m, pairs);
    }
  }
  return pairs;
}

// Of one lag over the far one; `longer` where either is unknown.
double semivariance_ratio(const Pairs& pairs, const Pairs& far, double noise_m, double longer) {
  const double value = pairs.semivariance(noise_m) / far.semivariance(noise_m);
  return far.semivariance(noise_m) > 0 && std::isfinite(value) ? std::clamp(value, 0.0, kMost)
                                                               : longer;
}

}  // namespace

std::vector<double> relative_semivariances(const PlotBox& box,
                                           std::span<const Eigen::Vector3f> descending,
                                           double top_m, double noise_m) {
  const PairsAbove far = pairs_apart(box, descending, kFarLag_m, top_m);
  std::vector<double> values(kPairsAbove.size() * kLags_m.size());
  for (std::size_t lag = kLags_m.size(); lag-- > 0;) {
    const PairsAbove pairs = pairs_apart(box, descending, kLags_m[lag], top_m);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const std::size_t at = i * kLags_m.size() + lag;
      const double longer = lag + 1 == kLags_m.size() ? 1 : values[at + 1];
      values[at] = semivariance_ratio(pairs[i], far[i], noise_m, longer);
    }
  }
  return values;
}

std::vector<std::string> semivariance_names() {
  std::vector<std::string> names;
  for (const double above : kPairsAbove) {
    const std::string part = above > 0 ? "_above" + format_number(100 * above) : "";
    for (const double lag_m : kLags_m)
      names.push_back("semivariance" + format_number(100 * lag_m) + part);
  }
  return names;
}

}  // namespace plotscan::heights
