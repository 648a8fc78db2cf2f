// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "plots/lattice/depth_profile.h"
#include "plots/lattice/lattice.h"

namespace plotscan::plots {
namespace {

// All values are our choice.
constexpr double kEdgeReach_m = 0.3;       // about an edge, of what the box is fitted to
constexpr double kHalfDepthReach_m = 0.1;  // about an edge, of the line through half the depth,
constexpr int kEdgeRounds = 4;             // which is sought so often,
constexpr double kMostHalfDepth_m = 0.15;  // and is taken if it lies so near the box's edge
constexpr double kMostOfBand_m = 0.3;      // from the size of the layout's bands
constexpr double kMostBlur_m = 0.4;        // sigma of leaves over an edge: maize's blades

struct EdgeFit {
  double size_m = 0;
  double blur_m = 0;  // sigma of the leaves' spread over the edge
};

// Residual squares about depth * box + level within reach of the edges; the level is at least 0.
double squares_of(const DepthProfile& profile, double depth, const BlurredBox& box,
                  const Neighbours& near, double edge_m) {
  double n = 0, rest = 0, squares = 0;
  for (std::size_t i = 0; i < profile.x_m.size(); ++i) {
    const double x = profile.x_m[i];
    if (std::abs(std::abs(x) - edge_m) > kEdgeReach_m) continue;
    const double left = profile.depth[i] - depth * (box(x) + near.depth(box, x));
    n += 1;
    rest += left;
    squares += left * left;
  }
  const double level = std::max(0.0, rest / std::max(1.0, n));
  return squares - 2 * level * rest + n * level * level;
}

// Where the depth falls through half of the plateau's, of both sides together, from the line
// through the samples about it; the neighbours' share in it is taken away first.
double half_depth_size(const DepthProfile& profile, double depth, const EdgeFit& fit,
                       const Neighbours& near) {
  double size = fit.size_m;
  for (int round = 0; round < kEdgeRounds; ++round) {
    const BlurredBox box(size, fit.blur_m);
    double n = 0, x_sum = 0, y_sum = 0, xx = 0, xy = 0;
    for (std::size_t i = 0; i < profile.x_m.size(); ++i) {
      const double x = std::abs(profile.x_m[i]) - size / 2;
      if (std::abs(x) > kHalfDepthReach_m) continue;
      const double y = profile.depth[i] - depth * near.depth(box, profile.x_m[i]);
      n += 1;
      x_sum += x;
      y_sum += y;
      xx += x * x;
      xy += x * y;
    }
    const double slope = (n * xy - x_sum * y_sum) / (n * xx - x_sum * x_sum);
    if (!(slope < 0)) return fit.size_m;
    const double crossing_m = (depth / 2 - (y_sum - slope * x_sum) / n) / slope;
    size += 2 * std::clamp(crossing_m, -kHalfDepthReach_m, kHalfDepthReach_m);
  }
  return size;
}

// Along r.
EdgeFit fit_edges_along(const Lattice& lattice) {
  const double size_m = lattice.r.size_m, band_m = lattice.r.band_m;
  const DepthProfile profile = profile_with_gaps(lattice);
  const Neighbours near = neighbours_of(lattice);
  const double depth = plateau_depth(profile, size_m);
  EdgeFit best{.size_m = size_m};
  double best_squares = std::numeric_limits<double>::infinity();
  const std::vector<double> blurs = steps_between(0.03, kMostBlur_m, 0.02);
  for (const double size : steps_between(size_m - 0.35, size_m + 0.35, 0.01)) {
    if (size < 0.2) continue;
    for (const double blur : blurs) {
      const double squares = squares_of(profile, depth, BlurredBox(size, blur), near, size_m / 2);
      if (squares >= best_squares) continue;
      best_squares = squares;
      best = {.size_m = size, .blur_m = blur};
    }
  }
  const double half_m = half_depth_size(profile, depth, best, near);
  if (std::abs(half_m - best.size_m) < kMostHalfDepth_m) best.size_m = half_m;
  best.size_m = std::clamp(best.size_m, band_m - kMostOfBand_m, band_m + kMostOfBand_m);
  return best;
}

}  // namespace

void fit_edges(Lattice& lattice) {
  const EdgeFit r = fit_edges_along(lattice), c = fit_edges_along(lattice.turned());
  lattice.r.size_m = r.size_m;
  lattice.r.blur_m = r.blur_m;
  lattice.c.size_m = c.size_m;
  lattice.c.blur_m = c.blur_m;
}

}  // namespace plotscan::plots
