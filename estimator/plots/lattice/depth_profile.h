// SPDX-License-Identifier: Apache-2.0
#pragma once

// How deep the canopy is along a line through plots.

#include <vector>

#include "plots/lattice/lattice.h"

namespace plotscan::plots {

// Optical depth of the canopy, -ln(1 - cover), at distances from a plot's centre. Depths of
// canopies that overlap add up (Beer-Lambert's law), which covers do not.
struct DepthProfile {
  std::vector<double> x_m, depth;
};

// Along r, over the middle four fifths of the plot's other side, as far as reach_m.
DepthProfile profile_of(const Lattice& lattice, const Place& place, double reach_m);
// The same from the mean cover of all plots.
DepthProfile pooled_profile(const Lattice& lattice, double reach_m);

// The plots one pitch before and after a plot along r, whose leaves hang over into its profile.
struct Neighbours {
  double pitch_m = 0;
  double share = 0;  // of the plots that have one

  // The depth that neighbours add at x_m, mean over all plots; `canopy` is the depth about a
  // neighbour's centre.
  template <class Canopy>
  double depth(const Canopy& canopy, double x_m) const {
    return share > 0 ? share * (canopy(x_m - pitch_m) + canopy(x_m + pitch_m)) : 0;
  }
};
Neighbours neighbours_of(const Lattice& lattice);

// The mean of all plots along r, as far as the middle of the gaps beside them.
DepthProfile profile_with_gaps(const Lattice& lattice);

// Depth of the middle of the plot, within size_m.
double plateau_depth(const DepthProfile& profile, double size_m);

// Sizes to be tried: low, low + step and so on, up to high.
std::vector<double> steps_between(double low, double high, double step);

// A box of height 1 about 0, blurred by a normal kernel.
class BlurredBox {
 public:
  BlurredBox(double size_m, double blur_m);
  double operator()(double x_m) const { return edge(x_m + half_m_) - edge(x_m - half_m_); }

 private:
  // The normal distribution function, from a table.
  double edge(double x_m) const;
  double half_m_, per_m_;
};

}  // namespace plotscan::plots
