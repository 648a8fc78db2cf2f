// SPDX-License-Identifier: Apache-2.0
#include "plots/lattice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <tuple>

#include <Eigen/LU>

#include "plots/statistics.h"

namespace plotscan::plots {
namespace {

constexpr double kReach_m = 0.2;
constexpr double kLeastShare = 0.3;
constexpr double kLeastContrast = 0.25;
constexpr double kWellCovered = 0.6;

double inner_cover(const Lattice& lattice, const Place& place) {
  const double margin_m = 0.1 * std::min(lattice.r_size_m, lattice.c_size_m);
  const CellBox box = cells_about(lattice, place.r_m, place.c_m, -margin_m);
  return lattice.view.cover(box.r0, box.r1, box.c0, box.c1);
}

// Mean over the sides: cover within less cover beyond, along the side's middle three quarters.
double outline_contrast(const Lattice& lattice, const Place& place) {
  const auto [r0, r1, c0, c1] = cells_about(lattice, place.r_m, place.c_m, 0);
  const int reach = static_cast<int>(std::lround(kReach_m / lattice.view.cell_m()));
  const int r_inset = (r1 - r0) / 8, c_inset = (c1 - c0) / 8;
  const int ra = r0 + r_inset, rb = r1 - r_inset, ca = c0 + c_inset, cb = c1 - c_inset;
  const RowView& view = lattice.view;
  return (view.cover(r0, r0 + reach, ca, cb) - view.cover(r0 - reach, r0, ca, cb) +
          view.cover(r1 - reach, r1, ca, cb) - view.cover(r1, r1 + reach, ca, cb) +
          view.cover(ra, rb, c0, c0 + reach) - view.cover(ra, rb, c0 - reach, c0) +
          view.cover(ra, rb, c1 - reach, c1) - view.cover(ra, rb, c1, c1 + reach)) /
         4;
}

// The columns that run through all rows: positions that lie together; none where they do not.
std::vector<double> columns_of(std::vector<double> positions, double pitch_m) {
  std::ranges::sort(positions);
  std::vector<double> columns;
  std::size_t begin = 0;
  for (std::size_t i = 1; i <= positions.size(); ++i) {
    if (i < positions.size() && positions[i] - positions[i - 1] < 0.35 * pitch_m) continue;
    if (positions[i - 1] - positions[begin] > 0.5 * pitch_m) return {};
    columns.push_back((positions[begin] + positions[i - 1]) / 2);
    begin = i;
  }
  return columns;
}

void number(Lattice& lattice, const Layout& layout) {
  const double cell_m = lattice.view.cell_m();
  std::vector<double> steps, positions, row_steps;
  for (std::size_t i = 0; i < layout.rows.size(); ++i) {
    const Row& row = layout.rows[i];
    const double r_m = (row.band.begin + row.band.end) * cell_m / 2;
    if (i > 0) {
      const Band& last = layout.rows[i - 1].band;
      row_steps.push_back(r_m - (last.begin + last.end) * cell_m / 2);
    }
    for (std::size_t j = 0; j < row.plots.size(); ++j) {
      const double c_m = (row.plots[j].begin + row.plots[j].end) * cell_m / 2;
      if (j > 0) steps.push_back(c_m - positions.back());
      positions.push_back(c_m);
      lattice.places.push_back({.row = static_cast<int>(i), .r_m = r_m, .c_m = c_m, .full = true});
    }
  }
  lattice.r_pitch_m = usual_step(row_steps);
  lattice.c_pitch_m = usual_step(steps);
  const double pitch_m = lattice.c_pitch_m > 0 ? lattice.c_pitch_m : lattice.c_size_m * 1.2;
  const std::vector<double> columns =
      layout.aligned ? columns_of(positions, pitch_m) : std::vector<double>{};
  lattice.aligned = !columns.empty();
  lattice.rows = static_cast<int>(layout.rows.size());
  if (lattice.aligned) {
    for (Place& place : lattice.places) {
      const auto nearest = std::ranges::min_element(
          columns, {}, [&](double column) { return std::abs(column - place.c_m); });
      place.column = static_cast<int>(nearest - columns.begin());
    }
    lattice.columns = static_cast<int>(columns.size());
    return;
  }
  // Every row by itself, from the place nearest to the first of all plots.
  const double start_m = *std::ranges::min_element(positions);
  std::size_t next = 0;
  for (int row = 0; row < lattice.rows; ++row) {
    const std::size_t first = next;
    while (next < lattice.places.size() && lattice.places[next].row == row) ++next;
    int column = static_cast<int>(std::lround((lattice.places[first].c_m - start_m) / pitch_m));
    for (std::size_t i = first; i < next; ++i) {
      if (i > first) {
        const double step_m = lattice.places[i].c_m - lattice.places[i - 1].c_m;
        column += std::max(1, static_cast<int>(std::lround(step_m / pitch_m)));
      }
      lattice.places[i].column = column;
      lattice.columns = std::max(lattice.columns, column + 1);
    }
  }
}

// Places between a row's plots, in columns that other rows have and, unless their number was told,
// beyond its ends.
void add_places(Lattice& lattice, bool beyond_ends) {
  const double pitch_m = lattice.c_pitch_m;
  if (pitch_m <= 0) return;
  std::vector<Place> added;
  for (int row = 0; row < lattice.rows; ++row) {
    std::vector<Place> present;
    for (const Place& place : lattice.places) {
      if (place.row == row) present.push_back(place);
    }
    if (present.empty()) continue;
    std::ranges::sort(present, {}, &Place::c_m);
    const auto free = [&](double c_m) {
      const auto near = [&](const Place& place) {
        return place.row == row && std::abs(place.c_m - c_m) < lattice.c_size_m;
      };
      return std::ranges::none_of(present, near) && std::ranges::none_of(added, near);
    };
    const auto add = [&](double c_m, int column) {
      if (!free(c_m)) return;
      Place place = present.front();
      place.c_m = c_m;
      place.column = column;
      place.full = false;
      added.push_back(place);
    };
    for (std::size_t i = 1; i < present.size(); ++i) {
      const double gap_m = present[i].c_m - present[i - 1].c_m;
      const int steps = static_cast<int>(std::lround(gap_m / pitch_m));
      for (int k = 1; k < steps; ++k) {
        add(present[i - 1].c_m + gap_m * k / steps, present[i - 1].column + k);
      }
    }
    if (lattice.aligned) {
      for (const Place& other : lattice.places) add(other.c_m, other.column);
    }
    if (!beyond_ends) continue;
    add(present.front().c_m - pitch_m, present.front().column - 1);
    add(present.back().c_m + pitch_m, present.back().column + 1);
  }
  lattice.places.insert(lattice.places.end(), added.begin(), added.end());
}

void test_places(Lattice& lattice) {
  std::vector<double> covers, contrasts;
  for (Place& place : lattice.places) {
    place.share = inner_cover(lattice, place);
    place.contrast = outline_contrast(lattice, place);
    if (!place.full) continue;
    covers.push_back(place.share);
    contrasts.push_back(place.contrast);
  }
  const double full_cover = median(covers);
  lattice.contrast = median(contrasts);
  for (Place& place : lattice.places) {
    place.share /= std::max(1e-6, full_cover);
    place.contrast /= std::max(1e-6, lattice.contrast);
    // A lodged plot leans over its neighbour and shows no edge there, but it is covered.
    place.full = place.share >= kLeastShare &&
                 (place.contrast >= kLeastContrast || place.share >= kWellCovered);
  }
}

void take_fullest(Lattice& lattice, std::size_t plots) {
  std::vector<Place*> places;
  for (Place& place : lattice.places) places.push_back(&place);
  std::ranges::stable_sort(places, std::greater(), &Place::share);
  for (std::size_t i = 0; i < places.size(); ++i) places[i]->full = i < plots;
}

// Lowest column and row become 0, columns without a plot are none.
void renumber(Lattice& lattice) {
  std::erase_if(lattice.places, [](const Place& place) { return !place.full; });
  for (int Place::*index : {&Place::row, &Place::column}) {
    std::vector<int> used;
    for (const Place& place : lattice.places) used.push_back(place.*index);
    std::ranges::sort(used);
    used.erase(std::ranges::unique(used).begin(), used.end());
    for (Place& place : lattice.places) {
      place.*index = static_cast<int>(std::ranges::lower_bound(used, place.*index) - used.begin());
    }
    (index == &Place::row ? lattice.rows : lattice.columns) = static_cast<int>(used.size());
  }
  std::ranges::sort(lattice.places, [](const Place& a, const Place& b) {
    return std::tuple(a.row, a.column, a.c_m) < std::tuple(b.row, b.column, b.c_m);
  });
}

}  // namespace

CellBox cells_about(const Lattice& lattice, double r_m, double c_m, double around_m) {
  const auto at = [&](double m) {
    return static_cast<int>(std::lround(m / lattice.view.cell_m()));
  };
  const double r_half = lattice.r_size_m / 2 + around_m, c_half = lattice.c_size_m / 2 + around_m;
  return {at(r_m - r_half), at(r_m + r_half), at(c_m - c_half), at(c_m + c_half)};
}

Lattice fit_lattice(const Layout& layout, const Hints& hints) {
  Lattice lattice{.view = layout.view,
                  .r_size_m = layout.r_shape.size * layout.view.cell_m(),
                  .c_size_m = layout.c_shape.size * layout.view.cell_m(),
                  .r_band_m = layout.r_shape.size * layout.view.cell_m(),
                  .c_band_m = layout.c_shape.size * layout.view.cell_m()};
  number(lattice, layout);
  straighten(lattice);
  add_places(lattice, !hints.rows && !hints.columns);
  test_places(lattice);
  if (hints.plots) take_fullest(lattice, static_cast<std::size_t>(*hints.plots));
  renumber(lattice);
  straighten(lattice);
  straighten(lattice);
  return lattice;
}

TrialLayout layout_of(const Lattice& lattice) {
  const RowView& view = lattice.view;
  const Eigen::Vector2d along_r = (view.r_axis() + lattice.c_per_r * view.c_axis()).normalized();
  const Eigen::Vector2d along_c = (view.c_axis() + lattice.r_per_c * view.r_axis()).normalized();
  const bool by_c = lattice.c_size_m > lattice.r_size_m;  // the plots' length lies along c
  TrialLayout layout{.origin = view.to_world(0, 0),
                     .row_axis = by_c ? along_r : along_c,
                     .column_axis = by_c ? along_c : along_r,
                     .width_m = std::min(lattice.r_size_m, lattice.c_size_m),
                     .length_m = std::max(lattice.r_size_m, lattice.c_size_m),
                     .column_pitch_m = by_c ? lattice.r_pitch_m : lattice.c_pitch_m,
                     .row_pitch_m = by_c ? lattice.c_pitch_m : lattice.r_pitch_m};
  Eigen::Matrix2d axes;
  axes << layout.row_axis, layout.column_axis;
  const Eigen::Matrix2d layout_from_world = axes.inverse();
  for (const Place& place : lattice.places) {
    layout.places.push_back(
        {.row = (by_c ? place.column : place.row) + 1,
         .column = (by_c ? place.row : place.column) + 1,
         .position_m = layout_from_world * (view.to_world(place.r_m, place.c_m) - layout.origin)});
  }
  return layout;
}

}  // namespace plotscan::plots
