// SPDX-License-Identifier: Apache-2.0
#pragma once

// Whether what lies on a lattice has the gaps, the straight sides and the rough tops of plots.

#include <span>

#include <Eigen/Core>

#include "plots/lattice/lattice.h"

namespace plotscan::plots {

// Cover of the gaps from plot to plot over that of the plots on either side, in the mean and three
// standard errors more; along the axis where it is larger. 0 where no plot has a neighbour. Pieces
// cut out of a row that runs on, as of vines, have 0.96 and more.
double gap_cover(const Lattice& lattice);

// How much better rectangular shapes than round ones explain the mean canopy in and around all
// plots: a ratio of misfits, above 1 where sides are straight.
struct Squareness {
  // Residual squares of two levels, inside and outside an ellipse, over those with a rectangle. Few
  // returns suffice.
  double of_outline = 0;
  // Residual squares of any function of the elliptic distance from the centre (crowns, mounds),
  // over those of any product of a function along and one across (rows, sides that leaves hang
  // over). Both with 0.05 of the canopy's variation added: where both leave little, neither is
  // better. Clear with many returns; with few it is near 1, as noise is no such product.
  double of_canopy = 0;
};
Squareness squareness_of(const Lattice& lattice);

// Of the upper returns of places: those above half the height, which is the 95th percentile in the
// middle four fifths of the place. NaN where no place has enough.
struct Roughness {
  // Median over the places of the scatter about a plane, over the height. The sensor's noise is
  // taken out where it is known to be small beside the height.
  double of_height = 0;
  // The same of the median scatter in small patches, each about a plane of its own, in sigmas of
  // the noise. NaN too where noise may hide the scatter of a canopy.
  double in_patches = 0;
};

// `points` are (x, y, height above the ground), metres, with noise of sigma noise_m.
Roughness roughness(const Lattice& lattice, std::span<const Eigen::Vector3f> points,
                    double noise_m);

}  // namespace plotscan::plots
