// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace plotscan::cloud {

// Finds out in which steps a cloud's x and y count, from an even sample of its points. In UTM a
// float of 4 bytes counts northings in 0.25 or 0.5 m, a number of 6 digits in 10 m: the plots'
// edges are lost then, and no message about plots would say why.
class CoordinateSteps {
 public:
  void add(std::span<const Eigen::Vector3d> points);
  // The step of x and of y, metres; 0 for an axis on which hardly two points agree.
  Eigen::Vector2d steps_m() const;

 private:
  struct Sampled {
    std::uint64_t number;
    Eigen::Vector2d place;
  };
  std::vector<Sampled> sample_;  // the points whose number is at most most_
  std::uint64_t most_ = std::numeric_limits<std::uint64_t>::max();
  std::uint64_t added_ = 0;
};

// What the user should know of such steps; "" where they are finer than 5 cm, or than the points
// lie apart (as in a raster).
std::string step_note(const Eigen::Vector2d& steps_m, double density_m2);

}  // namespace plotscan::cloud
