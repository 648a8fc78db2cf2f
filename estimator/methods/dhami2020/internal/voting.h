// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

namespace plotscan::methods::dhami2020 {

// The result of a vote (section IV-B2).
struct Vote {
  double value = 0;       // the mean of the values in the bin with most of them
  std::size_t votes = 0;  // how many values that bin holds
};

// Bins [i * bin, (i + 1) * bin); of bins with equally many values the lowest wins. Values >= 0.
Vote vote(std::span<const double> values, double bin);

// Headings modulo pi. The bins are centred on multiples of bin_rad, so that the first one reaches
// across the wrap from pi to 0; the one below it is narrower, where bin_rad does not divide pi. The
// mean is circular, in [0, pi).
Vote vote_heading(std::span<const double> headings_rad, double bin_rad);

}  // namespace plotscan::methods::dhami2020
