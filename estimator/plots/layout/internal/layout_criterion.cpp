// SPDX-License-Identifier: Apache-2.0
#include "plots/layout/internal/layout_criterion.h"

#include <algorithm>
#include <cmath>

namespace plotscan::plots {
namespace {

constexpr double kMostGap_m = 1.5;  // that leaves may close
constexpr double kPiece_m = 1;      // in which a canopy is even
constexpr double kRim_m = 0.5;      // of ground around a field that must differ from it

// Squares of leaves that anything is seen of, over the cells that anything is seen of.
double clumps_per_cell(const CanopyRaster& raster) {
  const int side = std::max(1, static_cast<int>(std::lround(kLeaf_m / raster.cell_m())));
  double seen = 0;
  for (int a = 0; a < raster.a_cells(); a += side)
    for (int b = 0; b < raster.b_cells(); b += side)
      seen += raster.seen_cells(a, a + side, b, b + side) > 0 ? 1 : 0;
  return seen / std::max(1.0, raster.seen_cells(0, raster.a_cells(), 0, raster.b_cells()));
}

// Equal parts of a band, about as long as a piece.
std::vector<Band> pieces_of(const Band& band, double cell_m) {
  return equal_parts(band,
                     std::max(1, static_cast<int>(std::lround(band.size() * cell_m / kPiece_m))));
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

}  // namespace

// Of cells that anything is seen of.
struct LayoutCriterion::Sums {
  double cells = 0, canopy = 0, squares = 0;

  Sums& operator+=(const Sums& other) {
    cells += other.cells;
    canopy += other.canopy;
    squares += other.squares;
    return *this;
  }
  Sums& operator-=(const Sums& other) {
    cells -= other.cells;
    canopy -= other.canopy;
    squares -= other.squares;
    return *this;
  }
  // Squares about the mean.
  double left() const { return squares - canopy * canopy / std::max(1.0, cells); }
};

// Cells of a view.
struct LayoutCriterion::Area {
  Band r, c;

  static Area all_of(const RowView& view) { return {{0, view.r_cells()}, {0, view.c_cells()}}; }
  // A layout's outline, and the rim around it.
  static Area around(const Layout& layout) {
    Area area{layout.rows.front().band, layout.rows.front().plots.front()};
    for (const Row& row : layout.rows) {
      area.r = {std::min(area.r.begin, row.band.begin), std::max(area.r.end, row.band.end)};
      area.c = {std::min(area.c.begin, row.plots.front().begin),
                std::max(area.c.end, row.plots.back().end)};
    }
    const int rim = static_cast<int>(std::lround(kRim_m / layout.view.cell_m()));
    return {{area.r.begin - rim, area.r.end + rim}, {area.c.begin - rim, area.c.end + rim}};
  }
};

// The rows that plots are sown in, as the mean plot shows them: its cover from cell to cell along c
// or along r.
struct LayoutCriterion::RowsOfPlots {
  bool along_c = true;
  std::vector<double> cover = {};
};

LayoutCriterion::LayoutCriterion(const CanopyRaster& raster)
    : raster_(raster), per_cell_(clumps_per_cell(raster)), squared_(raster.squares()) {}

LayoutCriterion::Sums LayoutCriterion::sums_over(const RowView& view, const Band& r,
                                                 const Band& c) const {
  const Band &a = view.swapped ? c : r, &b = view.swapped ? r : c;
  const double cells = raster_.seen_cells(a.begin, a.end, b.begin, b.end);
  const auto squares = static_cast<double>(raster_.sum(squared_, a.begin, a.end, b.begin, b.end));
  return {.cells = cells,
          .canopy = cells * raster_.cover(a.begin, a.end, b.begin, b.end),
          .squares = squares / (1.0 * kFullCover * kFullCover)};
}

LayoutCriterion::RowsOfPlots LayoutCriterion::rows_along(bool along_c, const Layout& layout) const {
  const int size = along_c ? layout.c_shape.size : layout.r_shape.size;
  std::vector<Sums> strips(static_cast<std::size_t>(size));
  for (const Row& row : layout.rows) {
    for (const Band& plot : row.plots) {
      const Band& across = along_c ? plot : row.band;
      for (int i = 0; i < size; ++i) {
        const Band strip{across.begin + i, across.begin + i + 1};
        strips[static_cast<std::size_t>(i)] +=
            along_c ? sums_over(layout.view, row.band, strip) : sums_over(layout.view, strip, plot);
      }
    }
  }
  RowsOfPlots rows{.along_c = along_c};
  for (const Sums& strip : strips) rows.cover.push_back(strip.canopy / std::max(1.0, strip.cells));
  return rows;
}

// What a level of its own times the rows' cover leaves of a piece; `from` is where its plot begins
// across the rows.
double LayoutCriterion::left_in_piece(const RowView& view, const Band& r, const Band& c,
                                      const RowsOfPlots& rows, int from) const {
  const Band& across = rows.along_c ? c : r;
  double squares = 0, both = 0, of_rows = 0;
  for (int cell = across.begin; cell < across.end; ++cell) {
    const Band strip{cell, cell + 1};
    const Sums sums = rows.along_c ? sums_over(view, r, strip) : sums_over(view, strip, c);
    const double cover = rows.cover[static_cast<std::size_t>(cell - from)];
    squares += sums.squares;
    both += cover * sums.canopy;
    of_rows += cover * cover * sums.cells;
  }
  return squares - (of_rows > 0 ? both * both / of_rows : 0);
}

// The canopy's residual variation when each piece of the plots and of the gaps between them has its
// own level, and all the rest of the area one common level.
double LayoutCriterion::variation_left(const Layout& layout, const Area& area,
                                       const RowsOfPlots* rows) const {
  const RowView& view = layout.view;
  Sums beyond = sums_over(view, area.r, area.c);
  double left = 0;
  const auto take = [&](const Band& r_band, const Band& c_band, bool in_plot) {
    if (r_band.size() <= 0 || c_band.size() <= 0) return;
    for (const Band& r : pieces_of(r_band, view.cell_m())) {
      for (const Band& c : pieces_of(c_band, view.cell_m())) {
        const Sums sums = sums_over(view, r, c);
        left += in_plot && rows != nullptr
                    ? left_in_piece(view, r, c, *rows, (rows->along_c ? c_band : r_band).begin)
                    : sums.left();
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
      take(row.band, row.plots[k], true);
      take(gap, row.plots[k], false);
      if (k > 0) take(row.band, gap_between(row.plots[k - 1], row.plots[k], view.cell_m()), false);
    }
  }
  return left + beyond.left();
}

double LayoutCriterion::cost(const Layout& layout, const Area& area) const {
  const double observations = per_cell_ * sums_over(layout.view, area.r, area.c).cells;
  const auto cost_with = [&](const RowsOfPlots* rows) {
    const double leaves =
        rows == nullptr ? 0
                        : static_cast<double>(rows->cover.size()) * layout.view.cell_m() / kLeaf_m;
    return observations * std::log(std::max(1e-12, variation_left(layout, area, rows))) +
           std::log(std::max(2.0, observations)) * (number_of_lines(layout) + leaves);
  };
  double least = cost_with(nullptr);
  for (const bool along_c : {false, true}) {
    if (!(along_c ? layout.c_touching : layout.r_touching)) continue;
    const RowsOfPlots rows = rows_along(along_c, layout);
    least = std::min(least, cost_with(&rows));
  }
  return least;
}

double LayoutCriterion::operator()(const Layout& layout) const {
  return cost(layout, Area::all_of(layout.view));
}

double LayoutCriterion::evidence_in_outline(const Layout& layout) const {
  const Area area = Area::around(layout);
  return 0.5 * (cost({.view = layout.view}, area) - cost(layout, area));
}

}  // namespace plotscan::plots
