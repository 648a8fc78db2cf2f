// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/plot_box.h"
#include "core/progress.h"
#include "ground/grid.h"

namespace plotscan::ground {

// Random draws of the surface's error: each differs from the fitted surface as the true ground may,
// if the ground bends everywhere as it does where it is seen. The standard error of any sum over
// the surface is the spread of that sum over the draws.
struct ErrorDraws {
  Grid grid = {};  // its origin is the surface's, and 0 here
  int draws = 0;
  std::vector<float> heights_m = {};  // draw by draw
  std::vector<float> doubt_m = {};    // by node: standard error that near places share, besides
};

// The ground of a whole field as heights of a grid's nodes, bilinear between them.
struct Surface : Grid {
  std::vector<float> z_m = {};       // NaN where no ground is within reach
  std::vector<float> sd_m = {};      // standard error of z_m; NaN where that is
  std::vector<float> misfit_m = {};  // the part of it that each cell has for itself, see misfit.h
  // How far apart layers of ground lie, as where strips disagree in height: the surface may follow
  // any. It is no part of sd_m, which tells where the ground is hidden. 0: one layer, or unknown.
  std::vector<float> layers_m = {};
  std::vector<std::uint8_t> seen = {};  // 1: from ground returns at the node; 0: interpolated
  double noise_m = 0;       // sigma of the returns' heights about bare ground, stated or seen
  double noise_seen_m = 0;  // the same as the returns show it
  ErrorDraws errors = {};   // what the standard errors come from

  // Height, and its standard error, at a place (x, y), metres. NaN outside the grid, and where a
  // node of the cell is NaN.
  double height(const Eigen::Vector2d& place) const;
  double standard_error(const Eigen::Vector2d& place) const;
  // The part of the standard error that is independent from cell to cell; 0 where it is unknown.
  double misfit(const Eigen::Vector2d& place) const;
  double layers(const Eigen::Vector2d& place) const;
  // Whether the node nearest to the place was seen; false outside the grid.
  bool seen_at(const Eigen::Vector2d& place) const;
  // Standard error, metres, of the mean of z_m over the box: errors of near places are correlated,
  // except for the misfit. NaN where the box's centre has no ground.
  double mean_standard_error(const PlotBox& box) const;
  // Gradient (dz/dx, dz/dy) of the cell's bilinear patch.
  Eigen::Vector2d slope(const Eigen::Vector2d& place) const;
};

struct SurfaceOptions {
  std::optional<double> cell_m = std::nullopt;   // grid's step; by the points' density where absent
  std::optional<double> noise_m = std::nullopt;  // sigma of heights; estimated where absent
  double reach_m = 4;  // farther from any ground return, and than 4 cells, there is no ground
  int threads = 1;
  ProgressReport progress = {};
};

// The ground under the points (x, y, z up, metres; any order), under canopy too: docs/ground.md.
// The same points give the same bytes for any number of threads. Throws InputError on an option out
// of its range, when no point is finite, and when the field is too large for a grid of this step.
Surface fit_surface(std::span<const Eigen::Vector3f> points, const SurfaceOptions& options);

}  // namespace plotscan::ground
