// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include <Eigen/Core>

#include "core/plot_box.h"

namespace plotscan::methods::dhami2020 {

// The grid of a field: plot (i, j) is centred at origin + i * steps.col(0) + j * steps.col(1).
// Column 0 steps from row to row, roughly along the plots' length; column 1 from plot to plot
// within a row, roughly along their width. The two need not be perpendicular.
struct Lattice {
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();
  Eigen::Matrix2d steps = Eigen::Matrix2d::Zero();
  bool many_rows = false;     // false: one row seen; steps.col(0) is not known
  bool many_columns = false;  // false: one column seen; steps.col(1) is not known
  std::size_t agreeing = 0;   // centres within tolerance of a lattice point
  double rms_m = 0;           // distance of those centres to their lattice points

  Eigen::Vector2d point(const Eigen::Vector2i& index) const {
    return origin + steps * index.cast<double>();
  }
  Eigen::Vector2i nearest(const Eigen::Vector2d& position) const;
};

// The lattice that best agrees with the cluster centres (our automation of the paper's step "Grid
// Selection", done there by hand). A hypothesis is a centre with a neighbour along the voted
// length axis and one along the width axis; it grows outwards from that centre, each time refitted
// by least squares to the centres that lie within a fifth of the plot's size of a lattice point,
// and no two of them on the same one. The hypothesis wins that holds most centres beyond the number
// that a random scatter would give, so that neither a half nor a double spacing can win. Plots do
// not overlap: a step is at least nine tenths of the plot's side.
//
// `plot` gives the voted heading, length and width. Empty without centres; a single centre gives a
// lattice of one point.
std::optional<Lattice> fit_lattice(std::span<const Eigen::Vector2d> centers, const PlotBox& plot);

// The lattice refitted to those of the centres that agree with it, as above, and lie at most
// `reach` steps from its origin.
Lattice refitted(Lattice lattice, std::span<const Eigen::Vector2d> centers, const PlotBox& plot,
                 int reach);

}  // namespace plotscan::methods::dhami2020
