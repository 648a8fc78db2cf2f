// SPDX-License-Identifier: Apache-2.0
#include "plots/find_plots.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "plots/canopy_raster.h"
#include "plots/heading.h"
#include "plots/lattice.h"
#include "plots/layout.h"
#include "plots/outline.h"
#include "plots/search.h"

namespace plotscan::plots {
namespace {

constexpr double kAxisCell_m = 0.1;  // of the raster on which the heading is sought
constexpr double kCell_m = 0.05;
constexpr double kLeastContrast = 0.03;  // of the plots' sides: noise over bare ground shows less
constexpr double kLeastQuality = 0.3;    // of a layout's edges: random bushes reach less
constexpr std::size_t kLeastPlots = 4;   // fewer lie at equal steps by chance
constexpr double kLeastFilled = 0.4;     // of the lattice's places: random bushes fill fewer
constexpr int kRounds = 2;               // of size and centres in turn
constexpr double kDegrees = 180 / std::numbers::pi;

double angle_of(const Eigen::Vector2d& axis) { return std::atan2(axis.y(), axis.x()); }

PlotField nothing(std::string why) { return {.nothing = std::move(why)}; }

double filled_share(const Lattice& lattice) {
  return static_cast<double>(lattice.places.size()) /
         std::max(1.0, static_cast<double>(lattice.rows) * lattice.columns);
}

// Whether the ground beyond one of a plot's sides was not scanned.
bool is_cut_off(const Lattice& lattice, const Place& place) {
  constexpr double kBeyond_m = 0.3, kLeastShare = 0.25;
  const double cell_m = lattice.view.cell_m();
  const auto at = [&](double m) { return static_cast<int>(std::lround(m / cell_m)); };
  const int r0 = at(place.r_m - lattice.r_size_m / 2), r1 = at(place.r_m + lattice.r_size_m / 2);
  const int c0 = at(place.c_m - lattice.c_size_m / 2), c1 = at(place.c_m + lattice.c_size_m / 2);
  const int beyond = at(kBeyond_m);
  const auto share = [&](int ra, int rb, int ca, int cb) {
    return lattice.view.seen_cells(ra, rb, ca, cb) / std::max(1.0, 1.0 * (rb - ra) * (cb - ca));
  };
  const double least = kLeastShare * share(r0, r1, c0, c1);
  return share(r0 - beyond, r0, c0, c1) < least || share(r1, r1 + beyond, c0, c1) < least ||
         share(r0, r1, c0 - beyond, c0) < least || share(r0, r1, c1, c1 + beyond) < least;
}

FoundPlot found_plot(const Lattice& lattice, const Place& place, double r_heading_rad) {
  FoundPlot plot{.row = place.row + 1, .column = place.column + 1};
  plot.box.center = lattice.view.to_world(place.r_m, place.c_m);
  plot.box.length_m = lattice.r_size_m;
  plot.box.width_m = lattice.c_size_m;
  plot.box.heading_rad = r_heading_rad;
  if (lattice.c_size_m > lattice.r_size_m) {
    std::swap(plot.row, plot.column);
    std::swap(plot.box.width_m, plot.box.length_m);
    plot.box.heading_rad += std::numbers::pi / 2;
  }
  plot.box.heading_rad = wrap_heading(plot.box.heading_rad);
  plot.cut_off = is_cut_off(lattice, place);
  plot.confidence = std::clamp(0.5 * (place.share + place.contrast), 0.0, 1.0);
  return plot;
}

double box_heading(const Lattice& lattice) {
  return angle_of(lattice.view.r_axis() + lattice.c_per_r * lattice.view.c_axis());
}

nlohmann::json fit_of(const Lattice& lattice, const Layout& layout, const PlotField& field) {
  const bool turned = lattice.c_size_m > lattice.r_size_m;  // the length lies along c
  const auto pick = [&](double along_length, double along_width) {
    return turned ? along_width : along_length;
  };
  const Eigen::Vector2d row_axis = lattice.view.c_axis() + lattice.r_per_c * lattice.view.r_axis();
  const Eigen::Vector2d column_axis =
      lattice.view.r_axis() + lattice.c_per_r * lattice.view.c_axis();
  const PlotBox& box = field.plots.front().box;
  const double skew_rad = std::remainder(
      angle_of(row_axis) - angle_of(column_axis) - std::numbers::pi / 2, std::numbers::pi);
  return {{"heading_deg", box.heading_rad * kDegrees},
          {"second_axis_deg", wrap_heading(angle_of(turned ? column_axis : row_axis)) * kDegrees},
          {"skew_deg", skew_rad * kDegrees},
          {"width_m", box.width_m},
          {"length_m", box.length_m},
          {"rows", turned ? lattice.columns : lattice.rows},
          {"columns", turned ? lattice.rows : lattice.columns},
          {"row_pitch_m", pick(lattice.r_pitch_m, lattice.c_pitch_m)},
          {"column_pitch_m", pick(lattice.c_pitch_m, lattice.r_pitch_m)},
          {"columns_aligned", lattice.aligned},
          {"rms_along_length_m", pick(lattice.r_rms_m, lattice.c_rms_m)},
          {"rms_along_width_m", pick(lattice.c_rms_m, lattice.r_rms_m)},
          {"leaf_spread_m", std::max(lattice.r_blur_m, lattice.c_blur_m)},
          {"side_contrast", lattice.contrast},
          {"lattice_quality", layout.quality},
          {"least_quality", kLeastQuality}};
}

}  // namespace

PlotField find_plots(std::span<const Eigen::Vector3f> points, double noise_m, const Hints& hints,
                     int threads) {
  const double threshold_m = canopy_threshold(points, noise_m);
  const CanopyRaster coarse = rasterise(points, {}, kAxisCell_m, threshold_m, threads);
  const FieldAxes axes = find_axes(coarse, hints.heading_rad, threads);
  const Sighting sighting =
      find_layout(points, axes, threshold_m, kCell_m, {hints.width_m, hints.length_m}, threads);
  const Layout& layout = sighting.layout;
  if (layout.rows.empty()) return nothing("no plots of one size lie in rows here");
  if (layout.quality < kLeastQuality) {
    return nothing("canopy lies here, but not in plots of one size at equal steps");
  }
  Lattice lattice = fit_lattice(layout);
  if (lattice.places.size() < 2)
    return nothing("a single plot, or one field closed by canopy, is no lattice");
  if (lattice.contrast < kLeastContrast)
    return nothing("no canopy stands out from the ground here");
  if (lattice.places.size() < kLeastPlots) {
    return nothing(
        "fewer than 4 plots, or pieces of one, are no lattice; given boxes can be measured");
  }
  if (filled_share(lattice) < kLeastFilled) {
    return nothing("canopy lies here, but on too few places of any lattice");
  }
  for (int round = 0; round < kRounds; ++round) {
    fit_edges(lattice);
    straighten(lattice);
  }
  fit_edges(lattice);
  if (sighting.sown_width_m > 0) lattice.c_size_m = sighting.sown_width_m;
  PlotField field;
  const double heading_rad = box_heading(lattice);
  for (const Place& place : lattice.places) {
    field.plots.push_back(found_plot(lattice, place, heading_rad));
  }
  field.fit = fit_of(lattice, layout, field);
  field.fit["canopy_threshold_m"] = threshold_m;
  field.fit["axes_sharpness"] = axes.sharpness;
  return field;
}

}  // namespace plotscan::plots
