// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "plots/signs/internal/plot_shape.h"

namespace plotscan::plots {
namespace {

constexpr double kStandardErrors = 3;
constexpr int kInset = 8;  // of a plot's side, on either end: leaves are fewer there

// Cover of two neighbours and of the gap between them.
struct PlotPair {
  double plots = 0, gap = 0;
};

// Of plots whose boxes are `a` and, farther along c, `b`: where both are opposite each other. Where
// they overlap there is no gap, but canopy alone.
std::optional<PlotPair> pair_of(const RowView& view, const CellBox& a, const CellBox& b) {
  const int inset = (a.r1 - a.r0) / kInset;
  const int r0 = std::max(a.r0, b.r0) + inset, r1 = std::min(a.r1, b.r1) - inset;
  if (r1 <= r0 || b.c0 == a.c1) return std::nullopt;
  const double plots = (view.cover(r0, r1, a.c0, a.c1) + view.cover(r0, r1, b.c0, b.c1)) / 2;
  return PlotPair{.plots = plots, .gap = b.c0 > a.c1 ? view.cover(r0, r1, a.c1, b.c0) : plots};
}

// From each plot to the next in its row.
std::vector<PlotPair> pairs_in_rows(const Lattice& lattice) {
  std::map<std::pair<int, int>, CellBox> boxes;
  for (const Place& place : lattice.places)
    boxes[{place.row, place.column}] = cells_about(lattice, place, 0);
  std::vector<PlotPair> pairs;
  for (const auto& [at, box] : boxes) {
    const auto next = boxes.find({at.first, at.second + 1});
    if (next == boxes.end()) continue;
    if (const auto pair = pair_of(lattice.view, box, next->second)) pairs.push_back(*pair);
  }
  return pairs;
}

// The ratio of the sums with its standard error (Cochran, Sampling Techniques, 3rd ed. 1977, ch. 6:
// ratio estimators). Where gaps are empty it does not matter how different plots are.
double gap_cover_of(const std::vector<PlotPair>& pairs) {
  double plots = 0, gaps = 0;
  for (const PlotPair& pair : pairs) {
    plots += pair.plots;
    gaps += pair.gap;
  }
  if (plots <= 0) return 0;
  const double ratio = gaps / plots;
  double squares = 0;
  for (const PlotPair& pair : pairs) squares += std::pow(pair.gap - ratio * pair.plots, 2);
  const auto count = static_cast<double>(pairs.size());
  const double error = std::sqrt(squares * count / std::max(1.0, count - 1)) / plots;
  return ratio + kStandardErrors * error;
}

}  // namespace

double gap_cover(const Lattice& lattice) {
  return std::max(gap_cover_of(pairs_in_rows(lattice)),
                  gap_cover_of(pairs_in_rows(lattice.turned())));
}

}  // namespace plotscan::plots
