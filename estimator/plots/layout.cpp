// SPDX-License-Identifier: Apache-2.0
#include "plots/layout.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "plots/statistics.h"

namespace plotscan::plots {
namespace {

constexpr double kLeastSide_m = 0.35, kMostSide_m = 25;
constexpr double kReach_m = 0.2;        // of the strips on either side of an edge
constexpr double kPenaltyShare = 0.15;  // of the strongest edge: less is no band
constexpr double kPiece_m = 0.3;        // of an edge, judged by itself
constexpr double kCanopyBlock_m = 0.6;  // whose mean cover evens out gaps between plants
constexpr double kLeastCover = 0.35;    // of the usual plot's: less is a missing one
constexpr std::size_t kSizes = 4;       // sizes along each axis that are tried with each other

int cells(double length_m, double cell_m) {
  return std::max(1, static_cast<int>(std::lround(length_m / cell_m)));
}

struct SizeScore {
  int size = 0;
  double score = 0;
};

// Local maxima of a score over sizes, the best ones first.
std::vector<SizeScore> best_peaks(const std::vector<SizeScore>& scores) {
  std::vector<SizeScore> found;
  for (std::size_t i = 0; i < scores.size(); ++i) {
    const double left = i > 0 ? scores[i - 1].score : 0;
    const double right = i + 1 < scores.size() ? scores[i + 1].score : 0;
    if (scores[i].score > 0 && scores[i].score >= left && scores[i].score > right) {
      found.push_back(scores[i]);
    }
  }
  std::ranges::stable_sort(found, [](const auto& a, const auto& b) { return a.score > b.score; });
  found.resize(std::min(found.size(), kSizes));
  return found;
}

std::vector<double> profile_over_rows(const RowView& view) {
  std::vector<double> profile;
  double most = 0;
  for (int r = 0; r < view.r_cells(); ++r) {
    most = std::max(most, view.seen_cells(r, r + 1, 0, view.c_cells()));
  }
  for (int r = 0; r < view.r_cells(); ++r) {
    // A few cells at the survey's edge, seen by a few returns, are no evidence.
    const double seen = view.seen_cells(r, r + 1, 0, view.c_cells());
    profile.push_back(view.cover(r, r + 1, 0, view.c_cells()) * std::min(1.0, 4 * seen / most));
  }
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
  return {.least_gap = cells(0.15, cell_m), .penalty = kPenaltyShare * strongest};
}

// Edges of single plots are rough: a band may be a little wider or narrower than all.
Bands bands_of(const std::vector<double>& steps, int size, BandSearch search) {
  search.tolerance = std::max(1, size / 30);
  return best_bands(steps, size, search);
}

int median_size(const std::vector<Band>& bands) {
  std::vector<double> widths;
  for (const Band& band : bands) widths.push_back(band.end - band.begin);
  return static_cast<int>(median(widths));
}

double strongest(const std::vector<double>& steps) {
  double most = 0;
  for (const double step : steps) most = std::max(most, std::abs(step));
  return most;
}

bool agrees(const Layout& layout, const KnownSides& known) {
  const double r_m = layout.r_size * layout.view.cell_m();
  const double c_m = layout.c_size * layout.view.cell_m();
  if (known.width_m && known.length_m) {
    return (is_side(r_m, known.width_m) && is_side(c_m, known.length_m)) ||
           (is_side(c_m, known.width_m) && is_side(r_m, known.length_m));
  }
  const std::optional<double>& one = known.width_m ? known.width_m : known.length_m;
  return !one || is_side(r_m, one) || is_side(c_m, one);
}

std::vector<int> sizes(int most_cells, double cell_m, const KnownSides& known) {
  const bool both = known.width_m && known.length_m;
  std::vector<int> list;
  const int last = std::min(most_cells, cells(kMostSide_m, cell_m));
  for (int size = cells(kLeastSide_m, cell_m); size <= last; size += std::max(1, size / 60)) {
    const double side_m = size * cell_m;
    if (!both || is_side(side_m, known.width_m) || is_side(side_m, known.length_m))
      list.push_back(size);
  }
  return list;
}

// Share of the neighbours' steps that are a whole number of the usual step.
double regularity(const Layout& layout) {
  std::vector<double> steps;
  for (const Row& row : layout.rows) {
    for (std::size_t i = 1; i < row.plots.size(); ++i) {
      steps.push_back(
          (row.plots[i].begin + row.plots[i].end - row.plots[i - 1].begin - row.plots[i - 1].end) *
          layout.view.cell_m() / 2);
    }
  }
  if (steps.size() < 2) return 1;
  const double usual_m = usual_step(steps);
  const auto regular = std::ranges::count_if(steps, [&](double step) {
    const double off_m = std::abs(step - usual_m * std::max(1.0, std::round(step / usual_m)));
    return off_m < std::clamp(0.08 * usual_m, 0.06, 0.15);
  });
  return static_cast<double>(regular) / static_cast<double>(steps.size());
}

double regular_share(const Layout& layout) {
  return std::clamp((regularity(layout) - 0.3) / 0.5, 0.0, 1.0);
}

// An edge is an edge: one between canopies that touch counts hardly less than one to bare ground.
// What the best of many places shows by chance counts nothing, and a step inwards against it.
double edge_value(double contrast) {
  constexpr double kChance = 0.08, kClear = 0.35;
  return std::clamp((contrast - kChance) / (kClear - kChance), -1.0, 1.0);
}

// Cover of canopy: mean of the cells' cover, weighted with itself.
double full_cover(const RowView& view) {
  double cover = 0;
  double square = 0;
  const int block = cells(kCanopyBlock_m, view.cell_m());
  for (int r = 0; r + block <= view.r_cells(); r += block) {
    for (int c = 0; c + block <= view.c_cells(); c += block) {
      const double seen = view.seen_cells(r, r + block, c, c + block);
      const double here = view.cover(r, r + block, c, c + block);
      cover += seen * here;
      square += seen * here * here;
    }
  }
  return cover > 0 ? square / cover : 0;
}

// Cells of canopy that the plots hold beyond bare ones: an alley in a plot, or canopy in an alley,
// counts against a layout.
double held_canopy(const Layout& layout, double full) {
  double held = 0;
  for (const Row& row : layout.rows) {
    for (const Band& plot : row.plots) {
      const int r0 = row.band.begin;
      const int r1 = row.band.end;
      held += (layout.view.cover(r0, r1, plot.begin, plot.end) - full / 2) *
              layout.view.seen_cells(r0, r1, plot.begin, plot.end);
    }
  }
  return std::max(0.0, held);
}

// Scores the layouts beside each other.
void weigh_with_canopy(std::vector<Layout>& layouts) {
  if (layouts.empty()) return;
  const double full = full_cover(layouts.front().view);
  std::vector<double> held;
  for (const Layout& layout : layouts) held.push_back(held_canopy(layout, full));
  const double most = std::max(1e-9, *std::ranges::max_element(held));
  for (std::size_t i = 0; i < layouts.size(); ++i) {
    layouts[i].score *= (held[i] / most) * (held[i] / most);
  }
}

// Cells of edges that a box explains, in pieces: one across a gap in the canopy shows none there.
double edges_of(const RowView& view, const Band& r, const Band& c, double full) {
  const int reach = cells(kReach_m, view.cell_m()), piece = cells(kPiece_m, view.cell_m());
  double explained = 0;
  for (int from = c.begin; from < c.end; from += piece) {
    const int to = std::min(c.end, from + piece);
    const auto cover = [&](int low) { return view.cover(low, low + reach, from, to); };
    explained += (to - from) * edge_value((cover(r.begin) - cover(r.begin - reach)) / full);
    explained += (to - from) * edge_value((cover(r.end - reach) - cover(r.end)) / full);
  }
  for (int from = r.begin; from < r.end; from += piece) {
    const int to = std::min(r.end, from + piece);
    const auto cover = [&](int low) { return view.cover(from, to, low, low + reach); };
    explained += (to - from) * edge_value((cover(c.begin) - cover(c.begin - reach)) / full);
    explained += (to - from) * edge_value((cover(c.end - reach) - cover(c.end)) / full);
  }
  return explained;
}

// Metres of edges that a layout explains. Bands that the texture of a canopy suggests do not lie at
// equal steps.
double score_of(const Layout& layout) {
  std::vector<double> covers;
  for (const Row& row : layout.rows) {
    for (const Band& plot : row.plots) {
      covers.push_back(layout.view.cover(row.band.begin, row.band.end, plot.begin, plot.end));
    }
  }
  const double full = std::max(1e-6, median(covers));
  double score = 0;
  for (const Row& row : layout.rows) {
    for (const Band& plot : row.plots) {
      score += edges_of(layout.view, row.band, plot, full);
    }
  }
  return score * layout.view.cell_m() * regular_share(layout);
}

// Contrast of the plots' sides as a share of their cover, of the weaker pair of sides: means over
// all plots, in which the gaps between plants even out.
void measure_clarity(Layout& layout) {
  const int reach = cells(kReach_m, layout.view.cell_m());
  double across_r = 0;
  double across_c = 0;
  double plots = 0;
  for (const Row& row : layout.rows) {
    for (const Band& plot : row.plots) {
      const SideContrast side =
          side_contrast(layout.view, row.band.begin, row.band.end, plot.begin, plot.end, reach);
      across_r += (side.across_r[0] + side.across_r[1]) / 2;
      across_c += (side.across_c[0] + side.across_c[1]) / 2;
      layout.cover += layout.view.cover(row.band.begin, row.band.end, plot.begin, plot.end);
      ++plots;
    }
  }
  layout.clarity =
      std::min(across_r, across_c) / std::max(1e-9, layout.cover) * regular_share(layout);
  layout.cover /= plots;
}

void add(std::vector<Layout>& layouts, Layout layout, const KnownSides& known) {
  std::vector<Band> rows, plots;
  for (const Row& row : layout.rows) {
    rows.push_back(row.band);
    plots.insert(plots.end(), row.plots.begin(), row.plots.end());
  }
  if (plots.empty()) return;
  layout.r_size = median_size(rows);
  layout.c_size = median_size(plots);
  if (!agrees(layout, known)) return;
  layout.score = score_of(layout);
  measure_clarity(layout);
  layout.quality = layout.score / (2 * (layout.r_size + layout.c_size) * layout.view.cell_m() *
                                   static_cast<double>(plots.size()));
  layouts.push_back(std::move(layout));
}

// Layouts with plots of the best sizes along these rows, every row by itself: rows may start at
// different offsets.
void add_with_plots(std::vector<Layout>& layouts, const RowView& view,
                    const std::vector<Band>& bands, const KnownSides& known) {
  std::vector<std::vector<double>> steps;
  double most = 0;
  for (const Band& band : bands) {
    steps.push_back(steps_of(profile_in_row(view, band), cells(kReach_m, view.cell_m())));
    most = std::max(most, strongest(steps.back()));
  }
  const BandSearch search = search_for(most, view.cell_m());
  std::vector<SizeScore> scores;
  for (const int size : sizes(view.c_cells(), view.cell_m(), known)) {
    double score = 0;
    for (const auto& row : steps) score += bands_of(row, size, search).score;
    scores.push_back({size, score});
  }
  for (const SizeScore& tried : best_peaks(scores)) {
    Layout layout{.view = view};
    for (std::size_t i = 0; i < bands.size(); ++i) {
      Row row{bands[i], bands_of(steps[i], tried.size, search).bands};
      if (!row.plots.empty()) layout.rows.push_back(std::move(row));
    }
    add(layouts, std::move(layout), known);
  }
}

// The same with columns that run through all rows, which shows weaker edges than one row does.
void add_with_columns(std::vector<Layout>& layouts, const RowView& view,
                      const std::vector<Band>& bands, const KnownSides& known) {
  std::vector<double> profile(static_cast<std::size_t>(view.c_cells()));
  for (const Band& band : bands) {
    const std::vector<double> row = profile_in_row(view, band);
    for (std::size_t i = 0; i < profile.size(); ++i) profile[i] += row[i];
  }
  const std::vector<double> steps = steps_of(profile, cells(kReach_m, view.cell_m()));
  const BandSearch search = search_for(strongest(steps), view.cell_m());
  std::vector<SizeScore> scores;
  for (const int size : sizes(view.c_cells(), view.cell_m(), known)) {
    scores.push_back({size, bands_of(steps, size, search).score});
  }
  for (const SizeScore& tried : best_peaks(scores)) {
    const std::vector<Band> columns = bands_of(steps, tried.size, search).bands;
    std::vector<double> covers;
    for (const Band& row : bands) {
      for (const Band& column : columns) {
        covers.push_back(view.cover(row.begin, row.end, column.begin, column.end));
      }
    }
    const double least = kLeastCover * median(covers);
    Layout layout{.view = view};
    for (const Band& band : bands) {
      Row row{.band = band};
      for (const Band& column : columns) {
        if (view.cover(band.begin, band.end, column.begin, column.end) < least) continue;
        row.plots.push_back(column);
      }
      if (!row.plots.empty()) layout.rows.push_back(std::move(row));
    }
    add(layouts, std::move(layout), known);
  }
}

std::vector<Layout> layouts_of(const RowView& view, const KnownSides& known) {
  const std::vector<double> steps =
      steps_of(profile_over_rows(view), cells(kReach_m, view.cell_m()));
  const BandSearch search = search_for(strongest(steps), view.cell_m());
  std::vector<SizeScore> scores;
  for (const int size : sizes(view.r_cells(), view.cell_m(), known)) {
    scores.push_back({size, bands_of(steps, size, search).score});
  }
  std::vector<Layout> layouts;
  for (const SizeScore& tried : best_peaks(scores)) {
    const std::vector<Band> rows = bands_of(steps, tried.size, search).bands;
    add_with_plots(layouts, view, rows, known);
    add_with_columns(layouts, view, rows, known);
  }
  return layouts;
}

}  // namespace

bool is_side(double side_m, const std::optional<double>& known_m) {
  return known_m && std::abs(side_m - *known_m) <= 0.15 + 0.05 * *known_m;
}

double SideContrast::mean() const {
  return (across_r[0] + across_r[1] + across_c[0] + across_c[1]) / 4;
}

SideContrast side_contrast(const RowView& view, int r0, int r1, int c0, int c1, int reach) {
  const int r_inset = (r1 - r0) / 8, c_inset = (c1 - c0) / 8;
  const int ra = r0 + r_inset, rb = r1 - r_inset, ca = c0 + c_inset, cb = c1 - c_inset;
  return {.across_r = {view.cover(r0, r0 + reach, ca, cb) - view.cover(r0 - reach, r0, ca, cb),
                       view.cover(r1 - reach, r1, ca, cb) - view.cover(r1, r1 + reach, ca, cb)},
          .across_c = {view.cover(ra, rb, c0, c0 + reach) - view.cover(ra, rb, c0 - reach, c0),
                       view.cover(ra, rb, c1 - reach, c1) - view.cover(ra, rb, c1, c1 + reach)}};
}

Layout best_layout(const CanopyRaster& raster, const KnownSides& known) {
  std::vector<Layout> layouts = layouts_of({.raster = &raster, .swapped = false}, known);
  for (Layout& layout : layouts_of({.raster = &raster, .swapped = true}, known)) {
    layouts.push_back(std::move(layout));
  }
  if (layouts.empty()) return {};
  weigh_with_canopy(layouts);
  std::ranges::stable_sort(layouts, std::greater<>{}, &Layout::score);
  return layouts.front();
}

}  // namespace plotscan::plots
