// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

#include <Eigen/Core>

#include "core/plot_box.h"
#include "core/random.h"

namespace plotscan::ground {

using Terrain = std::function<double(double, double)>;

// A square field about the origin with plots of a canopy: leaves between canopy_low_m and
// canopy_high_m above the ground, which is seen through a share of the canopy.
struct SyntheticField {
  Terrain terrain;
  double side_m = 12;
  int returns_m2 = 400;
  double noise_m = 0.03;
  std::vector<PlotBox> plots = {};
  double canopy_low_m = 0.2;
  double canopy_high_m = 0.7;
  double gaps = 0.2;
  std::uint64_t seed = 5;
};

inline std::vector<Eigen::Vector3f> returns_of(const SyntheticField& field) {
  RandomStream random(field.seed, random_purpose("test/ground"), 0);
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < field.returns_m2 * field.side_m * field.side_m; ++i) {
    const double x = random.uniform(-0.5 * field.side_m, 0.5 * field.side_m);
    const double y = random.uniform(-0.5 * field.side_m, 0.5 * field.side_m);
    double z = field.terrain(x, y) + field.noise_m * random.normal();
    for (const PlotBox& plot : field.plots) {
      if (!plot.contains({x, y}) || random.uniform() < field.gaps) continue;
      z += random.uniform(field.canopy_low_m, field.canopy_high_m);
    }
    points.push_back(Eigen::Vector3d(x, y, z).cast<float>());
  }
  return points;
}

// Plots of 1.5 m x 4 m with alleys of 0.6 m and 1 m, rows of three.
inline std::vector<PlotBox> two_rows_of_plots() {
  std::vector<PlotBox> plots;
  for (const double y : {-2.5, 2.5}) {
    for (const double x : {-2.1, 0.0, 2.1}) {
      plots.push_back({.center = {x, y}, .width_m = 1.5, .length_m = 4, .heading_rad = 0.5 * M_PI});
    }
  }
  return plots;
}

// Mean of a surface's heights less the terrain's over a box, metres.
template <class Surface>
double mean_error(const Surface& surface, const Terrain& terrain, const PlotBox& box) {
  double sum = 0;
  int count = 0;
  for (double a = -0.475; a < 0.5; a += 0.05) {
    for (double b = -0.475; b < 0.5; b += 0.05) {
      const Eigen::Vector2d p =
          box.center + a * box.length_m * box.length_axis() + b * box.width_m * box.width_axis();
      sum += surface.height(p) - terrain(p.x(), p.y());
      ++count;
    }
  }
  return sum / count;
}

}  // namespace plotscan::ground
