// SPDX-License-Identifier: Apache-2.0
#include "plots/layout.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "plots/layout_criterion.h"
#include "plots/statistics.h"

namespace plotscan::plots {
namespace {

constexpr double kOwnDoubt = 0.05;   // rows with offsets of their own must explain so much more
constexpr double kLeastShare = 0.3;  // of the usual plot's canopy: less is a missing one

std::vector<Band> whole(int cells) { return {{0, cells}}; }

std::vector<std::vector<Band>> each_alone(const std::vector<Band>& bands) {
  std::vector<std::vector<Band>> lists;
  for (const Band& band : bands) lists.push_back({band});
  return lists;
}

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
