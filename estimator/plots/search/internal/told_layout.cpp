// SPDX-License-Identifier: Apache-2.0
#include "plots/search/internal/told_layout.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

#include <fmt/core.h>

#include "plots/lattice/row_ends.h"

namespace plotscan::plots {
namespace {

// A layout's plots as users count them: rows follow each other along the longer side.
struct Counted {
  int rows = 0, columns = 0;
  double width_m = 0, length_m = 0;
};

Counted counted(const Layout& layout) {
  std::size_t columns = 0;
  for (const Row& row : layout.rows) columns = std::max(columns, row.plots.size());
  const double cell_m = layout.view.cell_m();
  Counted plots{.rows = static_cast<int>(layout.rows.size()),
                .columns = static_cast<int>(columns),
                .width_m = layout.c_shape.size * cell_m,
                .length_m = layout.r_shape.size * cell_m};
  if (plots.length_m < plots.width_m) {
    std::swap(plots.length_m, plots.width_m);
    std::swap(plots.rows, plots.columns);
  }
  return plots;
}

// Of the widest row: rows that begin at places of their own have other first columns.
int columns_of(const TrialLayout& layout) {
  int columns = 0;
  for (const auto& [row, end] : row_ends(layout.places))
    columns = std::max(columns, end.second - end.first + 1);
  return columns;
}

bool is_told(int shown, const std::optional<int>& told) { return shown == told.value_or(shown); }

bool is_near(double shown_m, const std::optional<double>& told_m) {
  constexpr double kMostOff = 0.2;
  return !told_m || std::abs(shown_m - *told_m) <= kMostOff * *told_m;
}

// Many state the step from plot to plot as a plot's side, gap and all.
bool may_be(double shown_m, double pitch_m, const std::optional<double>& told_m) {
  constexpr double kMostOffPitch = 0.02;  // steps are regular, and told to centimetres
  return is_near(shown_m, told_m) || std::abs(*told_m - pitch_m) <= kMostOffPitch * pitch_m;
}

}  // namespace

std::string text_of(const Layout& layout) {
  const Counted plots = counted(layout);
  return fmt::format("{} rows of {} plots of {:.2f} x {:.2f} m", plots.rows, plots.columns,
                     plots.width_m, plots.length_m);
}

bool is_as_told(const Layout& layout, const Hints& hints) {
  const Counted plots = counted(layout);
  return is_told(plots.rows, hints.rows) && is_told(plots.columns, hints.columns) &&
         is_told(plots.rows * plots.columns, hints.plots) &&
         is_near(plots.width_m, hints.width_m) && is_near(plots.length_m, hints.length_m);
}

bool is_as_told(const TrialLayout& layout, const Hints& hints) {
  return is_told(layout.rows(), hints.rows) && is_told(columns_of(layout), hints.columns) &&
         is_told(static_cast<int>(std::ssize(layout.places)), hints.plots) &&
         may_be(layout.width_m, layout.column_pitch_m, hints.width_m) &&
         may_be(layout.length_m, layout.row_pitch_m, hints.length_m);
}

PlotField with_sides(PlotField field, const Hints& hints) {
  TrialLayout& layout = field.fit->layout;
  layout.width_m = hints.width_m.value_or(layout.width_m);
  layout.length_m = hints.length_m.value_or(layout.length_m);
  for (FoundPlot& plot : field.plots) {
    plot.box.width_m = layout.width_m;
    plot.box.length_m = layout.length_m;
    if (hints.width_m) plot.box_error.width_m = 0;
    if (hints.length_m) plot.box_error.length_m = 0;
  }
  return field;
}

std::string not_told_because(const TrialLayout& layout, const FieldSigns& signs,
                             const Hints& hints) {
  constexpr double kOverlap_m = 0.05;  // a cell of the raster
  const auto other = [](int shown, const std::optional<int>& told, const char* lines) {
    return told && *told != shown ? fmt::format("the canopy shows {} {} of plots, not the {} told",
                                                shown, lines, *told)
                                  : "";
  };
  if (std::string rows = other(layout.rows(), hints.rows, "rows"); !rows.empty()) return rows;
  if (std::string columns = other(columns_of(layout), hints.columns, "columns"); !columns.empty())
    return columns;
  return !hints.width_m && !hints.length_m && signs.least_gap_m < -kOverlap_m
             ? "plots of the number told would overlap here"
             : "";
}

}  // namespace plotscan::plots
