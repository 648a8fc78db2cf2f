// SPDX-License-Identifier: Apache-2.0
#pragma once

// A beam that hovers over level ground and a plate, whose returns have closed forms.

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "lidar/internal/beam.h"
#include "simulated.h"

namespace plotscan::lidar {

using Points = std::vector<scan::LabelledPoint>;

inline constexpr double kHeight_m = 8;
inline constexpr float kSoil = 0.3f;
inline constexpr float kPlate = 0.5f;
inline constexpr float kPlateReach_m = 12;

// One laser, across the spin axis, that spins about the flight's direction, here east.
inline sensor::Sensor one_laser() {
  sensor::Sensor sensor = testing::exact_vlp16();
  sensor.lasers = {{.elevation_rad = 0, .offset_m = 0, .fires_s = 0, .ring = 0}};
  return sensor;
}

inline mesh::Mesh rectangle(float x0, float x1, float half_y, float z) {
  return {.vertices = {{x0, -half_y, z}, {x1, -half_y, z}, {x1, half_y, z}, {x0, half_y, z}},
          .triangles = {{0, 1, 2}, {0, 2, 3}}};
}

// Ground at z 0 and a plate over what lies west of x = edge_m. The plate is no larger than the
// tests need: the ray tracer's single precision shifts an edge by about 1e-7 of its triangle's
// size.
inline SceneContent plate_over_ground(double plate_z_m, double edge_m) {
  return {
      .meshes = {rectangle(-300, 300, 300, 0),
                 rectangle(-kPlateReach_m, static_cast<float>(edge_m), kPlateReach_m,
                           static_cast<float>(plate_z_m))},
      .placed = {
          {.mesh = 0, .surface = {.label = scan::PointClass::ground, .reflectance = kSoil}},
          {.mesh = 1,
           .surface = {
               .label = scan::PointClass::crop, .plot = 3, .plant = 7, .reflectance = kPlate}}}};
}

inline SceneContent ground() {
  return {.meshes = {rectangle(-300, 300, 300, 0)},
          .placed = {
              {.mesh = 0, .surface = {.label = scan::PointClass::ground, .reflectance = kSoil}}}};
}

// A hover over x 0.
struct Hover {
  explicit Hover(const sensor::Sensor& from)
      : sensor(from),
        plan(sensor, 10, testing::spin_along_flight(), testing::hover({0, 0, kHeight_m}, 0.2)) {}

  Points scan(const SceneContent& content, const SimulateOptions& options) const {
    Points points;
    const Scene scene(content);
    simulate(scene, sensor, {.fired = plan, .placed = plan}, options,
             [&](std::span<const scan::LabelledPoint> piece) {
               points.insert(points.end(), piece.begin(), piece.end());
             });
    return points;
  }
  // The range to the plane at height z of the shot that made the point, and its cosine to it.
  std::uint64_t shot(const scan::LabelledPoint& point) const {
    return static_cast<std::uint64_t>(std::lround(point.time / sensor.sequence_s));
  }
  double down(const scan::LabelledPoint& point) const { return down_of(shot(point)); }
  double down_of(std::uint64_t shot) const {
    sensor::SequenceShots shots;
    plan.fire(shot, shots);
    return -shots.direction[2][0];
  }

  sensor::Sensor sensor;
  sensor::ShotPlan plan;
};

inline double range_of(const scan::LabelledPoint& point) {
  return (testing::position(point) - Eigen::Vector3d(0, 0, kHeight_m)).norm();
}

// How far the sub-rays on one side of an edge through the axis are off it along the edge, at most
// over all turns of the pattern, in standard deviations of the beam.
inline double off_centre(int sub_rays) {
  double most = 0;
  for (int step = 0; step < 3600; ++step) {
    const Eigen::Rotation2Dd turn(std::numbers::pi * step / 3600);
    double sum = 0;
    for (const Eigen::Vector2d& point : normal_pattern(sub_rays)) {
      const Eigen::Vector2d turned = turn * point;
      if (turned.x() < 0) sum += turned.y();
    }
    most = std::max(most, std::abs(sum) / (0.5 * sub_rays));
  }
  return most;
}

// How far a half of the beam moves a range on a level surface: to first order by its offset times
// the surface's slope to the beam, and by the second order that a whole beam has too.
inline double half_beam_bound(double off, const Hover& hover, double range_m, double down) {
  const double slope = std::sqrt(1 - down * down) / down;
  return off * hover.sensor.beam->along_rad / 4 * range_m * slope + 1e-4 / std::pow(down, 4);
}

}  // namespace plotscan::lidar
