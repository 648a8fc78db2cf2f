// SPDX-License-Identifier: Apache-2.0
#include "view/internal/camera.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <vtkCamera.h>
#include <vtkRenderer.h>

#include "core/angle.h"

namespace plotscan::view {
namespace {

constexpr double kUpSlope = 0.21;  // half of the view's angle: 24 degrees in all
constexpr double kMargin = 1.02;   // the picture's size over that of what it shows

// Bounds on one coordinate of the camera: over all points, the coordinate minus, or plus, what the
// edge lines of sight gain on the way to the point.
struct Sides {
  double most = -std::numeric_limits<double>::infinity();
  double least = std::numeric_limits<double>::infinity();

  // How far behind the origin a camera between the sides must stand to see both.
  double distance(double slope) const { return (most - least) / (2 * slope); }
  double middle() const { return (most + least) / 2; }
};

Sides sides_of(const std::vector<Eigen::Vector3d>& points, const Eigen::Vector3d& axis,
               const Eigen::Vector3d& back, double slope) {
  Sides sides;
  for (const Eigen::Vector3d& point : points) {
    sides.most = std::max(sides.most, point.dot(axis) + slope * point.dot(back));
    sides.least = std::min(sides.least, point.dot(axis) - slope * point.dot(back));
  }
  return sides;
}

}  // namespace

Eigen::Vector2d Camera::project(const Eigen::Vector3d& point) const {
  const Eigen::Vector3d from_eye = point - eye;
  const double depth = -from_eye.dot(back);
  return {from_eye.dot(right) / (depth * right_slope), from_eye.dot(up) / (depth * up_slope)};
}

View view_from(const Direction& direction) {
  const double azimuth = direction.azimuth_deg * kDegrees;
  const double elevation = direction.elevation_deg * kDegrees;
  View view;
  view.back = {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
               std::sin(elevation)};
  view.right = {-std::sin(azimuth), std::cos(azimuth), 0};
  view.up = view.back.cross(view.right);
  return view;
}

Camera camera_that_sees(const std::vector<Eigen::Vector3d>& points, const Direction& direction,
                        double aspect) {
  Camera camera{view_from(direction)};
  const double up_slope = kUpSlope / kMargin, right_slope = aspect * kUpSlope / kMargin;
  const auto sides = [&](const Eigen::Vector3d& axis, double slope) {
    return sides_of(points, axis, camera.back, slope);
  };
  const double distance = std::max(sides(camera.right, right_slope).distance(right_slope),
                                   sides(camera.up, up_slope).distance(up_slope));
  // The least slope from which all are seen: their distance falls as it grows.
  double low = 0, high = up_slope;
  for (int i = 0; i < 50; ++i) {
    const double middle = (low + high) / 2;
    (sides(camera.up, middle).distance(middle) > distance ? low : high) = middle;
  }
  camera.eye = sides(camera.right, right_slope).middle() * camera.right +
               sides(camera.up, high).middle() * camera.up + distance * camera.back;
  camera.right_slope = kMargin * right_slope;
  camera.up_slope = kMargin * high;
  return camera;
}

void aim(vtkRenderer& renderer, const Camera& camera) {
  vtkCamera& active = *renderer.GetActiveCamera();
  const Eigen::Vector3d seen = camera.eye - camera.back;
  active.SetPosition(camera.eye.x(), camera.eye.y(), camera.eye.z());
  active.SetFocalPoint(seen.x(), seen.y(), seen.z());
  active.SetViewUp(camera.up.x(), camera.up.y(), camera.up.z());
  active.SetViewAngle(2 * std::atan(camera.up_slope) / kDegrees);
  renderer.ResetCameraClippingRange();
}

}  // namespace plotscan::view
