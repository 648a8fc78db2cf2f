// SPDX-License-Identifier: Apache-2.0
#include "strata/scenery.h"

#include <algorithm>
#include <cmath>

#include "core/angle.h"

namespace plotscan::strata {
namespace {

// Across and along the thing, -1 to 1.
Eigen::Vector2d relative(const Thing& thing, const Eigen::Vector2d& place) {
  const Eigen::Vector2d local = thing.outline.box_from_world(place);
  return {2 * local.x() / thing.outline.length_m, 2 * local.y() / thing.outline.width_m};
}

// Somewhere in a porous body between two heights, more often near its top.
double within(double low_m, double high_m, RandomStream& random) {
  const double depth = random.uniform();
  return high_m - (high_m - low_m) * depth * depth;
}

double crown_height(const Thing& thing, const Eigen::Vector2d& at, RandomStream& random) {
  constexpr double kLowest = 0.2;  // of the crown's foot, of its height
  const double radius2 = at.squaredNorm();
  if (radius2 >= 1 || random.uniform() > thing.cover) return 0;
  const double half = std::sqrt(1 - radius2) * (1 - kLowest) / 2;
  const double middle = (1 + kLowest) / 2;
  return thing.height_m * within(middle - half, middle + half, random);
}

double hedge_height(const Thing& thing, const Eigen::Vector2d& at, RandomStream& random) {
  if (random.uniform() > thing.cover) return 0;
  const double top = std::sqrt(1 - at.y() * at.y());
  return thing.height_m * within(0.3 * top, top, random);
}

double car_height(const Thing& thing, const Eigen::Vector2d& at) {
  constexpr double kBonnet = 0.6;  // of the height
  const bool cabin = at.x() > -0.45 && at.x() < 0.75 && std::abs(at.y()) < 0.85;
  return thing.height_m * (cabin ? 1 : kBonnet);
}

double roof_height(const Thing& thing, const Eigen::Vector2d& at) {
  return thing.height_m * (1 - std::abs(at.y()) / 3);
}

double mound_height(const Thing& thing, const Eigen::Vector2d& at, RandomStream& random) {
  constexpr double kRough_m = 0.15;
  const double radius2 = at.squaredNorm();
  if (radius2 >= 1) return 0;
  const double dome = thing.height_m * (1 - radius2) * (1 - radius2);
  return std::max(0.0, dome + kRough_m * random.normal());
}

// Waves of many lengths in many directions: nowhere the same again, as no lattice is.
double canopy_height(const Thing& thing, const Eigen::Vector2d& place, RandomStream& random) {
  constexpr int kWaves = 6;
  constexpr double kShortest_m = 0.4;
  constexpr double kLonger = 1.5;       // than the wave before
  constexpr double kGoldenAngle = 2.4;  // radians from one direction to the next
  constexpr double kAmplitude = 0.1 / kWaves;
  double uneven = 0;
  for (int i = 0; i < kWaves; ++i) {
    const double per_m = 2 * kPi / (kShortest_m * std::pow(kLonger, i));
    const double along_m =
        place.x() * std::cos(kGoldenAngle * i) + place.y() * std::sin(kGoldenAngle * i);
    uneven += kAmplitude * std::sin(per_m * along_m + i);
  }
  return thing.height_m * (0.9 + uneven) * within(0.7, 1, random);
}

// Of the points of a thing that has walls.
constexpr double kWallShare = 0.1;

bool has_walls(Shape shape) {
  return shape == Shape::car || shape == Shape::block || shape == Shape::roof;
}

// On one of the four sides, the longer ones more often.
Eigen::Vector2d on_a_side(const PlotBox& box, RandomStream& random) {
  const double around = random.uniform() * (box.length_m + box.width_m);
  const double side = random.uniform() < 0.5 ? -0.5 : 0.5;
  const Eigen::Vector2d local =
      around < box.length_m
          ? Eigen::Vector2d(around - box.length_m / 2, side * box.width_m)
          : Eigen::Vector2d(side * box.length_m, around - box.length_m - box.width_m / 2);
  return box.center + local.x() * box.length_axis() + local.y() * box.width_axis();
}

// Whether a place may lie in the outline, by its surrounding circle.
bool near(const Thing& thing, const Eigen::Vector2d& place) {
  const double reach2 =
      (std::pow(thing.outline.length_m, 2) + std::pow(thing.outline.width_m, 2)) / 4;
  return (place - thing.outline.center).squaredNorm() <= reach2;
}

}  // namespace

Ground::Ground(double relief_m, RandomStream& random) {
  constexpr int kWaves = 6;
  slope_ = {random.uniform(-0.02, 0.02), random.uniform(-0.02, 0.02)};
  for (int i = 0; i < kWaves; ++i) {
    const double wavelength_m = random.uniform(6, 40);
    const double direction = random.uniform(0, 2 * kPi);
    waves_.push_back({.per_m = 2 * kPi / wavelength_m *
                               Eigen::Vector2d(std::cos(direction), std::sin(direction)),
                      .amplitude_m = relief_m / kWaves,
                      .phase = random.uniform(0, 2 * kPi)});
  }
}

double Ground::height(const Eigen::Vector2d& place) const {
  double z = slope_.dot(place);
  for (const Wave& wave : waves_)
    z += wave.amplitude_m * std::sin(wave.per_m.dot(place) + wave.phase);
  return z;
}

double return_height(const Thing& thing, const Eigen::Vector2d& place, RandomStream& random) {
  if (!near(thing, place)) return 0;
  const Eigen::Vector2d at = relative(thing, place);
  if (at.cwiseAbs().maxCoeff() >= 1) return 0;
  switch (thing.shape) {
    case Shape::crown:
      return crown_height(thing, at, random);
    case Shape::hedge:
      return hedge_height(thing, at, random);
    case Shape::car:
      return car_height(thing, at);
    case Shape::block:
      return random.uniform() < thing.cover ? thing.height_m : 0;
    case Shape::roof:
      return roof_height(thing, at);
    case Shape::mound:
      return mound_height(thing, at, random);
    case Shape::canopy:
      if (thing.cover < 1 && random.uniform() > thing.cover) return 0;
      return canopy_height(thing, place, random);
  }
  return 0;
}

std::vector<Eigen::Vector3f> scan(const std::vector<Thing>& things, const Ground& ground,
                                  const ScanOptions& options, RandomStream& random) {
  const auto count = static_cast<std::size_t>(options.density_m2 * options.side_m * options.side_m);
  std::vector<Eigen::Vector3f> points;
  const auto add = [&](const Eigen::Vector2d& place, double height_m) {
    const Eigen::Vector3d point(place.x(), place.y(), ground.height(place) + height_m);
    const Eigen::Vector3d noise{random.normal(), random.normal(), random.normal()};
    points.push_back((point + options.noise_m * noise).cast<float>());
  };
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector2d place =
        options.side_m * Eigen::Vector2d{random.uniform() - 0.5, random.uniform() - 0.5};
    double highest_m = 0;
    const Thing* hit = nullptr;
    for (const Thing& thing : things) {
      const double height_m = return_height(thing, place, random);
      if (height_m <= highest_m) continue;
      highest_m = height_m;
      hit = &thing;
    }
    if (hit != nullptr && has_walls(hit->shape) && random.uniform() < kWallShare) {
      const double height_m = hit->height_m * random.uniform() * 2 / 3;
      add(on_a_side(hit->outline, random), height_m);
    } else {
      add(place, highest_m);
    }
  }
  return points;
}

}  // namespace plotscan::strata
