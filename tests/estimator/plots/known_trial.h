// SPDX-License-Identifier: Apache-2.0
#pragma once

// Trials whose layout and canopy are known, for the tests of the steps that find plots.

#include <cmath>
#include <numbers>
#include <vector>

#include "core/trial_layout.h"
#include "plots/lattice/lattice.h"

namespace plotscan::plots {

// A raster of a_m x b_m metres whose cells are all seen, with the share of full canopy that
// `canopy` gives at (a, b), metres.
template <class Canopy>
CanopyRaster raster_of(double a_m, double b_m, const Canopy& canopy, double cell_m = 0.05) {
  const int a_cells = static_cast<int>(std::lround(a_m / cell_m));
  const int b_cells = static_cast<int>(std::lround(b_m / cell_m));
  std::vector<std::uint32_t> cover;
  for (int a = 0; a < a_cells; ++a) {
    for (int b = 0; b < b_cells; ++b) {
      const double share = canopy((a + 0.5) * cell_m, (b + 0.5) * cell_m);
      cover.push_back(static_cast<std::uint32_t>(std::lround(kFullCover * share)));
    }
  }
  return {{}, cell_m, a_cells, b_cells, cover};
}

// Rows of plots of 3 x 1.5 m follow each other along x, columns along y; the first plot's centre
// lies at (3, 2). Row i moves by offsets_m[i] along y.
inline TrialLayout known_trial(const std::vector<double>& offsets_m, int columns = 5) {
  TrialLayout trial{.row_axis = Eigen::Vector2d::UnitY(),
                    .column_axis = Eigen::Vector2d::UnitX(),
                    .width_m = 1.5,
                    .length_m = 3,
                    .column_pitch_m = 1.9,
                    .row_pitch_m = 3.8};
  for (int row = 0; row < static_cast<int>(offsets_m.size()); ++row) {
    for (int column = 0; column < columns; ++column) {
      const double offset_m = offsets_m[static_cast<std::size_t>(row)];
      trial.places.push_back({.row = row + 1,
                              .column = column + 1,
                              .position_m = {2 + column * trial.column_pitch_m + offset_m,
                                             3 + row * trial.row_pitch_m}});
    }
  }
  return trial;
}

// A box of height 1 about 0, blurred by a normal kernel, in closed form.
inline double blurred_box(double x_m, double size_m, double blur_m) {
  const double scale = 1 / (blur_m * std::numbers::sqrt2);
  return 0.5 * (std::erf((x_m + size_m / 2) * scale) - std::erf((x_m - size_m / 2) * scale));
}

// What the optical depths that `depth_at(off)` gives at a place from a plot's centre, along its
// length and its width, add up to: Beer-Lambert.
template <class Depth>
CanopyRaster canopy_in_plots(const TrialLayout& trial, const Depth& depth_at) {
  const Eigen::Vector2d far = trial.box(trial.places.back()).center;
  return raster_of(far.x() + 3, far.y() + 2.5, [&](double x, double y) {
    double depth = 0;
    for (const TrialPlace& place : trial.places)
      depth += depth_at(Eigen::Vector2d(trial.box(place).box_from_world({x, y})));
    return 1 - std::exp(-depth);
  });
}

// Canopies of the given optical depth in the trial's plots, blurred over their edges.
inline CanopyRaster canopy_of(const TrialLayout& trial, double depth = 1.5, double blur_m = 0.08) {
  return canopy_in_plots(trial, [&](const Eigen::Vector2d& off) {
    if (std::abs(off.x()) > 2.5 || std::abs(off.y()) > 1.75) return 0.0;
    return depth * blurred_box(off.x(), trial.length_m, blur_m) *
           blurred_box(off.y(), trial.width_m, blur_m);
  });
}

// Stems near their row and blades farther off, of an optical depth that adds up between rows.
inline double leaves(double off_m, double stems_m, double blades_m) {
  return 1.2 * std::exp(-0.5 * std::pow(off_m / stems_m, 2)) +
         0.8 * std::exp(-0.5 * std::pow(off_m / blades_m, 2));
}

// The trial's plots sown in rows along their length, evenly spaced across the width.
inline CanopyRaster sown_canopy(const TrialLayout& trial, int rows, double stems_m,
                                double blades_m) {
  const double spacing_m = trial.width_m / rows;
  return canopy_in_plots(trial, [&](const Eigen::Vector2d& off) {
    double depth = 0;
    if (std::abs(off.x()) > 0.5 * trial.length_m) return depth;
    for (int row = 0; row < rows; ++row)
      depth += leaves(off.y() - (row + 0.5) * spacing_m + 0.5 * trial.width_m, stems_m, blades_m);
    return depth;
  });
}

// The trial as a lattice on the raster, rows along r.
inline Lattice lattice_of(const TrialLayout& trial, const CanopyRaster& raster) {
  Lattice lattice{
      .view = {.raster = &raster},
      .r = {.size_m = trial.length_m, .band_m = trial.length_m, .pitch_m = trial.row_pitch_m},
      .c = {.size_m = trial.width_m, .band_m = trial.width_m, .pitch_m = trial.column_pitch_m},
      .rows = trial.rows(),
      .columns = trial.columns()};
  for (const TrialPlace& place : trial.places) {
    const Eigen::Vector2d center = trial.box(place).center;
    lattice.places.push_back({.row = place.row - 1,
                              .column = place.column - 1,
                              .r_m = center.x(),
                              .c_m = center.y(),
                              .full = true});
  }
  return lattice;
}

}  // namespace plotscan::plots
