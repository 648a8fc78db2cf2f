// SPDX-License-Identifier: Apache-2.0
#include "plots/find_plots.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include <tbb/task_arena.h>

#include "plots/canopy_raster.h"
#include "plots/field_signs.h"
#include "plots/heading.h"
#include "plots/lattice.h"
#include "plots/layout.h"
#include "plots/outline.h"

namespace plotscan::plots {
namespace {

constexpr double kAxisCell_m = 0.1;  // of the raster on which the heading is sought
constexpr double kCell_m = 0.05;
constexpr double kLeastLeaves_m = 0.12;  // lower are weeds and clods
constexpr double kStep_m = 1e-3;         // from no leaves to leaves

constexpr int kRounds = 2;  // of size and centres in turn
constexpr double kDegrees = 180 / std::numbers::pi;

double angle_of(const Eigen::Vector2d& axis) { return std::atan2(axis.y(), axis.x()); }

PlotField nothing(std::string why) { return {.nothing = std::move(why)}; }

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

FoundPlot found_plot(const Lattice& lattice, const Place& place, double r_heading_rad,
                     double field_confidence) {
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
  plot.confidence = field_confidence * std::clamp(0.5 * (place.share + place.contrast), 0.0, 1.0);
  return plot;
}

double box_heading(const Lattice& lattice) {
  return angle_of(lattice.view.r_axis() + lattice.c_per_r * lattice.view.c_axis());
}

nlohmann::json fit_of(const Lattice& lattice, const PlotField& field) {
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
          {"side_contrast", lattice.contrast}};
}

Frame frame_of(const FieldAxes& axes) {
  return {.a_axis = {std::cos(axes.first_rad), std::sin(axes.first_rad)},
          .b_axis = {std::cos(axes.second_rad), std::sin(axes.second_rad)}};
}

// Sizes that the user gave are the sizes; the length is the longer one.
void take_given_sides(Lattice& lattice, const Hints& hints) {
  const bool along_r = lattice.r_size_m >= lattice.c_size_m;
  double& length_m = along_r ? lattice.r_size_m : lattice.c_size_m;
  double& width_m = along_r ? lattice.c_size_m : lattice.r_size_m;
  length_m = hints.length_m.value_or(length_m);
  width_m = hints.width_m.value_or(width_m);
}

// Sizes and places in turn.
void refine(Lattice& lattice, const Layout& layout, const Hints& hints) {
  for (int round = 0; round < kRounds; ++round) {
    fit_edges(lattice);
    straighten(lattice);
  }
  fit_edges(lattice);
  // Leaves say little of the sown width of few drill rows: rows times spacing does.
  if (layout.r_drilled) lattice.r_size_m = lattice.r_band_m;
  if (layout.c_drilled) lattice.c_size_m = lattice.c_band_m;
  take_given_sides(lattice, hints);
}

PlotField plots_on(const Lattice& lattice, double confidence) {
  PlotField field;
  const double heading_rad = box_heading(lattice);
  for (const Place& place : lattice.places)
    field.plots.push_back(found_plot(lattice, place, heading_rad, confidence));
  return field;
}

nlohmann::json json_of(const FieldSigns& signs) {
  return {{"held_share", signs.held_share},
          {"filled_share", signs.filled_share},
          {"surface_share", signs.surface_share},
          {"squareness", signs.squareness},
          {"aspect", signs.aspect},
          {"unevenness", signs.unevenness},
          {"evidence_per_plot", signs.evidence}};
}

// What a pair of axes shows.
struct Look {
  PlotField field;
  double evidence = 0;  // of its plots; 0 where there are none
};

Look look_along(const FieldAxes& axes, const FieldCanopy& field, double noise_m, const Hints& hints,
                int threads) {
  const Frame frame = frame_of(axes);
  const double leaves_m = std::max({kLeastLeaves_m, 4 * noise_m, 0.25 * field.scale().high_m});
  const std::array scales = {field.scale(), CanopyScale{leaves_m, leaves_m + kStep_m}};
  const std::vector<CanopyRaster> rasters = rasterise(field, frame, kCell_m, scales, threads);
  const CanopyRaster &canopy = rasters[0], &cover = rasters[1];
  tbb::task_arena arena(threads);
  Layout layout;
  arena.execute([&] { layout = best_layout(canopy, hints); });
  if (layout.rows.empty()) {
    return {nothing(hints.tell_layout() ? "no plots as told lie in rows here"
                                        : "no plots of one size lie in rows here")};
  }

  layout.view.raster = &cover;
  Lattice lattice = fit_lattice(layout, hints);
  if (lattice.places.empty()) return {nothing("no plots of one size lie in rows here")};
  refine(lattice, layout, hints);
  lattice.view.raster = &canopy;
  const FieldSigns signs = signs_of(lattice, field, layout.evidence);
  lattice.view.raster = &cover;
  const std::string because = hints.tell_layout() ? "" : no_plots_because(signs);
  Look look{because.empty() ? plots_on(lattice, field_confidence(signs)) : nothing(because)};
  if (because.empty()) {
    look.evidence = layout.evidence;
    look.field.fit = fit_of(lattice, look.field);
  }
  look.field.fit["signs"] = json_of(signs);
  return look;
}

}  // namespace

PlotField find_plots(std::span<const Eigen::Vector3f> points, double noise_m, const Hints& hints,
                     int threads) {
  const FieldCanopy field(points, noise_m, threads);
  const CanopyRaster coarse =
      rasterise(field, {}, kAxisCell_m, {&field.scale(), 1}, threads).front();
  Look best{nothing("no canopy stands out from the ground here")};
  bool first = true;
  for (const FieldAxes& axes : find_axes(coarse, hints.heading_rad, threads)) {
    Look look = look_along(axes, field, noise_m, hints, threads);
    if (first || look.evidence > best.evidence) best = std::move(look);
    first = false;
  }
  return std::move(best.field);
}

}  // namespace plotscan::plots
