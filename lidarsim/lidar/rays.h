// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace plotscan::lidar {

struct Ray {
  Eigen::Vector3f origin_m;   // world frame
  Eigen::Vector3f direction;  // unit vector
  double time_s = 0;          // from take-off; decides what is hit where plants sway
};

// Rays as a structure of arrays, one per coordinate, for vector instructions.
struct RayArrays {
  std::array<std::vector<float>, 3> origin_m;   // x, y, z
  std::array<std::vector<float>, 3> direction;  // of unit length
  std::vector<double> time_s;

  explicit RayArrays(std::size_t count) : time_s(count) {
    origin_m.fill(std::vector<float>(count));
    direction.fill(std::vector<float>(count));
  }

  std::size_t size() const { return time_s.size(); }

  Ray at(std::size_t i) const {
    return {.origin_m = {origin_m[0][i], origin_m[1][i], origin_m[2][i]},
            .direction = {direction[0][i], direction[1][i], direction[2][i]},
            .time_s = time_s[i]};
  }

  void set(std::size_t i, const Ray& ray) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      origin_m[axis][i] = ray.origin_m[static_cast<Eigen::Index>(axis)];
      direction[axis][i] = ray.direction[static_cast<Eigen::Index>(axis)];
    }
    time_s[i] = ray.time_s;
  }
};

}  // namespace plotscan::lidar
