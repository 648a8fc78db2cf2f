// SPDX-License-Identifier: Apache-2.0
#include "crop/wheat_ear.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace plotscan::crop {
namespace {

using Eigen::Vector3d;

constexpr double kSpikeletTilt = 0.42;  // radians from the rachis
constexpr double kSpikeletFlatness = 0.7;
constexpr double kAwnRadius_m = 0.0004;
constexpr double kLightAwnRadius_m = 0.0015;  // one stands for a row's
constexpr double kSpindleShare = 2.0;         // radius of the ear over a spikelet's

// Two thin triangles that spread from a spikelet's tip.
void grow_awns(const Vector3d& tip, const Vector3d& heading, const Vector3d& aside, double length_m,
               RandomStream& random, PlantBuilder& plant) {
  for (const int hand : {-1, 1}) {
    const double spread = random.uniform(0.05, 0.3);
    const double length = length_m * random.uniform(0.8, 1.1);
    if (length_m <= 0 || (plant.light() && hand > 0)) continue;
    const double radius = plant.light() ? kLightAwnRadius_m : kAwnRadius_m;
    plant.tube({.path = {tip, tip + length * (heading + hand * spread * aside).normalized()},
                .radius_m = {radius, 0},
                .sides = 2,
                .across = heading.cross(aside),
                .light_sides = 2},
               "awn");
  }
}

void grow_spindle(const WheatEar& ear, const Axis& axis, PlantBuilder& plant) {
  const double from = std::max(ear.foot_m, ear.shown_from_m);
  const double to = ear.foot_m + ear.length_m;
  if (to - from < ear.spikelet_m / 2) return;
  plant.tube({.path = axis.part(from, to, 3),
              .radius_m = {0, kSpindleShare * ear.spikelet_radius_m, 0},
              .light_points = 3,
              .light_sides = 3},
             ear.material);
}

}  // namespace

void grow_wheat_ear(const WheatEar& ear, const Axis& axis, RandomStream& random,
                    PlantBuilder& plant) {
  if (plant.light()) grow_spindle(ear, axis, plant);
  const double reach = ear.length_m - ear.spikelet_m;
  for (int i = 0; i < ear.spikelets; ++i) {
    const bool last = i == ear.spikelets - 1;
    const double foot = ear.foot_m + reach * i / std::max(1, ear.spikelets - 1);
    const double share = static_cast<double>(i) / ear.spikelets;
    const Vector3d heading = axis.heading(foot);
    const Vector3d aside = (i % 2 == 0 ? 1 : -1) * direction(ear.side_rad, 0);
    const double tilt = last ? 0 : kSpikeletTilt * random.uniform(0.8, 1.2);
    const Vector3d along = (heading + std::tan(tilt) * aside).normalized();
    // Small at the foot of the ear and towards its tip.
    const double size = 0.75 + 0.25 * std::sin(3.1 * std::min(1.0, share + 0.1));
    const Vector3d base = axis.at(foot);
    const Vector3d tip = base + size * ear.spikelet_m * along;
    const bool shown = foot >= ear.shown_from_m && (last || !plant.light());
    if (!shown) continue;
    if (!plant.light()) {
      plant.tube({.path = {base, base + 0.45 * (tip - base), tip},
                  .radius_m = {0, size * ear.spikelet_radius_m, 0},
                  .sides = 3,
                  .across = heading.cross(aside),
                  .flatness = kSpikeletFlatness},
                 ear.material);
    }
    const Vector3d across = heading.cross(aside).normalized();
    grow_awns(tip, (heading + 0.35 * std::tan(tilt) * aside).normalized(), across, ear.awn_m,
              random, plant);
  }
}

}  // namespace plotscan::crop
