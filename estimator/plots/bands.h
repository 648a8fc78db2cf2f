// SPDX-License-Identifier: Apache-2.0
#pragma once

// Private to the library: where bands of one width lie on a line.

#include <vector>

namespace plotscan::plots {

// A band of canopy on a line, in cells: [begin, end).
struct Band {
  int begin = 0;
  int end = 0;
  double contrast = 0;  // of the weaker one of its two edges
};

// Height of the step of a profile of cover at every boundary of its cells: mean of the `reach`
// cells after it less the mean of those before it; beyond the profile's ends there is nothing.
std::vector<double> steps_of(const std::vector<double>& profile, int reach);

struct BandSearch {
  int tolerance = 1;     // cells by which a band may be wider or narrower
  int least_gap = 3;     // cells between two bands
  double penalty = 0.1;  // contrast that a band must have to be one
};

struct Bands {
  std::vector<Band> bands;
  double score = 0;  // sum of contrast over the penalty
};

// The bands of `width` cells, each rising at its begin and falling at its end, whose contrasts
// above the penalty sum to the most: dynamic programming over the line, as a hidden semi-Markov
// model with one duration. A band too narrow or too wide has no step at one of its ends.
Bands best_bands(const std::vector<double>& steps, int width, const BandSearch& search);

}  // namespace plotscan::plots
