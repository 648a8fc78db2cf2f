// SPDX-License-Identifier: Apache-2.0
#include "plots/layout.h"

#include <algorithm>
#include <cmath>

namespace plotscan::plots {
namespace {

constexpr double kLeastSide_m = 0.35, kMostSide_m = 25;
constexpr double kReach_m = 0.2;       // of the strips on either side of an edge
constexpr double kPenaltyShare = 0.15;  // of the strongest edge: less is no band
constexpr std::size_t kRowSizes = 4;   // sizes across the rows that are tried along them

int cells(double length_m, double cell_m) {
  return std::max(1, static_cast<int>(std::lround(length_m / cell_m)));
}

struct SizeScore {
  int size = 0;
  double score = 0;
};

// Local maxima of a score over sizes, the best ones first.
std::vector<SizeScore> peaks(const std::vector<SizeScore>& scores) {
  std::vector<SizeScore> found;
  for (std::size_t i = 0; i < scores.size(); ++i) {
    const double left = i > 0 ? scores[i - 1].score : 0;
    const double right = i + 1 < scores.size() ? scores[i + 1].score : 0;
    if (scores[i].score > 0 && scores[i].score >= left && scores[i].score > right) {
      found.push_back(scores[i]);
    }
  }
  std::ranges::stable_sort(found, [](const auto& a, const auto& b) { return a.score > b.score; });
  return found;
}

std::vector<double> profile_over_rows(const RowView& view) {
  std::vector<double> profile;
  for (int r = 0; r < view.r_cells(); ++r) profile.push_back(view.cover(r, r + 1, 0, view.c_cells()));
  return profile;
}

std::vector<double> profile_in_row(const RowView& view, const Band& band) {
  const int inset = (band.end - band.begin) / 8;
  std::vector<double> profile;
  for (int c = 0; c < view.c_cells(); ++c) {
    profile.push_back(view.cover(band.begin + inset, band.end - inset, c, c + 1));
  }
  return profile;
}

BandSearch search_for(double strongest, double cell_m) {
  return {.tolerance = 1, .least_gap = cells(0.15, cell_m), .penalty = kPenaltyShare * strongest};
}

double strongest(const std::vector<double>& steps) {
  double most = 0;
  for (const double step : steps) most = std::max(most, std::abs(step));
  return most;
}

std::vector<int> sizes(int most_cells, double cell_m) {
  std::vector<int> list;
  const int last = std::min(most_cells, cells(kMostSide_m, cell_m));
  for (int size = cells(kLeastSide_m, cell_m); size <= last; ++size) list.push_back(size);
  return list;
}

// Plots along every one of these rows, of the size that explains most.
Layout with_plots(const RowView& view, int r_size, const std::vector<Band>& bands) {
  const int reach = cells(kReach_m, view.cell_m());
  std::vector<std::vector<double>> steps;
  double most = 0;
  for (const Band& band : bands) {
    steps.push_back(steps_of(profile_in_row(view, band), reach));
    most = std::max(most, strongest(steps.back()));
  }
  const BandSearch search = search_for(most, view.cell_m());
  Layout best{.view = view, .r_size = r_size};
  for (const int size : sizes(view.c_cells(), view.cell_m())) {
    double score = 0;
    for (const auto& row : steps) score += best_bands(row, size, search).score;
    if (score <= best.score) continue;
    best.score = score;
    best.c_size = size;
  }
  if (best.c_size == 0) return best;
  best.score = 0;
  const double perimeter_m = 2 * (r_size + best.c_size) * view.cell_m();
  for (std::size_t i = 0; i < bands.size(); ++i) {
    Row row{bands[i], best_bands(steps[i], best.c_size, search).bands};
    for (const Band& plot : row.plots) {
      const SideContrast contrast = side_contrast(view, row.band.begin, row.band.end, plot.begin,
                                                  plot.end, reach);
      // A box without an edge on one side is not a plot.
      const double whole = std::clamp(contrast.weakest / (0.3 * contrast.mean), 0.0, 1.0);
      best.score += perimeter_m * std::max(0.0, contrast.mean) * whole;
    }
    if (!row.plots.empty()) best.rows.push_back(std::move(row));
  }
  return best;
}

Layout best_layout_of(const RowView& view) {
  const std::vector<double> steps = steps_of(profile_over_rows(view), cells(kReach_m, view.cell_m()));
  const BandSearch search = search_for(strongest(steps), view.cell_m());
  std::vector<SizeScore> scores;
  for (const int size : sizes(view.r_cells(), view.cell_m())) {
    scores.push_back({size, best_bands(steps, size, search).score});
  }
  std::vector<SizeScore> best_sizes = peaks(scores);
  best_sizes.resize(std::min(best_sizes.size(), kRowSizes));
  Layout best{.view = view};
  for (const SizeScore& tried : best_sizes) {
    Layout layout = with_plots(view, tried.size, best_bands(steps, tried.size, search).bands);
    if (layout.score > best.score) best = std::move(layout);
  }
  return best;
}

}  // namespace

SideContrast side_contrast(const RowView& view, int r0, int r1, int c0, int c1, int reach) {
  const int r_inset = (r1 - r0) / 8, c_inset = (c1 - c0) / 8;
  const int ra = r0 + r_inset, rb = r1 - r_inset, ca = c0 + c_inset, cb = c1 - c_inset;
  const double sides[] = {
      view.cover(r0, r0 + reach, ca, cb) - view.cover(r0 - reach, r0, ca, cb),
      view.cover(r1 - reach, r1, ca, cb) - view.cover(r1, r1 + reach, ca, cb),
      view.cover(ra, rb, c0, c0 + reach) - view.cover(ra, rb, c0 - reach, c0),
      view.cover(ra, rb, c1 - reach, c1) - view.cover(ra, rb, c1, c1 + reach)};
  SideContrast contrast{.weakest = sides[0]};
  for (const double side : sides) {
    contrast.weakest = std::min(contrast.weakest, side);
    contrast.mean += side / 4;
  }
  return contrast;
}

Layout best_layout(const CanopyRaster& raster) {
  Layout along_a = best_layout_of({.raster = &raster, .swapped = false});
  Layout along_b = best_layout_of({.raster = &raster, .swapped = true});
  return along_b.score > along_a.score ? along_b : along_a;
}

}  // namespace plotscan::plots
