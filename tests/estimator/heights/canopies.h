// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "core/plot_box.h"
#include "core/random.h"
#include "ground/surface.h"

namespace plotscan::heights {

// Level ground at z = 0 about the origin, seen everywhere.
inline ground::Surface level_ground(double noise_m, float standard_error_m = 0.002F) {
  constexpr int kSide = 101;
  ground::Surface surface;
  surface.origin = {-10, -10};
  surface.cell_m = 0.2;
  surface.columns = kSide;
  surface.rows = kSide;
  surface.z_m.assign(kSide * kSide, 0);
  surface.sd_m.assign(kSide * kSide, standard_error_m);
  surface.seen.assign(kSide * kSide, 1);
  surface.noise_m = noise_m;
  return surface;
}

inline PlotBox plot_at(double x, double y) {
  PlotBox box;
  box.center = {x, y};
  box.width_m = 1.5;
  box.length_m = 4;
  box.heading_rad = 0.4;
  return box;
}

// How far below its dome's surface a return stops, as a share of the height: all on one leaf, 7 cm
// wide, stop at one depth, some go on to a leaf below.
inline double leaf_depth(double along, double across, RandomStream& random) {
  constexpr double kLeaf_m = 0.07, kDeepest = 0.3, kPassing = 0.15;
  const auto place = [](double metres) {
    return static_cast<std::uint64_t>(metres / kLeaf_m + 1e6);
  };
  RandomStream leaf(place(along), random_purpose("test/leaf"), place(across));
  const double depth = kDeepest * leaf.uniform() * leaf.uniform();
  return random.uniform() < kPassing ? random.uniform(depth, 0.8) : depth;
}

// A made-up crop of domes of leaves on bare ground: each a paraboloid of its own height, as wide as
// 0.4 of it. Seen straight down by evenly scattered returns with noise.
inline std::vector<Eigen::Vector3f> dome_returns(const PlotBox& box, double scale, double noise_m,
                                                 int returns, std::uint64_t seed) {
  RandomStream random(seed, random_purpose("test/domes"), 0);
  struct Dome {
    double along, across, height_m;
  };
  std::vector<Dome> domes(80);
  for (Dome& dome : domes)
    dome = {random.uniform(-0.5, 0.5) * box.length_m, random.uniform(-0.5, 0.5) * box.width_m,
            scale * random.uniform(0.55, 0.8)};
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < returns; ++i) {
    const double along = random.uniform(-0.5, 0.5) * box.length_m;
    const double across = random.uniform(-0.5, 0.5) * box.width_m;
    double height = 0;
    for (const Dome& dome : domes) {
      const double share =
          std::hypot(along - dome.along, across - dome.across) / (0.4 * dome.height_m);
      if (share < 1) height = std::max(height, dome.height_m * (1 - share * share));
    }
    height *= 1 - leaf_depth(along, across, random);
    const Eigen::Vector2d place =
        box.center + along * box.length_axis() + across * box.width_axis();
    points.emplace_back(static_cast<float>(place.x()), static_cast<float>(place.y()),
                        static_cast<float>(height + noise_m * random.normal()));
  }
  return points;
}

}  // namespace plotscan::heights
