// SPDX-License-Identifier: Apache-2.0
#include "plots/internal/outline.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "plots/internal/depth_profile.h"

namespace plotscan::plots {
namespace {

struct EdgeFit {
  double size_m = 0;
  double blur_m = 0;  // sigma of the leaves' spread over the edge
};

// Share of the plots that have a neighbour one pitch further.
double neighbour_share(const Lattice& lattice, bool along_r) {
  double with = 0;
  for (const Place& place : lattice.places) {
    with += std::ranges::any_of(lattice.places, [&](const Place& other) {
      const double step = along_r ? other.r_m - place.r_m : other.c_m - place.c_m;
      const double aside = along_r ? other.c_m - place.c_m : other.r_m - place.r_m;
      const double pitch = along_r ? lattice.r_pitch_m : lattice.c_pitch_m;
      return std::abs(step - pitch) < 0.2 * pitch &&
             std::abs(aside) < 0.5 * (along_r ? lattice.c_size_m : lattice.r_size_m);
    });
  }
  return with / std::max<double>(1, static_cast<double>(lattice.places.size()));
}

// Squares about depth * box + level in the edges' reach, the level at least 0.
double squares_of(const DepthProfile& profile, double depth, const BlurredBox& shape, double pitch,
                  double share, double edge_m) {
  double n = 0, rest = 0, squares = 0;
  for (std::size_t i = 0; i < profile.x_m.size(); ++i) {
    const double x = profile.x_m[i];
    if (std::abs(std::abs(x) - edge_m) > 0.3) continue;
    double box = shape(x);
    if (pitch > 0) box += share * (shape(x - pitch) + shape(x + pitch));
    const double left = profile.depth[i] - depth * box;
    n += 1;
    rest += left;
    squares += left * left;
  }
  const double level = std::max(0.0, rest / std::max(1.0, n));
  return squares - 2 * level * rest + n * level * level;
}

// Where the depth falls through half of the plateau's, of both sides together, from the line
// through the samples about it; the neighbours' share in it is taken away first.
double half_depth_size(const DepthProfile& profile, double depth, const EdgeFit& fit, double pitch,
                       double share) {
  constexpr double kAbout_m = 0.1;
  double size = fit.size_m;
  for (int round = 0; round < 4; ++round) {
    const BlurredBox shape(size, fit.blur_m);
    double n = 0, x_sum = 0, y_sum = 0, xx = 0, xy = 0;
    for (std::size_t i = 0; i < profile.x_m.size(); ++i) {
      const double signed_x = profile.x_m[i], x = std::abs(signed_x) - size / 2;
      if (std::abs(x) > kAbout_m) continue;
      double y = profile.depth[i];
      if (pitch > 0) {
        y -= depth * share * (shape(signed_x - pitch) + shape(signed_x + pitch));
      }
      n += 1;
      x_sum += x;
      y_sum += y;
      xx += x * x;
      xy += x * y;
    }
    const double slope = (n * xy - x_sum * y_sum) / (n * xx - x_sum * x_sum);
    if (!(slope < 0)) return fit.size_m;
    const double crossing = (depth / 2 - (y_sum - slope * x_sum) / n) / slope;
    size += 2 * std::clamp(crossing, -0.1, 0.1);
  }
  return size;
}

EdgeFit fit_edges_along(const Lattice& lattice, bool along_r) {
  const double size_m = along_r ? lattice.r_size_m : lattice.c_size_m;
  const double pitch_m = along_r ? lattice.r_pitch_m : lattice.c_pitch_m;
  const double gap_m = pitch_m > 0 ? std::max(0.1, pitch_m - size_m) : 1.0;
  const DepthProfile profile =
      pooled_profile(lattice, along_r, size_m / 2 + std::clamp(gap_m / 2, 0.2, 0.5));
  const double share = pitch_m > 0 ? neighbour_share(lattice, along_r) : 0;
  const double depth = plateau_depth(profile, size_m);
  EdgeFit best{.size_m = size_m};
  double best_squares = std::numeric_limits<double>::infinity();
  for (double size = size_m - 0.35; size <= size_m + 0.35; size += 0.01) {
    if (size < 0.2) continue;
    for (double blur = 0.03; blur <= 0.25; blur += 0.02) {
      const double squares =
          squares_of(profile, depth, BlurredBox(size, blur), pitch_m, share, size_m / 2);
      if (squares >= best_squares) continue;
      best_squares = squares;
      best = {.size_m = size, .blur_m = blur};
    }
  }
  const double half_m = half_depth_size(profile, depth, best, pitch_m, share);
  if (std::abs(half_m - best.size_m) < 0.15) best.size_m = half_m;
  return best;
}

}  // namespace

void fit_edges(Lattice& lattice) {
  constexpr double kMost_m = 0.3;  // from the size of the bands
  EdgeFit r = fit_edges_along(lattice, true), c = fit_edges_along(lattice, false);
  r.size_m = std::clamp(r.size_m, lattice.r_band_m - kMost_m, lattice.r_band_m + kMost_m);
  c.size_m = std::clamp(c.size_m, lattice.c_band_m - kMost_m, lattice.c_band_m + kMost_m);
  lattice.r_size_m = r.size_m;
  lattice.r_blur_m = r.blur_m;
  lattice.c_size_m = c.size_m;
  lattice.c_blur_m = c.blur_m;
}

}  // namespace plotscan::plots
