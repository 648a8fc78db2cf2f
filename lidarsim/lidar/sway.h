// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include <Eigen/Geometry>

#include "flight/wind.h"
#include "lidar/scene_content.h"

namespace plotscan::lidar {

// How readily plants bend; docs/sway.md says where the numbers come from.
struct SwayOptions {
  // The lean from foot to tip in a steady wind of 5 m/s at the plant's top.
  double lean_deg_at_5m_s = 3;
  // Natural frequency of a plant that is 1 m high; others swing at this / sqrt(height / 1 m).
  double hz_at_1m = 1.3;
  // Amplitude of the swinging along the wind, as a share of the lean. Across the wind it is a third
  // of that.
  double swing = 0.5;
};

// The plants that stand in the wind, as a whole.
struct Crop {
  double height_m = 0;              // mean of the plants
  Eigen::AlignedBox2d feet_m = {};  // world frame
};

// The crop that the content's rooted meshes make up.
Crop crop_of(const SceneContent& content);

// The bounding box of a placed mesh relative to its foot, along the world's axes, metres.
Eigen::AlignedBox3f box_over_foot(const mesh::Mesh& mesh, const PlacedMesh& placed);

// The mean wind at the top of a crop as a share of the one at another height over the ground: the
// logarithmic profile with a displacement height of 0.67 and a roughness length of 0.1 of the
// crop's height. 1 at heights within the crop.
double canopy_wind_share(double crop_height_m, double height_m);

// The lean of each plant of a crop over time.
class Sway {
 public:
  // What differs from plant to plant.
  struct Motion {
    double delay_s = 0;     // until a gust is here; at most 0, its value at the crop's downwind end
    double wind_share = 0;  // mean wind at the plant's top over the stated one
    double turn_rad_s = 0;  // angular frequency of its swinging
    double along_rad = 0;   // phases
    double across_rad = 0;
  };

  // `wind` holds at wind.height_m above the ground; `duration_s` is the flight's.
  Sway(const SwayOptions& options, const flight::WindOptions& wind, double duration_s,
       const Crop& crop);

  // The foot is in the world frame; height_m is the height of the plant's top above it.
  Motion motion_of(std::uint32_t plant, const Eigen::Vector2d& foot_m, double height_m) const;

  // The lean as a vector that points to where the plant leans, world frame. Its length, below
  // kMaxLean_rad, is the angle from the vertical to the line from foot to tip. Time is from
  // take-off.
  Eigen::Vector2d lean_rad(const Motion& motion, double time_s) const;

  // An upper bound of the length of lean_rad during the flight.
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
