// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include <Eigen/Core>

namespace plotscan::lidar {

// All of a plant that at rest lies between two heights. Bent, it is moved sideways as a whole,
// sheared and lowered, so that the stem in it keeps its length; what was level stays level.
// Metres over the foot.
struct StemLink {
  float rest_bottom_m = 0;
  float rest_top_m = 0;
  float bottom_m = 0;  // bent
  float top_m = 0;
  Eigen::Vector2f offset_m = Eigen::Vector2f::Zero();  // of the bottom, sideways
  Eigen::Vector2f sideways = Eigen::Vector2f::Zero();  // for a metre of height at rest
  float upward = 1;                                    // for a metre of height at rest
};

// The line from a clamped foot to the tip of a stem of unchanging length, bent evenly along it: an
// arc that leaves the ground upright, near the foot x ~ z^2 as a cantilever's; in straight links of
// equal length. The lean of the whole, from foot to tip, is half of the slope at the tip.
class BentStem {
 public:
  static constexpr int kLinks = 8;

  // The stem stands upright, so high, at rest; the lean is the angle from the vertical of the line
  // from foot to tip of the arc, as a vector to where it leans, at most kMaxLean_rad long.
  BentStem(float height_m, const Eigen::Vector2f& lean_rad);

  // links()[0] is all below the foot, which rests; the last reaches up without end.
  const std::array<StemLink, kLinks + 1>& links() const { return links_; }

  // Where a place of the plant comes to lie; both from the foot, metres.
  Eigen::Vector3f bent(const Eigen::Vector3f& rest_m) const;

 private:
  std::array<StemLink, kLinks + 1> links_;
};

// Plants that lean further are lodged and do not sway any more.
inline constexpr float kMaxLean_rad = 0.7f;

// How far the tip comes to lie to the side, at the least and for every smaller lean.
float tip_reach_m(float height_m, float lean_rad);

}  // namespace plotscan::lidar
