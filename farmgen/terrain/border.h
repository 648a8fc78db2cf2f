// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <Eigen/Geometry>

#include "terrain/terrain.h"

namespace plotscan::terrain {

// A terrain's outline and those of its holes: the edges that have a triangle on one side alone.
class Border {
 public:
  explicit Border(const Terrain& terrain);

  // False where no border edge meets the rectangle: the terrain then lies under all of the
  // rectangle or under none of it. May also be true for a rectangle near an oblique edge.
  bool may_meet(const Eigen::AlignedBox2d& rectangle) const;

 private:
  std::vector<Eigen::AlignedBox2d> edges_;
};

}  // namespace plotscan::terrain
