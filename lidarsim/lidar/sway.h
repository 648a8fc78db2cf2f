// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include <Eigen/Geometry>

#include "flight/wind.h"
#include "lidar/scene_content.h"

namespace plotscan::lidar {

// How readily plants bend; docs/sway.md says where the numbers come from.
struct SwayOptions {
  // From foot to tip, in a steady wind of 5 m/s at the plant's top.
  double lean_deg_at_5m_s = 3;
  // Natural frequency of a plant of 1 m; others swing at this / sqrt(height / 1 m).
  double hz_at_1m = 1.3;
  // Amplitude of the swinging as a share of the lean: along the wind, and a third of it across.
  double swing = 0.5;
};

// What stands in the wind.
struct Crop {
  double height_m = 0;              // mean of the plants
  Eigen::AlignedBox2d feet_m = {};  // world frame
};

// The content's rooted meshes.
Crop crop_of(const SceneContent& content);

// Of a placed mesh, seen from its foot along the world's axes, metres.
Eigen::AlignedBox3f box_over_foot(const mesh::Mesh& mesh, const PlacedMesh& placed);

// The mean wind at the top of a crop as a share of the one at another height over the ground: the
// logarithmic profile over a displacement of 0.67 and a roughness of 0.1 of the crop's height. At
// heights within the crop, 1.
double canopy_wind_share(double crop_height_m, double height_m);

// How each plant of a crop leans as time goes by.
class Sway {
 public:
  // One plant's part in it.
  struct Motion {
    double delay_s = 0;     // until a gust is here; negative, the most downwind plant has 0
    double wind_share = 0;  // of the mean wind at the plant's top
    double turn_rad_s = 0;  // of its swinging
    double along_rad = 0;   // phases
    double across_rad = 0;
  };

  // The wind at its height over the ground, and the flight's duration.
  Sway(const SwayOptions& options, const flight::WindOptions& wind, double duration_s,
       const Crop& crop);

  // The foot in the world frame; height of the top over it.
  Motion motion_of(std::uint32_t plant, const Eigen::Vector2d& foot_m, double height_m) const;

  // The angle of the line from foot to tip from the vertical, radians, as a vector to where it
  // leans, shorter than kMaxLean_rad; time from take-off.
  Eigen::Vector2d lean_rad(const Motion& motion, double time_s) const;

  // No lean of the flight is longer.
  double greatest_lean_rad(const Motion& motion) const;

 private:
  SwayOptions options_;
  Crop crop_;
  std::uint64_t seed_;
  double wind_height_m_;
  double slowness_s_m_;  // gusts' delay for a metre along the wind
  flight::Wind wind_;
  double greatest_gust_m_s_ = 0;
};

}  // namespace plotscan::lidar
