// SPDX-License-Identifier: Apache-2.0
#include "plots/layout/layout.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/statistics.h"
#include "plots/layout/internal/layout_criterion.h"
#include "plots/layout/steps.h"

namespace plotscan::plots {
namespace {

constexpr double kSameColumn_m = 0.15;   // off which leaves do not move what is seen of a plot
constexpr double kNearlyAsClear = 0.9;   // of the evidence, where gaps show along more axes
constexpr double kMuchClearer = 2.5;     // of wide bands than of bands as narrow as drill rows
constexpr double kLeastAspectOfRow = 6;  // of a crop row where no spacing tells that it is one;
constexpr double kLeastAspectOfDrillRow = 3;  // of one at a known spacing, also across a plot
constexpr double kLeastOfUsual = 0.3;         // of the usual plot's canopy: less is a missing one

std::vector<Band> whole(int cells) { return {{0, cells}}; }

std::vector<std::vector<Band>> each_alone(const std::vector<Band>& bands) {
  std::vector<std::vector<Band>> lists;
  lists.reserve(bands.size());
  for (const Band& band : bands) lists.push_back({band});
  return lists;
}

// Removes the plots that are missing in each row.
void leave_out_missing(Layout& layout) {
  std::vector<double> covers;
  const auto cover = [&](const Row& row, const Band& plot) {
    return layout.view.cover(row.band.begin, row.band.end, plot.begin, plot.end);
  };
  for (const Row& row : layout.rows)
    for (const Band& plot : row.plots) covers.push_back(cover(row, plot));
  const double least = kLeastOfUsual * quantile(covers, 0.5);
  for (Row& row : layout.rows)
    std::erase_if(row.plots, [&](const Band& plot) { return cover(row, plot) < least; });
  std::erase_if(layout.rows, [](const Row& row) { return row.plots.empty(); });
}

Layout layout_from(const RowView& view, const AxisFit& r_fit, const AxisFit& c_fit) {
  Layout layout{.view = view, .r_shape = r_fit.shape, .c_shape = c_fit.shape};
  layout.aligned = c_fit.begins.size() == 1;
  layout.narrower_band = std::min(r_fit.band_size, c_fit.band_size);
  layout.row_spacing = c_fit.row_spacing;
  layout.r_touching = r_fit.touching;
  layout.c_touching = c_fit.touching;
  const std::vector<Band> rows = bands_of(r_fit, 0);
  for (std::size_t i = 0; i < rows.size(); ++i)
    layout.rows.push_back({rows[i], bands_of(c_fit, i)});
  leave_out_missing(layout);
  return layout;
}

// What is known along either axis of a view.
struct ViewHints {
  AxisHint r, c;
};

// Plots along a line: those between gaps, and those that touch.
std::vector<AxisFit> fits_on(const Line& line, bool shared) {
  std::vector<AxisFit> fits;
  AxisFit apart = fit_axis(line, shared);
  if (std::isfinite(apart.misfit)) fits.push_back(put_together(line, std::move(apart)));
  if (line.hint.model != LineModel::touching) return fits;
  if (std::optional<AxisFit> touching = fit_touching(line)) fits.push_back(std::move(*touching));
  return fits;
}

// Rows over the whole field, then what lies along them: the same columns in all, or each row's own.
std::vector<Layout> layouts_with_rows(const RowView& view, const ViewHints& hints) {
  const RowView along = view.turned();
  std::vector<Layout> layouts;
  for (const AxisFit& r_fit : fits_on(line_of(view, {whole(view.c_cells())}, hints.r), true)) {
    const std::vector<Band> rows = bands_of(r_fit, 0);
    const Line each = line_of(along, each_alone(rows), hints.c);
    const Line all = line_of(along, {rows}, hints.c);
    for (const auto& [line, shared] : {std::pair{&each, false}, std::pair{&all, true}})
      for (const AxisFit& c_fit : fits_on(*line, shared))
        layouts.push_back(layout_from(view, r_fit, c_fit));
  }
  return layouts;
}

// Both ways of seeing the field as rows.
std::vector<Layout> layouts_on(const RowView& view, const ViewHints& hints) {
  std::vector<Layout> layouts = layouts_with_rows(view, hints);
  for (Layout& layout : layouts_with_rows(view.turned(), {hints.c, hints.r}))
    layouts.push_back(std::move(layout));
  return layouts;
}

// Where the hints say what lies along the length and what along the width: the length is no
// shorter.
bool is_longer_along(bool a_axis, const Layout& layout) {
  const bool r_is_a = !layout.view.swapped;
  const int along = r_is_a == a_axis ? layout.r_shape.size : layout.c_shape.size;
  const int across = r_is_a == a_axis ? layout.c_shape.size : layout.r_shape.size;
  return along >= across;
}

// Whether the plots' length may lie along the raster's a axis, or along its b axis, as the user
// says.
bool may_lie_along(bool a_axis, const CanopyRaster& raster, const Hints& hints) {
  if (!hints.heading_rad) return true;
  const Eigen::Vector2d heading(std::cos(*hints.heading_rad), std::sin(*hints.heading_rad));
  const double along_a = std::abs(heading.dot(raster.frame().a_axis));
  const double along_b = std::abs(heading.dot(raster.frame().b_axis));
  return a_axis == (along_a >= along_b);
}

// The plots' length may lie along either axis of the raster, unless the user says along which.
std::vector<Layout> layouts_as_told(const RowView& view, const Hints& hints, LineModel model) {
  const AxisHint length{hints.length_m, hints.rows, model};
  const AxisHint width{hints.width_m, hints.columns, model};
  std::vector<Layout> layouts;
  for (const bool along_a : {true, false}) {
    if (!may_lie_along(along_a, *view.raster, hints)) continue;
    for (Layout& layout :
         layouts_on(view, along_a ? ViewHints{length, width} : ViewHints{width, length})) {
      if (is_longer_along(along_a, layout)) layouts.push_back(std::move(layout));
    }
  }
  return layouts;
}

// Whether the layout's places may hold this many plots, of which some failed.
bool may_hold(const Layout& layout, int plots) {
  constexpr double kLeastOfPlaces = 0.6;
  std::size_t columns = 0;
  for (const Row& row : layout.rows) columns = std::max(columns, row.plots.size());
  const auto places = static_cast<double>(layout.rows.size() * columns);
  return plots <= places && plots >= kLeastOfPlaces * places;
}

// Layouts with the user's number of plots: those that the canopy suggests, else full grids of that
// many.
std::vector<Layout> layouts_of_plots(const RowView& view, const Hints& hints, LineModel model) {
  std::vector<Layout> layouts = layouts_as_told(view, hints, model);
  const auto keep_told = [&] {
    std::erase_if(layouts, [&](const Layout& layout) { return !may_hold(layout, *hints.plots); });
  };
  keep_told();
  if (!layouts.empty()) return layouts;
  for (int rows = 1; rows <= *hints.plots; ++rows) {
    if (*hints.plots % rows != 0) continue;
    Hints whole_rows = hints;
    whole_rows.rows = rows;
    whole_rows.columns = *hints.plots / rows;
    if (hints.rows.value_or(rows) != rows) continue;
    if (hints.columns.value_or(*whole_rows.columns) != *whole_rows.columns) continue;
    for (Layout& layout : layouts_as_told(view, whole_rows, LineModel::even_ends))
      layouts.push_back(std::move(layout));
  }
  keep_told();
  return layouts;
}

std::vector<Layout> layouts_in(const RowView& view, const Hints& hints, LineModel model) {
  if (hints.plots) return layouts_of_plots(view, hints, model);
  if (hints.tell_layout()) return layouts_as_told(view, hints, model);
  return layouts_on(view, {{.model = model}, {.model = model}});
}

// Whether the layout's plots are one by one the drill rows that another's consist of: too narrow
// for two of them.
bool are_rows_of(const Layout& layout, const Layout& drilled) {
  double width = layout.r_shape.size, length = layout.c_shape.size;
  if (layout.view.swapped == drilled.view.swapped) std::swap(width, length);
  return length > kLeastAspectOfDrillRow * width && width < drilled.row_spacing;
}

// Where rows of plots have different offsets, their drill rows may by chance form columns through
// the whole field. Such drill rows are not taken for plots where groups of them are plots.
void leave_out_drill_rows(std::vector<Layout>& layouts) {
  const std::vector<Layout> all = layouts;
  std::erase_if(layouts, [&](const Layout& layout) {
    return std::ranges::any_of(all,
                               [&](const Layout& other) { return are_rows_of(layout, other); });
  });
}

double usual_pitch(const Layout& layout) {
  std::vector<double> steps;
  for (const Row& row : layout.rows)
    for (std::size_t i = 1; i < row.plots.size(); ++i)
      steps.push_back(row.plots[i].begin - row.plots[i - 1].begin);
  return usual_step(std::move(steps));
}

// Where columns begin: the medians of plots' begins that lie together, all rows taken as one. Those
// that lie apart by a third of the pitch are of different columns.
std::vector<double> columns_of(const Layout& layout) {
  constexpr double kApart = 0.35;
  std::vector<double> begins;
  for (const Row& row : layout.rows)
    for (const Band& plot : row.plots) begins.push_back(plot.begin);
  std::ranges::sort(begins);
  const double apart = kApart * usual_pitch(layout);
  std::vector<double> columns, together;
  for (std::size_t i = 0; i < begins.size(); ++i) {
    together.push_back(begins[i]);
    if (i + 1 < begins.size() && begins[i + 1] - begins[i] < apart) continue;
    columns.push_back(quantile(std::move(together), 0.5));
    together = {};
  }
  return columns;
}

// Median over a row's plots of how far they lie from the nearest column: the lower one, as leaves
// may have moved one of two.
double off_columns(const Row& row, const std::vector<double>& columns) {
  std::vector<double> off;
  for (const Band& plot : row.plots) {
    const auto from = [&](double column) { return std::abs(column - plot.begin); };
    off.push_back(from(*std::ranges::min_element(columns, {}, from)));
  }
  return selected(std::span(off), (off.size() - 1) / 2);
}

// Rows of their own may have common columns that leaves and lodged plots hide in some of them.
void add_in_columns(std::vector<Layout>& layouts) {
  const std::size_t count = layouts.size();
  for (std::size_t i = 0; i < count; ++i) {
    if (layouts[i].aligned) continue;
    if (std::optional<Layout> columns = in_columns(layouts[i]))
      layouts.push_back(std::move(*columns));
  }
}

// Along how many axes the plots touch.
int touching_axes(const Layout& layout) {
  return (layout.r_touching ? 1 : 0) + (layout.c_touching ? 1 : 0);
}

// Whether there is less canopy from plot to plot of a row than in the plots.
bool has_gaps(const Layout& layout) {
  constexpr double kMostCover = 0.95;  // of the plots'
  double in_gaps = 0, in_plots = 0;
  for (const auto& [band, plots] : layout.rows) {
    for (std::size_t i = 0; i + 1 < plots.size(); ++i) {
      const Band &plot = plots[i], &next = plots[i + 1];
      if (next.begin <= plot.end) continue;
      in_gaps += layout.view.cover(band.begin, band.end, plot.end, next.begin);
      in_plots += layout.view.cover(band.begin, band.end, plot.begin, plot.end);
    }
  }
  return in_plots == 0 || in_gaps < kMostCover * in_plots;
}

// Of the layouts whose plots touch along so many axes, the one with the most evidence, if any has
// some.
std::optional<Layout> clearest(const std::vector<Layout>& layouts, int axes) {
  const Layout* best = nullptr;
  for (const Layout& layout : layouts) {
    const double least = best == nullptr ? 0 : best->evidence;
    if (touching_axes(layout) == axes && layout.evidence > least) best = &layout;
  }
  return best == nullptr ? std::nullopt : std::optional(*best);
}

// The clearest layout. Those that touch must explain the canopy at least as well as those between
// gaps, if these are gaps. Where nothing shows between plots, others may explain the canopy as
// well: those that touch along one axis are taken before those that touch along both.
std::optional<Layout> clearest(const std::vector<Layout>& layouts) {
  const auto evidence = [](const std::optional<Layout>& layout) {
    return layout ? layout->evidence : 0;
  };
  const auto none = clearest(layouts, 0), one = clearest(layouts, 1), two = clearest(layouts, 2);
  const auto& touching = evidence(one) >= kNearlyAsClear * evidence(two) ? one : two;
  const bool is_as_clear = evidence(touching) >= evidence(none) || !has_gaps(*none);
  return touching && is_as_clear ? touching : none;
}

// The clearest of the layouts, those of the user's hints; without rows where none is.
Layout best_of(std::vector<Layout> layouts, const RowView& view, const Hints& hints,
               const LayoutCriterion& criterion) {
  leave_out_drill_rows(layouts);
  for (Layout& layout : layouts) layout.aligned = layout.aligned || is_in_columns(layout);
  if (!hints.tell_layout()) add_in_columns(layouts);
  const double without = criterion({.view = view});
  for (Layout& layout : layouts) layout.evidence = 0.5 * (without - criterion(layout));
  return clearest(layouts).value_or(Layout{.view = view});
}

double plots_in(const Layout& layout) {
  double plots = 0;
  for (const Row& row : layout.rows) plots += static_cast<double>(row.plots.size());
  return plots;
}

// Whether the plots of one layout are parts of the other's: more of them, and smaller.
bool are_parts_of(const Layout& parts, const Layout& whole) {
  constexpr double kSeveral = 1.5;  // two and more; some may not have been seen
  const auto area = [](const Layout& layout) {
    return 1.0 * layout.r_shape.size * layout.c_shape.size;
  };
  return plots_in(parts) >= kSeveral * plots_in(whole) && area(whole) >= kSeveral * area(parts);
}

// Whether the bands that show are as narrow as drill rows.
bool has_narrow_bands(const Layout& layout) {
  return !layout.rows.empty() && layout.narrower_band * layout.view.cell_m() < kMostSpacing_m;
}

}  // namespace

bool is_in_columns(const Layout& layout) {
  const double same = kSameColumn_m / layout.view.cell_m();
  const std::vector<double> columns = columns_of(layout);
  return std::ranges::all_of(layout.rows,
                             [&](const Row& row) { return off_columns(row, columns) <= same; });
}

std::optional<Layout> in_columns(Layout layout) {
  std::vector<Band> plots;
  for (const double column : columns_of(layout)) {
    const int begin = static_cast<int>(std::lround(column));
    plots.push_back({begin, begin + layout.c_shape.size});
  }
  const auto overlap = [](const Band& plot, const Band& next) { return next.begin <= plot.end; };
  if (std::ranges::adjacent_find(plots, overlap) != plots.end()) return std::nullopt;
  layout.aligned = true;
  for (Row& row : layout.rows) row.plots = plots;
  leave_out_missing(layout);
  return layout;
}

std::optional<double> heading_of_rows(const Layout& layout) {
  const auto [width, length] = std::minmax(layout.r_shape.size, layout.c_shape.size);
  if (layout.rows.empty() || length <= kLeastAspectOfRow * width) return std::nullopt;
  const bool along_r = layout.r_shape.size == length;
  const Eigen::Vector2d axis = along_r ? layout.view.r_axis() : layout.view.c_axis();
  return std::atan2(axis.y(), axis.x());
}

Layout best_layout(const CanopyRaster& raster, const Hints& hints, LineModel model) {
  const RowView view{.raster = &raster};
  if (view.r_cells() < 8 || view.c_cells() < 8) return {.view = view};
  const bool counted = hints.rows || hints.columns || hints.plots;
  if (counted && model == LineModel::free_ends) model = LineModel::even_ends;
  const LayoutCriterion criterion(raster);
  Layout best = best_of(layouts_in(view, hints, model), view, hints, criterion);
  if (!hints.tell_layout() && has_narrow_bands(best)) {
    const AxisHint wide{.model = LineModel::even_ends, .least_m = kMostSpacing_m};
    Layout whole = best_of(layouts_on(view, {wide, wide}), view, hints, criterion);
    const double least = are_parts_of(best, whole) ? 1 : kMuchClearer;
    if (whole.evidence > least * best.evidence) best = std::move(whole);
  }
  if (!best.rows.empty()) best.evidence_in_outline = criterion.evidence_in_outline(best);
  return best;
}

}  // namespace plotscan::plots
