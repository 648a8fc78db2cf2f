// SPDX-License-Identifier: Apache-2.0
#include "plots/search.h"

#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "plots/stripes.h"

namespace plotscan::plots {
namespace {

constexpr double kClearQuality = 0.6;       // of a layout that is taken as it is,
constexpr double kClearSides = 0.65;        // or the clarity of its sides
constexpr double kDenseCover = 0.5;         // of plots, above the canopy's threshold
constexpr double kThresholds[] = {2, 2.8};  // times the canopy's threshold
constexpr double kClosings_m[] = {0.2, 0.3, 0.45, 0.6, 0.8};  // widths of gaps that are closed

// What to look at: along which axes, above which height, with gaps of which width closed.
struct Look {
  double first_rad = 0;
  double second_rad = 0;
  double threshold_m = 0;
  double closing_m = 0;
};

Eigen::Vector2d direction(double angle_rad) { return {std::cos(angle_rad), std::sin(angle_rad)}; }

// 1 and more: clear.
double clearness(const Layout& layout) {
  return std::max(layout.quality / kClearQuality, layout.clarity / kClearSides);
}

bool is_clear(const Layout& layout) { return clearness(layout) >= 1 && !has_stripes(layout); }

class Search {
 public:
  Search(std::span<const Eigen::Vector3f> points, double cell_m, const KnownSides& known,
         int threads)
      : points_(points), cell_m_(cell_m), known_(known), threads_(threads) {}

  // Whether there is no need to look further.
  bool look(const Look& look) {
    const Frame frame{.a_axis = direction(look.first_rad), .b_axis = direction(look.second_rad)};
    Sighting seen;
    CanopyRaster raster = rasterise(points_, frame, cell_m_, look.threshold_m, threads_);
    if (look.closing_m > 0) raster = raster.closed(look.closing_m);
    seen.raster = std::make_unique<const CanopyRaster>(std::move(raster));
    seen.layout = best_layout(*seen.raster, known_);
    if (!best_.raster || is_better(seen.layout)) {
      if (best_.raster && has_stripes(best_.layout)) keep_stripes();
      best_ = std::move(seen);
      best_look_ = look;
    }
    return is_clear(best_.layout) && stripes_.rows.empty();
  }

  // Whether the best layout's plots were drill rows, and are plots now.
  bool put_drill_rows_together() {
    if (!has_stripes(best_.layout)) return false;
    std::optional<DrilledLayout> drilled = plots_of_stripes(best_.layout);
    if (!drilled) return false;
    const double length_m = drilled->layout.r_size * cell_m_;
    if (known_.width_m && !is_side(drilled->sown_width_m, known_.width_m)) return false;
    if (known_.length_m && !is_side(length_m, known_.length_m)) return false;
    constexpr double kMore_m = 0.1;
    best_.raster =
        std::make_unique<const CanopyRaster>(best_.raster->closed(drilled->gap_m + kMore_m));
    best_.layout = std::move(drilled->layout);
    best_.layout.view.raster = best_.raster.get();
    best_.sown_width_m = drilled->sown_width_m;
    return true;
  }

  bool is_dense() const { return best_.layout.cover > kDenseCover && !has_stripes(best_.layout); }
  const Look& best_look() const { return best_look_; }
  Sighting take() { return std::move(best_); }

 private:
  // Stripes may be the drill rows of a plot: what holds as many of them in each is better.
  bool is_better(const Layout& layout) const {
    const Layout& best = best_.layout;
    if (has_stripes(best)) return is_clear(layout) && are_stripes_of(best, layout);
    if (!stripes_.rows.empty() && !are_stripes_of(stripes_, layout)) return false;
    return !has_stripes(layout) && clearness(layout) > clearness(best);
  }

  // What shows as pairs of rows with narrow gaps closed may be plots of four with wider ones.
  void keep_stripes() {
    stripes_ = best_.layout;
    stripes_raster_ = std::move(best_.raster);
  }

  std::span<const Eigen::Vector3f> points_;
  double cell_m_;
  KnownSides known_;
  int threads_;
  Layout stripes_;  // the drill rows that the best layout's plots are made of
  std::unique_ptr<const CanopyRaster> stripes_raster_;
  Sighting best_;
  Look best_look_;
};

bool look_along_perpendicular_axes(Search& search, const FieldAxes& axes, const Look& first) {
  constexpr double kRight = std::numbers::pi / 2;
  if (std::abs(axes.second_rad - axes.first_rad - kRight) < 1e-3) return false;
  for (const double along : {axes.first_rad, axes.second_rad - kRight}) {
    Look look = first;
    look.first_rad = along;
    look.second_rad = along + kRight;
    if (search.look(look)) return true;
  }
  return false;
}

bool look_higher(Search& search) {
  const Look first = search.best_look();
  for (const double times : kThresholds) {
    Look look = first;
    look.threshold_m *= times;
    if (search.look(look)) return true;
  }
  return false;
}

// Not where canopy is dense: there a gap parts two plots.
void look_with_gaps_closed(Search& search) {
  if (search.is_dense()) return;
  const Look first = search.best_look();
  for (const double closing_m : kClosings_m) {
    Look look = first;
    look.closing_m = closing_m;
    if (search.look(look)) return;
  }
}

}  // namespace

Sighting find_layout(std::span<const Eigen::Vector3f> points, const FieldAxes& axes,
                     double threshold_m, double cell_m, const KnownSides& known, int threads) {
  Search search(points, cell_m, known, threads);
  const Look first{axes.first_rad, axes.second_rad, threshold_m, 0};
  if (search.look(first) || search.put_drill_rows_together()) return search.take();
  if (look_along_perpendicular_axes(search, axes, first) || look_higher(search)) {
    return search.take();
  }
  look_with_gaps_closed(search);
  return search.take();
}

}  // namespace plotscan::plots
