// SPDX-License-Identifier: Apache-2.0
#pragma once

// Which bands of canopy a profile shows.

#include <span>
#include <vector>

#include "plots/canopy/canopy_profile.h"
#include "plots/canopy/row_view.h"

namespace plotscan::plots {

// What all bands on a line look like, in cells.
struct BandShape {
  int size = 0;
  int blur = 2;  // on either side of an edge, over which leaves lean
};

// Bands of one shape on a line, and how well they explain it.
struct Segmentation {
  BandShape shape = {};
  std::vector<int> begins = {};
  double misfit = 0;      // weighted squares left, of all profiles
  double parameters = 0;  // fitted to them
};

// Every band has a canopy level of its own, every gap between two bands too, as leaves close it
// more or less; levels change over the blurred edges along a line. The bands of this shape that
// explain the profiles best, each at least least_gap cells from the next, at the price per
// parameter that Schwarz's criterion asks (Ann. Statist. 6, 1978): dynamic programming over the
// bands' begins, a hidden semi-Markov model with one duration. Several profiles: the same bands on
// all of them.
Segmentation best_bands(std::span<const ProfileSums> profiles, const BandShape& shape,
                        int least_gap, double price);

}  // namespace plotscan::plots
