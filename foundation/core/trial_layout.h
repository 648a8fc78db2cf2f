// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/plot_box.h"

namespace plotscan {

// The most plots a field may have in descriptions, options and tables: far more than any trial has.
inline constexpr int kMostPlots = 100'000;

// Where a plot of a trial lies.
struct TrialPlace {
  int row = 0;     // from 1: rows are counted along the plots' length
  int column = 0;  // from 1: columns are counted along their width
  // The plot's centre from the layout's origin, along its row axis and its column axis, metres.
  Eigen::Vector2d position_m = Eigen::Vector2d::Zero();
};

// How the plots of a trial lie: all of one size, in rows whose direction need not be perpendicular
// to the plots' length. Farms are planted by it, and plot finding returns it; it says nothing about
// plants.
struct TrialLayout {
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();  // in the world's or a cloud's frame, metres
  // Unit vectors: along a row, from column to column; and along the plots' length, from row to row.
  Eigen::Vector2d row_axis = Eigen::Vector2d::UnitX();
  Eigen::Vector2d column_axis = Eigen::Vector2d::UnitY();
  double width_m = 0, length_m = 0;            // of a plot
  double column_pitch_m = 0, row_pitch_m = 0;  // usual step to the next; 0 if there is only one
  std::vector<TrialPlace> places = {};

  double heading_rad() const;  // of the plots' length, in [0, pi)
  double skew_rad() const;     // of the rows, from the perpendicular of the length
  int rows() const;            // the highest number
  int columns() const;
  PlotBox box(const TrialPlace& place) const;
};

}  // namespace plotscan
