// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <Eigen/Core>

class vtkRenderer;

namespace plotscan::view {

// Where a camera stands, counter-clockwise from east and over the horizon, seen from what it shows.
struct Direction {
  double azimuth_deg = 0;
  double elevation_deg = 0;
};

// How a camera is turned: unit vectors in the picture's plane and away from what is seen.
struct View {
  Eigen::Vector3d back = Eigen::Vector3d::UnitZ();
  Eigen::Vector3d right = Eigen::Vector3d::UnitX();
  Eigen::Vector3d up = Eigen::Vector3d::UnitY();
};

View view_from(const Direction& direction);

// A perspective camera. World frame, metres.
struct Camera : View {
  Eigen::Vector3d eye = Eigen::Vector3d::Zero();
  double right_slope = 0, up_slope = 0;  // of the lines of sight to the picture's edges

  // A point's place in the picture: -1 to 1 from left to right and from the lower to the upper
  // edge.
  Eigen::Vector2d project(const Eigen::Vector3d& point) const;
};

// The camera that is nearest to the points and sees all of them in a picture `aspect` times as wide
// as it is high. Where the points leave room above and below, the picture becomes lower: its height
// is the width times up_slope / right_slope. There is at least one point.
Camera camera_that_sees(const std::vector<Eigen::Vector3d>& points, const Direction& direction,
                        double aspect);

void aim(vtkRenderer& renderer, const Camera& camera);

}  // namespace plotscan::view
