// SPDX-License-Identifier: Apache-2.0
#include "crop/internal/wheat_ear.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Geometry>

namespace plotscan::crop {
namespace {

using Eigen::Vector3d;

constexpr double kSpikeletTilt = 0.42;  // radians from the rachis
constexpr double kSpikeletFlatness = 0.7;
constexpr double kAwnRadius_m = 0.0004;
constexpr double kLightAwnRadius_m = 0.0015;  // one stands for a row's
constexpr double kAwnTiltShare = 0.35;        // of the spikelet's tilt
constexpr double kNodCosine = 0.9;            // between an ear's ends, below which it bends visibly
constexpr double kSpindleShare = 2.0;         // radius of the ear over a spikelet's

// Where a spikelet is, and the awns of its two outer florets.
struct Spikelet {
  Vector3d base;
  Vector3d tip;
  Vector3d across;  // of the rachis, along which the spikelet is flat
  double radius_m;
  std::array<Vector3d, 2> awn_tips;
};

Spikelet spikelet_at(const WheatEar& ear, const Axis& axis, int i, RandomStream& random) {
  const bool last = i == ear.spikelets - 1;
  const double share = static_cast<double>(i) / std::max(1, ear.spikelets - 1);
  const double foot_m = ear.foot_m + (ear.length_m - ear.spikelet_m) * share;
  const Vector3d heading = axis.heading(foot_m);
  const Vector3d aside = (i % 2 == 0 ? 1 : -1) * direction(ear.side_rad, 0);
  const double tilt = std::tan(kSpikeletTilt * random.uniform(0.8, 1.2)) * (last ? 0 : 1);
  // Small at the foot of the ear and towards its tip.
  const double size = 0.75 + 0.25 * std::sin(3.1 * std::min(1.0, share + 0.1));
  Spikelet spikelet;
  spikelet.base = axis.at(foot_m);
  spikelet.tip = spikelet.base + size * ear.spikelet_m * (heading + tilt * aside).normalized();
  spikelet.across = heading.cross(aside).normalized();
  spikelet.radius_m = size * ear.spikelet_radius_m;
  double hand = 1;
  for (Vector3d& awn_tip : spikelet.awn_tips) {
    const double spread = hand * random.uniform(0.05, 0.3);
    const Vector3d along = heading + kAwnTiltShare * tilt * aside + spread * spikelet.across;
    awn_tip = spikelet.tip + ear.awn_m * random.uniform(0.8, 1.1) * along.normalized();
    hand = -1;
  }
  return spikelet;
}

void grow_awn(const Spikelet& spikelet, const Vector3d& awn_tip, double radius_m,
              PlantBuilder& plant) {
  plant.tube({.path = {spikelet.tip, awn_tip},
              .radius_m = {radius_m, 0},
              .sides = 2,
              .across = (awn_tip - spikelet.tip).cross(spikelet.across),
              .light_sides = 2},
             "awn");
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
  const double tip_m = ear.foot_m + ear.length_m;
  const bool nods = axis.heading(ear.foot_m).dot(axis.heading(tip_m)) < kNodCosine;
  for (int i = 0; i < ear.spikelets; ++i) {
    const Spikelet spikelet = spikelet_at(ear, axis, i, random);
    const double foot_m = ear.foot_m + ear.length_m * i / ear.spikelets;
    if (foot_m < ear.shown_from_m) continue;
    if (plant.light()) {
      // The awns that reach farthest: those of the tip, of a nodding ear those of its bend.
      const bool farthest = i == ear.spikelets - 1 || (nods && i == ear.spikelets / 4);
      if (farthest && ear.awn_m > 0)
        grow_awn(spikelet, spikelet.awn_tips[0], kLightAwnRadius_m, plant);
      continue;
    }
    plant.tube({.path = {spikelet.base, 0.55 * spikelet.base + 0.45 * spikelet.tip, spikelet.tip},
                .radius_m = {0, spikelet.radius_m, 0},
                .sides = 3,
                .across = spikelet.across,
                .flatness = kSpikeletFlatness},
               ear.material);
    if (ear.awn_m <= 0) continue;
    for (const Vector3d& tip : spikelet.awn_tips) grow_awn(spikelet, tip, kAwnRadius_m, plant);
  }
}

}  // namespace plotscan::crop
