// SPDX-License-Identifier: Apache-2.0
#include "plots/lattice/lattice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include <Eigen/LU>

#include "core/statistics.h"
#include "plots/lattice/internal/field_border.h"
#include "plots/lattice/internal/place_canopy.h"
#include "plots/layout/steps.h"

namespace plotscan::plots {
namespace {

constexpr double kLeastPlaceShare = 0.3;
constexpr double kLeastContrast = 0.25;
constexpr double kWellCovered = 0.6;
constexpr double kLeastShareOfLodged = 0.5, kMostContrastOfLodged = 1.5;
constexpr double kMostLodged = 0.1;  // of the plots
constexpr double kLeastSides = 0.2;  // contrast of the usual plot's sides, of its cover
constexpr double kLeastRise = 0.1;   // of the usual plot: low ones 0.12 and more, missing 0.00,
constexpr double kLeastCoverOfLow = 0.03;  // and so much: where gaps are closed, plots rise little

struct Column {
  double c_m = 0;
  std::size_t plots = 0;
};

// Plots do not overlap. Of two columns closer than a plot's side, the one with fewer plots is
// removed: it is made of plots that lean over or are only partly seen.
void leave_out_overlapping(std::vector<Column>& columns, double size_m) {
  for (std::size_t i = 1; i < columns.size();) {
    if (columns[i].c_m - columns[i - 1].c_m >= size_m) {
      ++i;
    } else {
      const bool first = columns[i - 1].plots < columns[i].plots;
      columns.erase(columns.begin() + static_cast<std::ptrdiff_t>(first ? i - 1 : i));
      i = std::max<std::size_t>(1, i - 1);
    }
  }
}

// The columns that run through all rows: positions that lie together; none where they do not.
std::vector<Column> columns_of(std::vector<double> positions, double pitch_m, double size_m) {
  std::ranges::sort(positions);
  std::vector<Column> columns;
  std::size_t begin = 0;
  for (std::size_t i = 1; i <= positions.size(); ++i) {
    if (i < positions.size() && positions[i] - positions[i - 1] < 0.35 * pitch_m) continue;
    if (positions[i - 1] - positions[begin] > 0.5 * pitch_m) return {};
    columns.push_back({(positions[begin] + positions[i - 1]) / 2, i - begin});
    begin = i;
  }
  leave_out_overlapping(columns, size_m);
  return columns;
}

// The layout's plots as places, not numbered along their rows.
void place_plots(const Layout& layout, Lattice& lattice) {
  const auto middle_m = [&](const Band& band) { return band.middle() * lattice.view.cell_m(); };
  std::vector<double> row_steps, steps;
  for (std::size_t i = 0; i < layout.rows.size(); ++i) {
    const Row& row = layout.rows[i];
    const double r_m = middle_m(row.band);
    if (i > 0) row_steps.push_back(r_m - middle_m(layout.rows[i - 1].band));
    for (std::size_t j = 0; j < row.plots.size(); ++j) {
      const double c_m = middle_m(row.plots[j]);
      if (j > 0) steps.push_back(c_m - middle_m(row.plots[j - 1]));
      lattice.places.push_back({.row = static_cast<int>(i), .r_m = r_m, .c_m = c_m, .full = true});
    }
  }
  lattice.rows = static_cast<int>(layout.rows.size());
  lattice.r.pitch_m = usual_step(row_steps);
  lattice.c.pitch_m = usual_step(steps);
}

// Gives each place the nearest column that runs through all rows. False where two places of a row
// would get the same column.
bool number_columns(const std::vector<Column>& columns, Lattice& lattice) {
  std::set<std::pair<int, int>> taken;
  for (Place& place : lattice.places) {
    const auto nearest = std::ranges::min_element(
        columns, {}, [&](const Column& column) { return std::abs(column.c_m - place.c_m); });
    place.column = static_cast<int>(nearest - columns.begin());
    if (!taken.emplace(place.row, place.column).second) return false;
  }
  lattice.columns = static_cast<int>(columns.size());
  return true;
}

// Numbers each row by itself, from the place nearest to the first of all plots.
void number_each_row(double pitch_m, Lattice& lattice) {
  const double start_m = std::ranges::min(lattice.places, {}, &Place::c_m).c_m;
  const Place* last = nullptr;
  for (Place& place : lattice.places) {
    const bool first = last == nullptr || last->row != place.row;
    const double step_m = place.c_m - (first ? start_m : last->c_m);
    const int steps = static_cast<int>(std::lround(step_m / pitch_m));
    place.column = first ? steps : last->column + std::max(1, steps);
    lattice.columns = std::max(lattice.columns, place.column + 1);
    last = &place;
  }
}

void number(const Layout& layout, Lattice& lattice) {
  place_plots(layout, lattice);
  const double pitch_m = lattice.c.pitch_m > 0 ? lattice.c.pitch_m : lattice.c.size_m * 1.2;
  std::vector<double> positions;
  for (const Place& place : lattice.places) positions.push_back(place.c_m);
  std::vector<Column> columns;
  if (layout.aligned) {
    const double touching_m = lattice.c.size_m - 0.5 * lattice.view.cell_m();  // to whole cells
    columns = columns_of(std::move(positions), pitch_m, touching_m);
  }
  lattice.aligned = !columns.empty() && number_columns(columns, lattice);
  if (!lattice.aligned) number_each_row(pitch_m, lattice);
}

// The places of each row, or of each column.
std::map<int, std::vector<Place>> by_line(const std::vector<Place>& places, int Place::*line) {
  std::map<int, std::vector<Place>> lines;
  for (const Place& place : places) lines[place.*line].push_back(place);
  return lines;
}

const Place& nearest_to(const std::vector<Place>& places, int Place::*number, int at) {
  return *std::ranges::min_element(
      places, {}, [&](const Place& place) { return std::abs(place.*number - at); });
}

// Adds a place where a column crosses a row and no band was seen: a plot may stand there. Columns
// that a row has for itself lie one pitch apart from number to number.
void add_crossings(Lattice& lattice) {
  const auto rows = by_line(lattice.places, &Place::row);
  const auto columns = by_line(lattice.places, &Place::column);
  for (const auto& [row, of_row] : rows) {
    for (const auto& [column, of_column] : columns) {
      const Place& beside = nearest_to(of_row, &Place::column, column);
      if (beside.column == column) continue;
      const double c_m = lattice.aligned
                             ? nearest_to(of_column, &Place::row, row).c_m
                             : beside.c_m + (column - beside.column) * lattice.c.pitch_m;
      lattice.places.push_back({.row = row, .column = column, .r_m = beside.r_m, .c_m = c_m});
    }
  }
}

void test_places(Lattice& lattice) {
  std::vector<double> covers, contrasts;
  for (Place& place : lattice.places) {
    place.share = inner_cover(lattice, place);
    place.contrast = mean_at_gaps(lattice, contrast_of(lattice, place));
    if (!place.full) continue;
    covers.push_back(place.share);
    contrasts.push_back(place.contrast);
  }
  const double full_cover = quantile(covers, 0.5);
  lattice.contrast = quantile(contrasts, 0.5);
  for (Place& place : lattice.places) {
    place.share /= std::max(1e-6, full_cover);
    place.contrast /= std::max(1e-6, lattice.contrast);
    // A lodged plot leans over its neighbour and shows no edge there, but it is covered.
    place.full = place.share >= kLeastPlaceShare &&
                 (place.contrast >= kLeastContrast || place.share >= kWellCovered);
  }
}

// Whether a side shows no edge, of a plot on a row.
bool lacks_edge_across_r(const Lattice& lattice, const Place& place, double usual) {
  return usual >= kLeastUsual &&
         std::ranges::min(r_contrasts_of(lattice, place)) < kLeastContrast * usual;
}

// Canopy that is not of the plots' own crop holds a plot only where that ends on all sides: another
// crop beside the field may end at one side by chance, or at two.
void leave_out_of_others(const CanopyRaster& own, Lattice& lattice) {
  constexpr double kLeastOwn = 0.5;  // of a place's cells
  const Lattice turned = lattice.turned();
  const SideContrast usual = usual_sides(lattice, contrast_of);
  RowView own_view = lattice.view;
  own_view.raster = &own;
  for (std::size_t i = 0; i < lattice.places.size(); ++i) {
    Place& place = lattice.places[i];
    const auto [r0, r1, c0, c1] = cells_about(lattice, place, 0);
    const double seen = lattice.view.seen_cells(r0, r1, c0, c1);
    if (!place.full || own_view.seen_cells(r0, r1, c0, c1) >= kLeastOwn * seen) continue;
    place.full = !lacks_edge_across_r(lattice, place, usual.r) &&
                 !lacks_edge_across_r(turned, turned.places[i], usual.c);
  }
}

// Plots that lean over show their edges beside their place. They are exceptions in a field whose
// plots show theirs in place: elsewhere the lattice does not fit, or is that of other plots, and so
// it is where edges beside a place are clearer than the usual plot's.
void take_lodged_plots(Lattice& lattice) {
  const UsualPlot usual = usual_plot(lattice);
  if (usual.contrast.least() <= kLeastSides * usual.cover) return;
  std::vector<std::pair<Place*, double>> lodged;
  for (Place& place : lattice.places) {
    if (place.share < kLeastShareOfLodged || place.contrast >= kLeastContrast) continue;
    const double contrast = contrast_moved(lattice, place, usual.contrast);
    if (contrast >= kLeastContrast && contrast <= kMostContrastOfLodged)
      lodged.emplace_back(&place, contrast);
  }
  const auto plots = std::ranges::count_if(lattice.places, &Place::full);
  if (static_cast<double>(lodged.size()) > kMostLodged * static_cast<double>(plots)) return;
  for (const auto& [place, contrast] : lodged) {
    place->full = place->lodged = true;
    place->contrast = contrast;
  }
}

// Plots that are much lower than the usual one show little of its canopy, but where every leaf
// counts they stand out from what lies beside them. Nothing stands in most missing plots.
void take_low_plots(const CanopyRaster& low_leaves, Lattice& lattice) {
  Lattice low = lattice;
  low.view.raster = &low_leaves;
  const SideContrast usual = usual_sides(low, rise_of);
  for (Place& place : lattice.places) {
    if (place.full) continue;
    const SideContrast rise = rise_of(low, place);
    place.low = rise.r >= std::max(kLeastCoverOfLow, kLeastRise * usual.r) &&
                rise.c >= std::max(kLeastCoverOfLow, kLeastRise * usual.c);
    if (!place.low) continue;
    place.full = true;
    place.contrast = std::max(place.contrast, rise.mean() / std::max(1e-6, usual.mean()));
  }
}

void take_fullest(Lattice& lattice, std::size_t plots) {
  std::vector<Place*> places;
  for (Place& place : lattice.places) places.push_back(&place);
  std::ranges::stable_sort(places, std::greater(), &Place::share);
  for (std::size_t i = 0; i < places.size(); ++i) places[i]->full = i < plots;
}

// Renumbers from 0 without gaps. Returns the count.
int close_up(std::vector<Place>& places, int Place::*number) {
  std::vector<int> used;
  used.reserve(places.size());
  for (const Place& place : places) used.push_back(place.*number);
  std::ranges::sort(used);
  used.erase(std::unique(used.begin(), used.end()), used.end());
  for (Place& place : places)
    place.*number = static_cast<int>(std::ranges::lower_bound(used, place.*number) - used.begin());
  return static_cast<int>(used.size());
}

// Shifts the numbers to begin at 0. They are steps along a row, so gaps stay. Returns the count.
int begin_at_0(std::vector<Place>& places, int Place::*number) {
  if (places.empty()) return 0;
  const auto [least, most] = std::ranges::minmax(places, {}, number);
  const int first = least.*number, count = most.*number - first + 1;
  for (Place& place : places) place.*number -= first;
  return count;
}

// The usual step from a plot to the next on the same line; the bands' pitch where no two plots
// follow each other.
double usual_pitch_m(const std::vector<TrialPlace>& places, int TrialPlace::*number,
                     int TrialPlace::*line, Eigen::Index axis, double of_bands_m) {
  std::map<std::pair<int, int>, double> position_m;
  for (const TrialPlace& place : places)
    position_m[{place.*line, place.*number}] = place.position_m[axis];
  std::vector<double> steps;
  for (const auto& [at, from_m] : position_m) {
    const auto next = position_m.find({at.first, at.second + 1});
    if (next != position_m.end()) steps.push_back(next->second - from_m);
  }
  return steps.empty() ? of_bands_m : usual_step(std::move(steps));
}

// Renumbers the places that hold a plot. Columns that each row has for itself lie one pitch apart
// from number to number.
void renumber(Lattice& lattice) {
  std::erase_if(lattice.places, [](const Place& place) { return !place.full; });
  lattice.rows = close_up(lattice.places, &Place::row);
  lattice.columns = lattice.aligned ? close_up(lattice.places, &Place::column)
                                    : begin_at_0(lattice.places, &Place::column);
  std::ranges::sort(lattice.places, [](const Place& a, const Place& b) {
    return std::tuple(a.row, a.column, a.c_m) < std::tuple(b.row, b.column, b.c_m);
  });
}

}  // namespace

CellBox cells_about(const Lattice& lattice, const Place& place, double around_m) {
  const auto at = [&](double m) {
    return static_cast<int>(std::lround(m / lattice.view.cell_m()));
  };
  const double r_half = lattice.r.size_m / 2 + around_m, c_half = lattice.c.size_m / 2 + around_m;
  return {at(place.r_m - r_half), at(place.r_m + r_half), at(place.c_m - c_half),
          at(place.c_m + c_half)};
}

Lattice fit_lattice(const Layout& layout, const Hints& hints, const CanopyRaster* low_leaves,
                    const CanopyRaster* own) {
  const double r_m = layout.r_shape.size * layout.view.cell_m();
  const double c_m = layout.c_shape.size * layout.view.cell_m();
  const auto metres = [&](std::optional<double> cells) {
    return cells ? std::optional(*cells * layout.view.cell_m()) : std::nullopt;
  };
  Lattice lattice{.view = layout.view,
                  .r = {.size_m = r_m, .band_m = r_m, .touching_m = metres(layout.r_touching)},
                  .c = {.size_m = c_m, .band_m = c_m, .touching_m = metres(layout.c_touching)}};
  number(layout, lattice);
  straighten(lattice);
  add_crossings(lattice);
  test_places(lattice);
  take_lodged_plots(lattice);
  if (low_leaves != nullptr) take_low_plots(*low_leaves, lattice);
  if (hints.plots) {
    take_fullest(lattice, static_cast<std::size_t>(*hints.plots));
  } else {
    if (own != nullptr) leave_out_of_others(*own, lattice);
    leave_out_strays(lattice);
    leave_out_crop(lattice);
    leave_out_beside(lattice);
    if (!hints.rows && !hints.columns) go_on_beyond(lattice);
    if (own != nullptr) leave_out_of_others(*own, lattice);  // places were added
  }
  renumber(lattice);
  straighten(lattice);
  straighten(lattice);
  return lattice;
}

Lattice Lattice::turned() const {
  Lattice other = *this;
  other.view = view.turned();
  std::swap(other.r, other.c);
  std::swap(other.rows, other.columns);
  std::swap(other.r_per_c, other.c_per_r);
  for (Place& place : other.places) {
    std::swap(place.row, place.column);
    std::swap(place.r_m, place.c_m);
  }
  return other;
}

TrialLayout layout_of(const Lattice& any) {
  const Lattice lattice = any.c.size_m > any.r.size_m ? any.turned() : any;  // length along r
  const RowView& view = lattice.view;
  TrialLayout layout{.origin = view.to_world(0, 0),
                     .row_axis = (view.c_axis() + lattice.r_per_c * view.r_axis()).normalized(),
                     .column_axis = (view.r_axis() + lattice.c_per_r * view.c_axis()).normalized(),
                     .width_m = lattice.c.size_m,
                     .length_m = lattice.r.size_m};
  Eigen::Matrix2d axes;
  axes << layout.row_axis, layout.column_axis;
  const Eigen::Matrix2d layout_from_world = axes.inverse();
  for (const Place& place : lattice.places) {
    layout.places.push_back(
        {.row = place.row + 1,
         .column = place.column + 1,
         .position_m = layout_from_world * (view.to_world(place.r_m, place.c_m) - layout.origin)});
  }
  layout.column_pitch_m =
      usual_pitch_m(layout.places, &TrialPlace::column, &TrialPlace::row, 0, lattice.c.pitch_m);
  layout.row_pitch_m =
      usual_pitch_m(layout.places, &TrialPlace::row, &TrialPlace::column, 1, lattice.r.pitch_m);
  return layout;
}

}  // namespace plotscan::plots
