// SPDX-License-Identifier: Apache-2.0
#include "lidar/sway.h"

#include <algorithm>
#include <cmath>

#include "core/angle.h"
#include "core/random.h"
#include "lidar/internal/bent_stem.h"

namespace plotscan::lidar {
namespace {

constexpr double kReferenceWind_m_s = 5;
// Gusts travel over a crop at 1.8 times the mean wind at its top, and have there about three
// quarters of their strength further up, while the mean wind is only a fraction of that further up
// (Finnigan, Annual Review of Fluid Mechanics 32, 2000; Raupach, Finnigan and Brunet,
// Boundary-Layer Meteorology 78, 1996: standard deviations along the wind of 1.8 friction
// velocities at a canopy's top, 2.5 above).
constexpr double kGustSpeed = 1.8;
constexpr double kGustShare = 1.8 / 2.5;
// The longest time that gusts take to cross a field: a wind that would need longer is treated as
// faster.
constexpr double kLongestDelay_s = 600;
// A swinging ear describes an ellipse (Farquhar et al., Journal of Applied Mechanics 67, 2000); its
// axis ratio is our choice.
constexpr double kAcross = 1.0 / 3;
// Lower plants get the wind and the frequency of a plant of this height.
constexpr double kLeastHeight_m = 0.02;

double slowness_s_m(const flight::WindOptions& wind, const Crop& crop) {
  const double speed_m_s =
      kGustSpeed * canopy_wind_share(crop.height_m, wind.height_m) * wind.mean_m_s;
  const double way_m = crop.feet_m.isEmpty() ? 0 : crop.feet_m.diagonal().norm();
  return way_m < kLongestDelay_s * speed_m_s ? 1 / speed_m_s
                                             : kLongestDelay_s / std::max(way_m, 1.0);
}

double longest_delay_s(const Crop& crop, double slowness) {
  return crop.feet_m.isEmpty() ? 0 : slowness * crop.feet_m.diagonal().norm();
}

// The further a plant is bent, the less wind it catches (de Langre, Annual Review of Fluid
// Mechanics 40, 2008); this particular law is our choice.
double limited(double lean_rad) {
  constexpr double kMost = kMaxLean_rad;
  return kMost * std::tanh(lean_rad / kMost);
}

}  // namespace

double canopy_wind_share(double crop_height_m, double height_m) {
  constexpr double kDisplacement = 0.67;
  constexpr double kRoughness = 0.1;
  const double crop_m = std::max(crop_height_m, kLeastHeight_m);
  if (height_m <= crop_m) return 1;
  return std::log((1 - kDisplacement) / kRoughness) /
         std::log((height_m - kDisplacement * crop_m) / (kRoughness * crop_m));
}

Eigen::AlignedBox3f box_over_foot(const mesh::Mesh& mesh, const PlacedMesh& placed) {
  const Eigen::Matrix3f turn = placed.world_from_mesh.linear().cast<float>();
  Eigen::AlignedBox3f box;
  for (const Eigen::Vector3f& vertex : mesh.vertices) box.extend(turn * vertex);
  return box;
}

Crop crop_of(const SceneContent& content) {
  Crop crop;
  int plants = 0;
  for (const PlacedMesh& placed : content.placed) {
    if (!placed.rooted) continue;
    const Eigen::AlignedBox3f box = box_over_foot(content.meshes[placed.mesh], placed);
    crop.height_m += static_cast<double>(box.max().z());
    crop.feet_m.extend(placed.world_from_mesh.translation().head<2>());
    ++plants;
  }
  if (plants > 0) crop.height_m /= plants;
  return crop;
}

Sway::Sway(const SwayOptions& options, const flight::WindOptions& wind, double duration_s,
           const Crop& crop)
    : options_(options),
      crop_(crop),
      seed_(wind.seed),
      wind_height_m_(wind.height_m),
      slowness_s_m_(slowness_s_m(wind, crop)),
      wind_(wind, duration_s + longest_delay_s(crop, slowness_s_m_)) {
  const double end_s = duration_s + longest_delay_s(crop, slowness_s_m_);
  const auto steps = static_cast<std::int64_t>(end_s / flight::Wind::kStep_s) + 1;
  for (std::int64_t step = 0; step <= steps; ++step) {
    const double time_s = static_cast<double>(step) * flight::Wind::kStep_s;
    const Eigen::Vector3d gust_m_s = wind_.velocity_m_s(time_s) - wind_.mean_m_s();
    greatest_gust_m_s_ = std::max(greatest_gust_m_s_, gust_m_s.head<2>().norm());
  }
}

Sway::Motion Sway::motion_of(std::uint32_t plant, const Eigen::Vector2d& foot_m,
                             double height_m) const {
  constexpr double kTurn = 2 * kPi;
  const double top_m = std::max(height_m, kLeastHeight_m);
  RandomStream stream(seed_, random_purpose("sway phase"), plant);
  Motion motion{.wind_share = canopy_wind_share(top_m, wind_height_m_),
                .turn_rad_s = kTurn * options_.hz_at_1m / std::sqrt(top_m),
                .along_rad = stream.uniform(0, kTurn),
                .across_rad = stream.uniform(0, kTurn)};
  const Eigen::Vector2d mean_m_s = wind_.mean_m_s().head<2>();
  if (mean_m_s.isZero(0) || crop_.feet_m.isEmpty()) return motion;
  const Eigen::Vector2d downwind = mean_m_s.normalized();
  const double last_m = crop_.feet_m.center().dot(downwind) + crop_.feet_m.diagonal().norm() / 2;
  motion.delay_s = (foot_m.dot(downwind) - last_m) * slowness_s_m_;
  return motion;
}

Eigen::Vector2d Sway::lean_rad(const Motion& motion, double time_s) const {
  const Eigen::Vector2d mean_m_s = wind_.mean_m_s().head<2>();
  const Eigen::Vector2d gust_m_s = wind_.velocity_m_s(time_s - motion.delay_s).head<2>() - mean_m_s;
  const Eigen::Vector2d wind =
      (motion.wind_share * mean_m_s + kGustShare * gust_m_s) / kReferenceWind_m_s;
  const Eigen::Vector2d steady = radians(options_.lean_deg_at_5m_s) * wind.norm() * wind;
  const double along = options_.swing * std::sin(motion.turn_rad_s * time_s + motion.along_rad);
  const double across =
      kAcross * options_.swing * std::sin(motion.turn_rad_s * time_s + motion.across_rad);
  const Eigen::Vector2d lean =
      (1 + along) * steady + across * Eigen::Vector2d(-steady.y(), steady.x());
  const double length = lean.norm();
  return length > 0 ? (limited(length) / length * lean).eval() : lean;
}

double Sway::greatest_lean_rad(const Motion& motion) const {
  const double wind =
      (motion.wind_share * wind_.mean_m_s().norm() + kGustShare * greatest_gust_m_s_) /
      kReferenceWind_m_s;
  const double steady = radians(options_.lean_deg_at_5m_s) * wind * wind;
  return limited(steady * std::hypot(1 + options_.swing, kAcross * options_.swing));
}

}  // namespace plotscan::lidar
