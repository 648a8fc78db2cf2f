// SPDX-License-Identifier: Apache-2.0
#include "plots/lattice/internal/field_border.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "core/statistics.h"
#include "plots/lattice/internal/place_canopy.h"

namespace plotscan::plots {
namespace {

// Lodged plots at a field's border: 0.3 and more. What else stands there at the plots' steps has
// the edges of plots by chance only.
constexpr double kLeastBorderContrast = 0.25;
constexpr double kLeastBorderCover = 0.5;    // of the usual plot, where a lodged one stands
constexpr double kFewOfLine = 0.5;           // a border line with no more of the usual one's plots
constexpr double kLeastContrastOfFew = 0.5;  // must show them clearly

// The plots that show their edges.
class ClearPlots {
 public:
  explicit ClearPlots(const std::vector<Place>& places) {
    for (const Place& place : places)
      if (place.full && place.contrast >= kLeastBorderContrast)
        at_.emplace(place.row, place.column);
  }
  // On either side; the nearest place but one counts too, as two neighbours may be out of line.
  bool stand_beside_in_row(const Place& place) const {
    return stands_along(place, 0, -1) && stands_along(place, 0, 1);
  }
  bool stand_beside_in_column(const Place& place) const {
    return stands_along(place, -1, 0) && stands_along(place, 1, 0);
  }

 private:
  bool stands_along(const Place& place, int rows, int columns) const {
    return at_.contains({place.row + rows, place.column + columns}) ||
           at_.contains({place.row + 2 * rows, place.column + 2 * columns});
  }

  std::set<std::pair<int, int>> at_;
};

// The plots on a row or on a column.
struct PlotsOnLine {
  int first = 0, last = 0;  // numbers along the line
  double plots = 0;
};

class LinesOfPlots {
 public:
  LinesOfPlots(const std::vector<Place>& places, int Place::*line, int Place::*along)
      : line_(line), along_(along) {
    for (const Place& place : places) {
      if (!place.full) continue;
      const PlotsOnLine alone{.first = place.*along, .last = place.*along};
      PlotsOnLine& of = lines_.try_emplace(place.*line, alone).first->second;
      of.first = std::min(of.first, place.*along);
      of.last = std::max(of.last, place.*along);
      ++of.plots;
    }
    std::vector<double> counts;
    for (const auto& [number, of] : lines_) counts.push_back(of.plots);
    usual_ = quantile(std::move(counts), 0.5);
  }

  double usual() const { return usual_; }  // number of plots of a line
  // Whether a plot is the first or the last of its line.
  bool ends_with(const Place& place) const {
    const PlotsOnLine& of = lines_.at(place.*line_);
    return place.*along_ == of.first || place.*along_ == of.last;
  }
  // Whether its line is the first or the last, and has few plots.
  bool few_at_border(const Place& place) const {
    const bool border =
        place.*line_ == lines_.begin()->first || place.*line_ == lines_.rbegin()->first;
    return border && lines_.at(place.*line_).plots <= kFewOfLine * usual_;
  }

 private:
  int Place::*line_;
  int Place::*along_;
  std::map<int, PlotsOnLine> lines_;
  double usual_ = 0;
};

// Whether a place beyond the border is covered as plots are, and has their edges on all sides: a
// hedge has them on two, another crop on one.
bool shows_a_plot(const Lattice& lattice, const UsualPlot& usual, Place& place) {
  const SideContrast contrast = contrast_of(lattice, place);
  place.share = inner_cover(lattice, place) / std::max(1e-6, usual.cover);
  place.contrast =
      mean_at_gaps(lattice, contrast) / std::max(1e-6, mean_at_gaps(lattice, usual.contrast));
  return place.share >= kLeastBorderCover &&
         contrast.r >= kLeastBorderContrast * usual.contrast.r &&
         contrast.c >= kLeastBorderContrast * usual.contrast.c;
}

// Takes covered places with a clear plot on either side for plots: lodged ones lean over their
// edges.
void fill_between(std::vector<Place>& row) {
  const ClearPlots clear(row);
  for (Place& place : row)
    place.full =
        place.full || (place.share >= kLeastBorderCover && clear.stand_beside_in_row(place));
}

// In a row of plots, giants close the gaps between them along one axis: the mean of both tells.
void take_covered(std::vector<Place>& row) {
  for (Place& place : row)
    place.full =
        place.full || (place.share >= kLeastBorderCover && place.contrast >= kLeastBorderContrast);
}

// The number of the first or the last row that has a plot.
int outer_row(const std::vector<Place>& places, bool last) {
  const auto outwards = [&](const Place& place) {
    return std::pair(place.full, last ? place.row : -place.row);
  };
  return std::ranges::max(places, {}, outwards).row;
}

// The plots of the row before the first one or after the last one.
std::vector<Place> row_beyond(const Lattice& lattice, const UsualPlot& usual, double usual_plots,
                              bool after) {
  const int step = after ? 1 : -1;
  const int outer = outer_row(lattice.places, after);
  std::vector<Place> row;
  for (const Place& place : lattice.places) {
    if (place.row != outer) continue;
    Place beyond = place;
    beyond.row += step;
    beyond.r_m += step * lattice.r.pitch_m;
    beyond.c_m += step * lattice.r.pitch_m * lattice.c_per_r;
    beyond.full = shows_a_plot(lattice, usual, beyond);
    row.push_back(beyond);
  }
  fill_between(row);
  if (std::ranges::count_if(row, &Place::full) <= kFewOfLine * usual_plots) return {};
  take_covered(row);
  return row;
}

void add_rows_beyond(Lattice& lattice) {
  if (lattice.r.pitch_m < lattice.r.size_m) return;  // one row, or rows that overlap
  const UsualPlot usual = usual_plot(lattice);
  const double usual_plots = LinesOfPlots(lattice.places, &Place::row, &Place::column).usual();
  for (const bool after : {false, true}) {
    for (std::vector<Place> row = row_beyond(lattice, usual, usual_plots, after); !row.empty();
         row = row_beyond(lattice, usual, usual_plots, after))
      lattice.places.insert(lattice.places.end(), row.begin(), row.end());
  }
}

// The plots of the first or the last row that has some.
std::vector<Place*> plots_of_outer_row(std::vector<Place>& places, bool last) {
  const int outer = outer_row(places, last);
  std::vector<Place*> row;
  for (Place& place : places)
    if (place.full && place.row == outer) row.push_back(&place);
  return row;
}

// Whether a row is cut out of a crop without plots: canopy goes on beyond its outer side and from
// plot to plot.
bool is_of_crop(const Lattice& lattice, const SideContrast& usual, const std::vector<Place*>& row,
                bool last) {
  std::vector<double> outer, between;
  for (const Place* place : row) {
    outer.push_back(r_contrasts_of(lattice, *place)[last ? 1 : 0]);
    between.push_back(contrast_of(lattice, *place).c);
  }
  return mean(outer) < kLeastBorderContrast * usual.r &&
         mean(between) < kLeastBorderContrast * usual.c;
}

void leave_out_rows_of_crop(Lattice& lattice) {
  const SideContrast usual = usual_sides(lattice, contrast_of);
  if (usual.least() < kLeastUsual) return;
  for (const bool last : {false, true}) {
    const auto all = std::ranges::count_if(lattice.places, &Place::full);
    for (std::vector<Place*> row = plots_of_outer_row(lattice.places, last);
         std::ssize(row) < all && is_of_crop(lattice, usual, row, last);
         row = plots_of_outer_row(lattice.places, last))
      for (Place* place : row) place->full = false;
  }
}

// The places that hold a plot, in groups: three pitches and more lie between two of them.
std::vector<std::vector<Place*>> plots_in_groups(Lattice& lattice) {
  constexpr double kPitches = 3;
  const double most_m = std::max(lattice.r.pitch_m, lattice.c.pitch_m);
  const auto pitch_m = [&](const Side& side) { return side.pitch_m > 0 ? side.pitch_m : most_m; };
  const auto are_near = [&](const Place& a, const Place& b) {
    return std::hypot((a.r_m - b.r_m) / pitch_m(lattice.r), (a.c_m - b.c_m) / pitch_m(lattice.c)) <
           kPitches;
  };
  std::vector<Place*> left;
  for (Place& place : lattice.places)
    if (place.full) left.push_back(&place);
  std::vector<std::vector<Place*>> groups;
  while (!left.empty()) {
    std::vector<Place*> group = {left.back()};
    left.pop_back();
    for (std::size_t i = 0; i < group.size(); ++i) {
      const auto is_far = [&](const Place* other) { return !are_near(*group[i], *other); };
      const auto near = std::partition(left.begin(), left.end(), is_far);
      group.insert(group.end(), near, left.end());
      left.erase(near, left.end());
    }
    groups.push_back(std::move(group));
  }
  return groups;
}

// What is done to rows, and then to columns, of fields in common rows and columns.
void on_rows_and_columns(Lattice& lattice, void (*on_rows)(Lattice&)) {
  if (!lattice.aligned || std::ranges::none_of(lattice.places, &Place::full)) return;
  on_rows(lattice);
  lattice = lattice.turned();
  on_rows(lattice);
  lattice = lattice.turned();
}

}  // namespace

void leave_out_strays(Lattice& lattice) {
  constexpr std::size_t kLeastPlots = 4;
  const std::vector<std::vector<Place*>> groups = plots_in_groups(lattice);
  const auto is_small = [](const auto& group) { return group.size() < kLeastPlots; };
  if (std::ranges::all_of(groups, is_small)) return;
  for (const std::vector<Place*>& group : groups)
    if (is_small(group))
      for (Place* place : group) place->full = false;
}

void leave_out_crop(Lattice& lattice) { on_rows_and_columns(lattice, leave_out_rows_of_crop); }

void leave_out_beside(Lattice& lattice) {
  std::vector<Place*> beside;
  do {
    const LinesOfPlots rows(lattice.places, &Place::row, &Place::column);
    const LinesOfPlots columns(lattice.places, &Place::column, &Place::row);
    const ClearPlots clear(lattice.places);
    const auto is_between = [&](const Place& place) {
      return place.share >= kLeastBorderCover &&
             (clear.stand_beside_in_row(place) ||
              (lattice.aligned && clear.stand_beside_in_column(place)));
    };
    const auto least_contrast = [&](const Place& place) {
      const bool few =
          rows.few_at_border(place) || (lattice.aligned && columns.few_at_border(place));
      const bool border = rows.ends_with(place) || (lattice.aligned && columns.ends_with(place));
      if (few) return kLeastContrastOfFew;
      return border && !place.low && !is_between(place) ? kLeastBorderContrast : 0.0;
    };
    beside.clear();
    for (Place& place : lattice.places)
      if (place.full && least_contrast(place) > std::max(0.0, place.contrast))
        beside.push_back(&place);
    for (Place* place : beside) place->full = false;
  } while (!beside.empty());
}

void go_on_beyond(Lattice& lattice) { on_rows_and_columns(lattice, add_rows_beyond); }

}  // namespace plotscan::plots
