// SPDX-License-Identifier: Apache-2.0
#pragma once

// Private to the library: whether the tops of what lies on a lattice are rough, as canopies are, or
// flat, as tables and crates are.

#include <span>

#include <Eigen/Core>

#include "plots/lattice/lattice.h"

namespace plotscan::plots {

// Median over the places of the scatter of their upper returns about a plane, over their height.
// Upper are those above half the height, which is the 95th percentile in the middle four fifths of
// the place. The sensor's noise, sigma noise_m, is taken out where it is known to be small beside
// the height. `points` are (x, y, height above the ground), metres. NaN where no place has enough.
double roughness(const Lattice& lattice, std::span<const Eigen::Vector3f> points, double noise_m);

}  // namespace plotscan::plots
