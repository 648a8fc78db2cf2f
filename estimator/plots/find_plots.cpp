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

namespace plotscan::plots {
namespace {

constexpr double kAxisCell_m = 0.1;  // of the raster on which the heading is sought
constexpr double kCell_m = 0.05;
constexpr int kRounds = 2;  // of size and centres in turn
constexpr double kDegrees = 180 / std::numbers::pi;

Eigen::Vector2d direction(double angle_rad) { return {std::cos(angle_rad), std::sin(angle_rad)}; }
double angle_of(const Eigen::Vector2d& axis) { return std::atan2(axis.y(), axis.x()); }

PlotField nothing(std::string why) { return {.nothing = std::move(why)}; }

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
  plot.confidence = std::clamp(0.5 * (place.share + place.contrast), 0.0, 1.0);
  return plot;
}

double box_heading(const Lattice& lattice) {
  return angle_of(lattice.view.r_axis() + lattice.c_per_r * lattice.view.c_axis());
}

}  // namespace

PlotField find_plots(std::span<const Eigen::Vector3f> points, double noise_m, const Hints& hints,
                     int threads) {
  const double threshold_m = canopy_threshold(points, noise_m);
  const CanopyRaster coarse = rasterise(points, {}, kAxisCell_m, threshold_m, threads);
  const FieldAxes axes = find_axes(coarse, hints.heading_rad, threads);
  const Frame frame{.a_axis = direction(axes.first_rad), .b_axis = direction(axes.second_rad)};
  const CanopyRaster raster = rasterise(points, frame, kCell_m, threshold_m, threads);
  const Layout layout = best_layout(raster);
  if (layout.rows.empty()) return nothing("no plots of one size lie in rows here");
  Lattice lattice = fit_lattice(layout);
  if (lattice.places.size() < 2) return nothing("a single plot is no lattice");
  for (int round = 0; round < kRounds; ++round) {
    fit_edges(lattice);
    straighten(lattice);
  }
  fit_edges(lattice);
  PlotField field;
  const double heading_rad = box_heading(lattice);
  for (const Place& place : lattice.places) {
    field.plots.push_back(found_plot(lattice, place, heading_rad));
  }
  field.fit = {{"first_deg", axes.first_rad * kDegrees},
               {"second_deg", axes.second_rad * kDegrees},
               {"sharpness", axes.sharpness},
               {"canopy_threshold_m", threshold_m},
               {"layout_r", layout.r_size * kCell_m},
               {"layout_c", layout.c_size * kCell_m},
               {"swapped", layout.view.swapped},
               {"aligned", lattice.aligned},
               {"r_pitch_m", lattice.r_pitch_m},
               {"c_pitch_m", lattice.c_pitch_m},
               {"r_rms_m", lattice.r_rms_m},
               {"c_rms_m", lattice.c_rms_m},
               {"r_blur_m", lattice.r_blur_m},
               {"c_blur_m", lattice.c_blur_m},
               {"contrast", lattice.contrast},
               {"rows", lattice.rows},
               {"columns", lattice.columns}};
  return field;
}

}  // namespace plotscan::plots
