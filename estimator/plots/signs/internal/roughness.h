// SPDX-License-Identifier: Apache-2.0
#pragma once

// Private to the library: whether the tops of what lies on a lattice are rough, as canopies are, or
// flat, as tables and crates are.

#include <span>

#include <Eigen/Core>

#include "plots/lattice/lattice.h"

namespace plotscan::plots {

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
