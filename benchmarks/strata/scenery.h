// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/plot_box.h"
#include "core/random.h"

namespace plotscan::strata {

// Things on the ground of a scene; the height of each is a formula of the place seen from above.
// Metres; heights are above the ground below.
enum class Shape {
  crown,   // an ellipsoid on a stem, as porous as a tree's or bush's
  hedge,   // porous as a crown, of one profile along its length: a vine row
  car,     // a body and a cabin
  block,   // vertical walls and a flat top
  roof,    // vertical walls and a ridge along the length, a third of the height over the eaves
  mound,   // a rough dome
  canopy,  // closed, of uneven height
};

struct Thing {
  Shape shape = Shape::block;
  PlotBox outline;      // an ellipse's bounding box for crown and mound
  double height_m = 1;  // of its highest point
  double cover = 1;     // of crown, hedge, block and canopy: share of shots that it stops
};

// Smooth random ground: a plane and a few sine waves.
class Ground {
 public:
  Ground(double relief_m, RandomStream& random);
  double height(const Eigen::Vector2d& place) const;

 private:
  struct Wave {
    Eigen::Vector2d per_m = Eigen::Vector2d::Zero();  // radians a metre
    double amplitude_m = 0;
    double phase = 0;
  };
  std::vector<Wave> waves_;
  Eigen::Vector2d slope_ = Eigen::Vector2d::Zero();
};

// The height over the ground of one shot's return at a place that the thing covers, or 0 where the
// shot passes it. The same `random` gives the same return.
double return_height(const Thing& thing, const Eigen::Vector2d& place, RandomStream& random);

struct ScanOptions {
  double side_m = 30;       // of the square that is scanned, about the origin
  double density_m2 = 300;  // points a square metre
  double noise_m = 0.02;    // standard deviation of the points along each axis
};

// A scan of things on the ground: points uniform over the square, each at the highest return there,
// with noise.
std::vector<Eigen::Vector3f> scan(const std::vector<Thing>& things, const Ground& ground,
                                  const ScanOptions& options, RandomStream& random);

}  // namespace plotscan::strata
