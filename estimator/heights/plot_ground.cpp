// SPDX-License-Identifier: Apache-2.0
#include "heights/plot_ground.h"

#include <algorithm>
#include <cmath>

namespace plotscan::heights {
namespace {

constexpr int kPlaces = 9;  // along either side of the box

// The part of a place's error that the places around share.
double shared_error(const ground::Surface& surface, const Eigen::Vector2d& place) {
  const double error_m = surface.standard_error(place);
  const double own_m = surface.misfit(place);
  const double shared_m = std::sqrt(std::max(0.0, error_m * error_m - own_m * own_m));
  return std::hypot(shared_m, surface.layers(place));
}

}  // namespace

PlotGround ground_under(const PlotBox& box, const ground::Surface& surface,
                        double largest_error_m) {
  PlotGround ground;
  double slopes = 0;  // squared
  int reached = 0;
  int measured = 0;
  double misfit_m2 = 0;
  for (int i = 0; i < kPlaces; ++i) {
    for (int j = 0; j < kPlaces; ++j) {
      const Eigen::Vector2d place = box.center +
                                    ((i + 0.5) / kPlaces - 0.5) * box.length_m * box.length_axis() +
                                    ((j + 0.5) / kPlaces - 0.5) * box.width_m * box.width_axis();
      ground.seen_share += surface.seen_at(place) ? 1.0 / (kPlaces * kPlaces) : 0;
      const double misfit_m = surface.misfit(place);
      const Eigen::Vector2d slope = surface.slope(place);
      if (std::isnan(misfit_m) || slope.hasNaN()) continue;
      ++reached;
      slopes += slope.squaredNorm();
      if (surface.standard_error(place) > largest_error_m) continue;
      ++measured;
      const double error_m = shared_error(surface, place);
      ground.standard_error_m += error_m;
      ground.worst_error_m = std::max(ground.worst_error_m, error_m);
      misfit_m2 += misfit_m * misfit_m;
    }
  }
  ground.reached_share = static_cast<double>(reached) / (kPlaces * kPlaces);
  if (reached == 0) return ground;
  ground.slope = std::sqrt(slopes / reached);
  if (measured == 0) return ground;
  const double cells =
      std::max(1.0, box.length_m * box.width_m / (surface.cell_m * surface.cell_m));
  const double of_mean_m = std::sqrt(misfit_m2 / measured / cells);
  ground.standard_error_m = std::hypot(ground.standard_error_m / measured, of_mean_m);
  ground.worst_error_m = std::hypot(ground.worst_error_m, of_mean_m);
  return ground;
}

}  // namespace plotscan::heights
