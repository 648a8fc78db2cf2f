// SPDX-License-Identifier: Apache-2.0
#include "heights/internal/semivariogram.h"

#include <algorithm>

#include "core/csv.h"
#include "core/statistics.h"
#include "heights/internal/box_cells.h"

namespace plotscan::heights {
namespace {

constexpr double kFarLag_m = 0.32;
constexpr double kNearer = 0.7, kFarther = 1.4;  // of a lag: the pairs that count for it
constexpr double kMost = 1.5;
// Fewer pairs say nothing.
constexpr std::size_t kLeastPairs = 30;
// For each lag this many returns are compared, or this many in each cell where that is more.
constexpr double kCompared = 1500, kComparedOfCell = 2;

struct Pairs {
  double squares_m2 = 0;
  std::size_t count = 0;

  // NaN of too few.
  double semivariance(double noise_m) const {
    return count < kLeastPairs ? kNaN
                               : squares_m2 / (2 * static_cast<double>(count)) - noise_m * noise_m;
  }
};
using PairsAbove = std::array<Pairs, kPairsAbove.size()>;

// Coordinates of returns, each in an array of its own, as vector instructions take them.
struct Places {
  std::span<const float> x, y, z;

  std::size_t size() const { return z.size(); }
  Places from(std::size_t begin) const {
    return {x.subspan(begin), y.subspan(begin), z.subspan(begin)};
  }
};

// Returns, cell by cell.
struct InCells {
  std::vector<std::size_t> first;  // of each cell, and of the one after the last
  std::vector<float> x, y, z;

  Places of(std::size_t cell) const {
    const std::size_t count = first[cell + 1] - first[cell];
    return {{&x[first[cell]], count}, {&y[first[cell]], count}, {&z[first[cell]], count}};
  }
};

InCells in_cells(const BoxCells& cells, std::span<const Eigen::Vector3f> returns) {
  const std::size_t count = returns.size();
  std::vector<std::size_t> cell_of(count);
  InCells sorted{.first = std::vector<std::size_t>(cells.count() + 1, 0),
                 .x = std::vector<float>(count + 1),  // empty cells at the end have an address too
                 .y = std::vector<float>(count + 1),
                 .z = std::vector<float>(count + 1)};
  for (std::size_t k = 0; k < count; ++k) {
    cell_of[k] = cells.index(returns[k]);
    ++sorted.first[cell_of[k] + 1];
  }
  for (std::size_t cell = 0; cell < cells.count(); ++cell)
    sorted.first[cell + 1] += sorted.first[cell];
  std::vector<std::size_t> next(sorted.first);
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t at = next[cell_of[k]]++;
    sorted.x[at] = returns[k].x();
    sorted.y[at] = returns[k].y();
    sorted.z[at] = returns[k].z();
  }
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

// Pairs of returns that lie a lag apart.
class LagPairs {
 public:
  LagPairs(double lag_m, double top_m)
      : nearest_m2_(kNearer * kNearer * lag_m * lag_m),
        farthest_m2_(kFarther * kFarther * lag_m * lag_m),
        top_m_(top_m) {}

  // Adds the pairs of a return with others. First those that lie a lag away are picked, without
  // branches.
  void add(const Places& one, std::size_t k, const Places& others) {
    distance_m2_.resize(std::max(distance_m2_.size(), others.size()));
    picked_.resize(distance_m2_.size());
    const float x = one.x[k], y = one.y[k], z = one.z[k];
    for (std::size_t i = 0; i < others.size(); ++i)
      distance_m2_[i] =
          (x - others.x[i]) * (x - others.x[i]) + (y - others.y[i]) * (y - others.y[i]);
    std::size_t count = 0;
    for (std::size_t i = 0; i < others.size(); ++i) {
      picked_[count] = others.z[i];
      count += static_cast<std::size_t>(distance_m2_[i] >= nearest_m2_) &
               static_cast<std::size_t>(distance_m2_[i] <= farthest_m2_);
    }
    for (const float other_z : std::span(picked_).first(count)) {
      const double difference_m = z - other_z;
      const double lower_m = std::min(z, other_z);
      for (std::size_t i = 0; i < pairs_.size(); ++i) {
        if (lower_m < kPairsAbove[i] * top_m_) break;
        pairs_[i].squares_m2 += difference_m * difference_m;
        ++pairs_[i].count;
      }
    }
  }

  const PairsAbove& above() const { return pairs_; }

 private:
  double nearest_m2_, farthest_m2_, top_m_;
  PairsAbove pairs_;
  std::vector<float> distance_m2_;
  std::vector<float> picked_;  // heights
};

PairsAbove pairs_apart(const PlotBox& box, std::span<const Eigen::Vector3f> descending,
                       double lag_m, double top_m) {
  const BoxCells cells(box, kFarther * lag_m);
  const double most = std::max(kCompared, kComparedOfCell * static_cast<double>(cells.count()));
  const InCells compared =
      in_cells(cells, thinned(descending, most / static_cast<double>(descending.size())));
  LagPairs pairs(lag_m, top_m);
  for (std::size_t cell = 0; cell < cells.count(); ++cell) {
    const Places own = compared.of(cell);
    for (std::size_t k = 0; k < own.size(); ++k) pairs.add(own, k, own.from(k + 1));
    for (const std::size_t near : cells.around(cell)) {
      if (near <= cell) continue;
      for (std::size_t k = 0; k < own.size(); ++k) pairs.add(own, k, compared.of(near));
    }
  }
  return pairs.above();
}

// Semivariance of one lag over that of the far lag; `longer` where either is unknown.
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
