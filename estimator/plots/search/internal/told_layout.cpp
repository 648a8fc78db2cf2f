// SPDX-License-Identifier: Apache-2.0
#include "plots/search/internal/told_layout.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

#include <fmt/core.h>

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

bool is_told(int shown, const std::optional<int>& told) { return shown == told.value_or(shown); }

}  // namespace

std::string text_of(const Layout& layout) {
  const Counted plots = counted(layout);
  return fmt::format("{} rows of {} plots of {:.2f} x {:.2f} m", plots.rows, plots.columns,
                     plots.width_m, plots.length_m);
}

bool is_as_told(const Layout& layout, const Hints& hints) {
  constexpr double kMostOff = 0.2;
  const Counted plots = counted(layout);
  const auto is_near = [](double shown_m, const std::optional<double>& told_m) {
    return !told_m || std::abs(shown_m - *told_m) <= kMostOff * *told_m;
  };
  return is_told(plots.rows, hints.rows) && is_told(plots.columns, hints.columns) &&
         is_told(plots.rows * plots.columns, hints.plots) &&
         is_near(plots.width_m, hints.width_m) && is_near(plots.length_m, hints.length_m);
}

bool is_as_told(const TrialLayout& layout, const Hints& hints) {
  return is_told(layout.rows(), hints.rows) && is_told(layout.columns(), hints.columns) &&
         is_told(static_cast<int>(std::ssize(layout.places)), hints.plots);
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
  if (std::string columns = other(layout.columns(), hints.columns, "columns"); !columns.empty())
    return columns;
  return !hints.width_m && !hints.length_m && signs.least_gap_m < -kOverlap_m
             ? "plots of the number told would overlap here"
             : "";
}

}  // namespace plotscan::plots
