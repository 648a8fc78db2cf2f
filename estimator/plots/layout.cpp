// SPDX-License-Identifier: Apache-2.0
#include "plots/layout.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include <tbb/parallel_for.h>

#include "plots/drill_rows.h"
#include "plots/statistics.h"

namespace plotscan::plots {
namespace {

constexpr double kLeastSide_m = 0.3, kMostSide_m = 25;           // of a plot
constexpr double kLeastSpacing_m = 0.15, kMostSpacing_m = 1.05;  // of drill rows
constexpr int kMostDrillRows = 8;
constexpr double kLeastGap_m = 0.15;        // between plots
constexpr double kLeastPlot_m = 0.3;        // narrower are drill rows
constexpr double kMostIrregular = 0.34;     // of the steps from plot to plot
constexpr double kLeastGapOfSpacing = 0.2;  // and this more than between drill rows
constexpr double kSizeStep = 1.05;          // from one size that is tried to the next
constexpr std::size_t kRefined = 4;         // best shapes of which others like them are tried
constexpr std::size_t kRowsTried = 3;       // in each of which all shapes are tried
constexpr double kLeafClump_m = 0.3;        // cells so near see the same leaves
constexpr double kMostGap_m = 1.5;          // that leaves may close
constexpr double kPiece_m = 1;              // in which a canopy is even
constexpr double kOwnDoubt = 0.05;   // rows with offsets of their own must explain so much more
constexpr double kLeastShare = 0.3;  // of the usual plot's canopy: less is a missing one

// How well bands of one shape explain what is seen along an axis.
struct AxisFit {
  BandShape shape;
  std::vector<std::vector<int>> begins = {};  // by profile; one list where they share it
  double misfit = std::numeric_limits<double>::infinity();
  double parameters = 0;
  bool drilled = false;       // put together from drill rows,
  BandShape seen_shape = {};  // which are these bands
  std::vector<std::vector<int>> seen = {};

  double cost(double price) const { return misfit + price * parameters; }
};

// A line's profiles, and what a parameter is to gain: Schwarz's criterion.
struct Line {
  double cell_m = 0;
  KnownSides known = {};
  std::vector<ProfileSums> profiles = {};
  double price = 0;
  double independent = 0;
};

Line line_of(const RowView& view, const std::vector<std::vector<Band>>& strips,
             const KnownSides& known) {
  Line line{.cell_m = view.cell_m(), .known = known};
  for (const std::vector<Band>& across : strips) {
    const CanopyProfile profile = profile_along_r(view, across);
    line.profiles.emplace_back(profile);
    line.independent += profile.independent;
  }
  line.price = std::log(std::max(2.0, line.independent));
  return line;
}

int cells(double length_m, double cell_m) {
  return std::max(1, static_cast<int>(std::lround(length_m / cell_m)));
}

// Steps that are no whole number of the usual one: each is a parameter, and so is its place.
double irregular_steps(const std::vector<int>& begins, const BandShape& shape, double cell_m) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < begins.size(); ++i) steps.push_back(begins[i] - begins[i - 1]);
  if (steps.size() < 2) return 0;
  const double usual = usual_step(steps);
  const double tolerance = std::max(0.05 / cell_m + 1, 0.05 * shape.size);
  return static_cast<double>(std::ranges::count_if(steps, [&](double step) {
    return std::abs(step - usual * std::max(1.0, std::round(step / usual))) > tolerance;
  }));
}

// The same bands on all profiles, or on each its own.
AxisFit fit_shape(const Line& line, const BandShape& shape, bool shared) {
  const int gap = cells(kLeastGap_m, line.cell_m);
  AxisFit fit{.shape = shape};
  const auto add = [&](std::span<const ProfileSums> profiles) {
    Segmentation found = best_bands(profiles, shape, gap, line.price);
    if (found.begins.empty()) return false;
    fit.misfit += found.misfit;
    fit.parameters += found.parameters + 2 * irregular_steps(found.begins, shape, line.cell_m);
    fit.begins.push_back(std::move(found.begins));
    return true;
  };
  fit.misfit = 0;
  bool found = true;
  if (shared) {
    found = add(line.profiles);
  } else {
    for (const ProfileSums& profile : line.profiles) found = found && add({&profile, 1});
  }
  if (!found) fit.misfit = std::numeric_limits<double>::infinity();
  return fit;
}

bool may_be(int size, double cell_m, const KnownSides& known) {
  const auto is = [&](const std::optional<double>& side_m) {
    return side_m && std::abs(size * cell_m - *side_m) <= 0.5 * cell_m + 0.01 * *side_m;
  };
  if (known.width_m && known.length_m) return is(known.width_m) || is(known.length_m);
  return true;
}

std::vector<BandShape> coarse_shapes(const Line& line) {
  const KnownSides& known = line.known;
  std::vector<BandShape> shapes;
  const double most =
      std::min<double>(kMostSide_m / line.cell_m, line.profiles.front().cells() - 4);
  std::vector<int> sizes;
  for (double size = kLeastSide_m / line.cell_m; size <= most;
       size = std::max(size + 1, size * kSizeStep))
    sizes.push_back(static_cast<int>(size));
  for (const auto& side_m : {known.width_m, known.length_m})
    if (side_m) sizes.push_back(cells(*side_m, line.cell_m));
  for (const int size : sizes)
    if (may_be(size, line.cell_m, known)) shapes.push_back({.size = size});
  return shapes;
}

std::vector<BandShape> shapes_like(const BandShape& shape) {
  std::vector<BandShape> shapes;
  for (const double wider : {0.98, 1.0, 1.02}) {
    for (const int blur : {1, 2, 4}) {
      const int size = static_cast<int>(std::lround(shape.size * wider));
      shapes.push_back({.size = std::max(3, size), .blur = blur});
    }
  }
  return shapes;
}

// The same where its bands are drill rows: of whole plots.
AxisFit put_together(const Line& line, AxisFit fit) {
  fit.seen_shape = fit.shape;
  fit.seen = fit.begins;
  if (line.known.width_m && line.known.length_m) return fit;  // the bands are the plots
  std::vector<std::vector<double>> middles;
  for (std::size_t i = 0; i < fit.begins.size(); ++i) {
    middles.emplace_back();
    for (const int begin : fit.begins[i])
      middles.back().push_back(line.profiles[i].centroid(begin, begin + fit.shape.size));
  }
  const double cell_m = line.cell_m;
  const auto plots = drilled_plots(middles, kMostSpacing_m / cell_m, kLeastGap_m / cell_m);
  if (!plots) return fit;
  fit.drilled = true;
  fit.shape.size = static_cast<int>(std::lround(plots->width()));
  fit.begins.clear();
  for (const std::vector<double>& begins : plots->begins) {
    fit.begins.emplace_back();
    for (const double begin : begins)
      fit.begins.back().push_back(static_cast<int>(std::lround(begin)));
  }
  return fit;
}

// Whether most steps are one pitch: bands that a canopy's texture suggests lie anywhere.
bool is_regular(const Line& line, const AxisFit& fit) {
  double irregular = 0, steps = 0;
  for (const std::vector<int>& begins : fit.begins) {
    irregular += irregular_steps(begins, fit.shape, line.cell_m);
    steps += static_cast<double>(begins.size()) - 1;
  }
  return irregular <= kMostIrregular * steps;
}

// The best of those that are plots, or drill rows of plots.
AxisFit best_of(const Line& line, std::vector<AxisFit> fits) {
  std::ranges::stable_sort(fits, {}, [&](const AxisFit& fit) { return fit.cost(line.price); });
  for (const AxisFit& fit : fits) {
    if (!std::isfinite(fit.misfit)) break;
    const AxisFit plots = put_together(line, fit);
    if (plots.drilled || (is_regular(line, fit) && fit.shape.size * line.cell_m >= kLeastPlot_m))
      return fit;
  }
  return fits.front();
}

std::vector<AxisFit> fit_shapes(const Line& line, const std::vector<BandShape>& shapes,
                                bool shared) {
  std::vector<AxisFit> fits(shapes.size());
  tbb::parallel_for(std::size_t{0}, shapes.size(),
                    [&](std::size_t i) { fits[i] = fit_shape(line, shapes[i], shared); });
  return fits;
}

AxisFit fit_axis(const Line& line, bool shared) {
  Line tried = line;
  if (!shared && tried.profiles.size() > kRowsTried)
    tried.profiles.erase(tried.profiles.begin() + kRowsTried, tried.profiles.end());
  std::vector<AxisFit> fits = fit_shapes(tried, coarse_shapes(line), shared);
  if (fits.empty()) return {};
  std::ranges::stable_sort(fits, {}, [&](const AxisFit& fit) { return fit.cost(line.price); });
  std::vector<BandShape> shapes;
  for (std::size_t i = 0; i < std::min(fits.size(), kRefined); ++i) {
    for (const BandShape& shape : shapes_like(fits[i].shape))
      if (may_be(shape.size, line.cell_m, line.known)) shapes.push_back(shape);
  }
  if (!shared) fits.clear();  // of fewer profiles
  for (AxisFit& fit : fit_shapes(line, shapes, shared)) fits.push_back(std::move(fit));
  return best_of(line, std::move(fits));
}

std::vector<Band> bands_of(const AxisFit& fit, std::size_t profile) {
  std::vector<Band> bands;
  for (const int begin : fit.begins[std::min(profile, fit.begins.size() - 1)])
    bands.push_back({begin, begin + fit.shape.size});
  return bands;
}

std::vector<Band> whole(int cells) { return {{0, cells}}; }

std::vector<std::vector<Band>> each_alone(const std::vector<Band>& bands) {
  std::vector<std::vector<Band>> lists;
  for (const Band& band : bands) lists.push_back({band});
  return lists;
}

// The same bands on other profiles.
double bands_cost(const Line& line, const Segmentation& bands) {
  const Segmentation again = bands_at(line.profiles, bands.shape, bands.begins);
  return again.misfit + line.price * (again.parameters +
                                      2 * irregular_steps(bands.begins, bands.shape, line.cell_m));
}

struct Sums {
  double cells = 0, canopy = 0, squares = 0;

  Sums& operator-=(const Sums& other) {
    cells -= other.cells;
    canopy -= other.canopy;
    squares -= other.squares;
    return *this;
  }
  // Squares about the mean.
  double left() const { return squares - canopy * canopy / std::max(1.0, cells); }
};

Sums sums_over(const RowView& view, const Band& r, const Band& c) {
  Sums sums;
  for (int i = std::max(0, r.begin); i < std::min(r.end, view.r_cells()); ++i) {
    for (int k = std::max(0, c.begin); k < std::min(c.end, view.c_cells()); ++k) {
      if (view.seen_cells(i, i + 1, k, k + 1) == 0) continue;
      const double canopy = view.cover(i, i + 1, k, k + 1);
      ++sums.cells;
      sums.canopy += canopy;
      sums.squares += canopy * canopy;
    }
  }
  return sums;
}

double square(double value) { return value * value; }

// Of a row's plots those that are there.
void leave_out_missing(Layout& layout) {
  std::vector<double> covers;
  const auto cover = [&](const Row& row, const Band& plot) {
    return layout.view.cover(row.band.begin, row.band.end, plot.begin, plot.end);
  };
  for (const Row& row : layout.rows)
    for (const Band& plot : row.plots) covers.push_back(cover(row, plot));
  const double least = kLeastShare * median(covers);
  for (Row& row : layout.rows)
    std::erase_if(row.plots, [&](const Band& plot) { return cover(row, plot) < least; });
  std::erase_if(layout.rows, [](const Row& row) { return row.plots.empty(); });
}

Layout layout_of(const RowView& view, const AxisFit& r_fit, const AxisFit& c_fit) {
  Layout layout{.view = view, .r_shape = r_fit.shape, .c_shape = c_fit.shape};
  layout.r_drilled = r_fit.drilled;
  layout.c_drilled = c_fit.drilled;
  layout.aligned = c_fit.begins.size() == 1;
  layout.r_seen = {.shape = r_fit.seen_shape, .begins = r_fit.seen.front()};
  layout.c_seen = {.shape = c_fit.seen_shape, .begins = c_fit.seen.front()};
  const std::vector<Band> rows = bands_of(r_fit, 0);
  for (std::size_t i = 0; i < rows.size(); ++i)
    layout.rows.push_back({rows[i], bands_of(c_fit, i)});
  leave_out_missing(layout);
  return layout;
}

// Equal parts of a band, about as long as a piece.
std::vector<Band> pieces_of(const Band& band, double cell_m) {
  const int parts = std::max(1, static_cast<int>(std::lround(band.size() * cell_m / kPiece_m)));
  std::vector<Band> pieces;
  for (int i = 0; i < parts; ++i)
    pieces.push_back(
        {band.begin + band.size() * i / parts, band.begin + band.size() * (i + 1) / parts});
  return pieces;
}

double number_of_lines(const Layout& layout) {
  double plots = 0, most = 0;
  for (const Row& row : layout.rows) {
    plots += static_cast<double>(row.plots.size());
    most = std::max(most, static_cast<double>(row.plots.size()));
  }
  return static_cast<double>(layout.rows.size()) + (layout.aligned ? most : plots);
}

// A stretch between two bands that leaves may close; empty where it is wider.
Band gap_between(const Band& one, const Band& next, double cell_m) {
  if ((next.begin - one.end) * cell_m > kMostGap_m) return {};
  return {one.end, std::max(one.end, next.begin)};
}

// What is left of the canopy's variation when every piece of the plots and of the gaps between them
// has a level, and all else one.
double variation_left(const Layout& layout) {
  const RowView& view = layout.view;
  Sums beyond = sums_over(view, {0, view.r_cells()}, {0, view.c_cells()});
  double left = 0;
  const auto take = [&](const Band& r_band, const Band& c_band) {
    if (r_band.size() <= 0 || c_band.size() <= 0) return;
    for (const Band& r : pieces_of(r_band, view.cell_m())) {
      for (const Band& c : pieces_of(c_band, view.cell_m())) {
        const Sums sums = sums_over(view, r, c);
        left += sums.left();
        beyond -= sums;
      }
    }
  };
  for (std::size_t i = 0; i < layout.rows.size(); ++i) {
    const Row& row = layout.rows[i];
    const bool last_row = i + 1 == layout.rows.size();
    const Band gap =
        last_row ? Band{} : gap_between(row.band, layout.rows[i + 1].band, view.cell_m());
    for (std::size_t k = 0; k < row.plots.size(); ++k) {
      take(row.band, row.plots[k]);
      take(gap, row.plots[k]);
      if (k > 0) take(row.band, gap_between(row.plots[k - 1], row.plots[k], view.cell_m()));
    }
  }
  return left + beyond.left();
}

// Schwarz's criterion of the layout: its likelihood, and the lines on which plots begin. Levels are
// no parameters: whatever the layout, every piece of canopy has its own, so that none fits an
// uneven canopy better for having more plots.
double criterion(const Layout& layout) {
  const RowView& view = layout.view;
  const double seen = view.seen_cells(0, view.r_cells(), 0, view.c_cells());
  const double independent = seen * square(view.cell_m() / kLeafClump_m);
  return independent * std::log(std::max(1e-12, variation_left(layout))) +
         std::log(std::max(2.0, independent)) * number_of_lines(layout);
}

// Rows over the whole field, then what lies along them: the same columns in all, or each row's own.
std::vector<Layout> layouts_with_rows(const RowView& view, const KnownSides& known) {
  const RowView along = view.turned();
  Line r_line = line_of(view, {whole(view.c_cells())}, known);
  AxisFit r_fit = fit_axis(r_line, true);
  if (!std::isfinite(r_fit.misfit)) return {};
  std::vector<Band> rows = bands_of(put_together(r_line, r_fit), 0);
  Line c_line = line_of(along, {rows}, known);
  AxisFit columns = fit_axis(c_line, true);
  std::vector<Layout> layouts;
  const Line each = line_of(along, each_alone(rows), known);
  const AxisFit own = fit_axis(each, false);
  if (std::isfinite(own.misfit))
    layouts.push_back(layout_of(view, put_together(r_line, r_fit), put_together(each, own)));
  if (!std::isfinite(columns.misfit)) return layouts;
  // Without the alleys between the columns the rows show more clearly, and the columns then.
  r_line = line_of(view, {bands_of(put_together(c_line, columns), 0)}, known);
  r_fit = fit_axis(r_line, true);
  if (!std::isfinite(r_fit.misfit)) return layouts;
  rows = bands_of(put_together(r_line, r_fit), 0);
  c_line = line_of(along, {rows}, known);
  columns = fit_axis(c_line, true);
  if (std::isfinite(columns.misfit))
    layouts.push_back(layout_of(view, put_together(r_line, r_fit), put_together(c_line, columns)));
  return layouts;
}

// Of the layouts with columns through all rows the one that explains the whole field best, along
// both axes, where all plots' edges add up, and cell by cell.
void leave_best_aligned(const RowView& view, const KnownSides& known,
                        std::vector<Layout>& layouts) {
  const Line a = line_of(view, {whole(view.c_cells())}, known);
  const Line b = line_of(view.turned(), {whole(view.r_cells())}, known);
  const auto cost = [&](const Layout& layout) {
    const bool turned = layout.view.swapped;
    return bands_cost(turned ? b : a, layout.r_seen) + bands_cost(turned ? a : b, layout.c_seen) +
           criterion(layout);
  };
  const Layout* best = nullptr;
  for (const Layout& layout : layouts)
    if (layout.aligned && (best == nullptr || cost(layout) < cost(*best))) best = &layout;
  if (best == nullptr) return;
  std::vector<Layout> left = {*best};
  std::ranges::copy_if(layouts, std::back_inserter(left),
                       [](const Layout& layout) { return !layout.aligned; });
  layouts = std::move(left);
}

}  // namespace

Layout best_layout(const CanopyRaster& raster, const KnownSides& known) {
  const RowView view{.raster = &raster};
  if (view.r_cells() < 8 || view.c_cells() < 8) return {.view = view};
  std::vector<Layout> layouts = layouts_with_rows(view, known);
  for (Layout& layout : layouts_with_rows(view.turned(), known))
    layouts.push_back(std::move(layout));
  leave_best_aligned(view, known, layouts);
  const double without = criterion({.view = view});
  Layout best{.view = view};
  double most = 0;
  for (Layout& layout : layouts) {
    layout.evidence = 0.5 * (without - criterion(layout));
    const double doubted = layout.aligned ? layout.evidence : (1 - kOwnDoubt) * layout.evidence;
    if (doubted <= most) continue;
    most = doubted;
    best = std::move(layout);
  }
  return best;
}

}  // namespace plotscan::plots
