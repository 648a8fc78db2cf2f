// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/plot_box.h"
#include "estimate/estimate.h"
#include "methods/dhami2020/internal/lattice.h"

namespace plotscan::methods::dhami2020 {

// A lattice learnt in a part of the field, carried on over all of it: refitted to the centroids of
// the canopy around its points, in rounds that reach half as far again each, so that the error of
// its steps does not grow with the distance. Stays as it is where the canopy does not follow it.
Lattice carried_over(Lattice lattice, const PlotBox& plot, std::span<const Eigen::Vector3f> canopy);

// Fills a lattice with boxes of the voted size (section IV-B3): the lattice points whose boxes are
// covered by canopy at least kLeastCover times as far as the median of the boxes around the
// clusters' centres; of those, the `most` best covered. Cover is the share of the box's squares of
// `cell_m` that hold a canopy point. `canopy` and `centers` share the lattice's frame. Numbered
// from 1 row by row; rows and columns count from 1 at the filled grid's corner.
constexpr double kLeastCover = 0.4;
std::vector<estimate::PlotEstimate> fill_lattice(const Lattice& lattice, const PlotBox& plot,
                                                 std::span<const Eigen::Vector3f> canopy,
                                                 std::span<const Eigen::Vector2d> centers,
                                                 double cell_m, std::size_t most);

}  // namespace plotscan::methods::dhami2020
