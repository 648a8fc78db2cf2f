// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include <Eigen/Core>

namespace plotscan::lidar {

// The slice of a plant that at rest lies between two heights. When the plant bends, the slice is
// moved sideways, sheared and lowered, so that the stem in it keeps its length; horizontal planes
// stay horizontal. Heights are metres above the foot.
struct StemLink {
  float rest_bottom_m = 0;
  float rest_top_m = 0;
  float bottom_m = 0;  // bent
  float top_m = 0;
  Eigen::Vector2f offset_m = Eigen::Vector2f::Zero();  // how far the bottom moves sideways
  Eigen::Vector2f sideways = Eigen::Vector2f::Zero();  // for a metre of height at rest
  float upward = 1;                                    // for a metre of height at rest
};

// A stem of constant length, clamped at its foot and bent evenly: an arc that leaves the ground
// upright (near the foot x ~ z^2, like a cantilever), made of straight links of equal length. The
// lean from foot to tip is half of the slope at the tip.
class BentStem {
 public:
  static constexpr int kLinks = 8;

  // At rest the stem is upright and height_m high. The lean is a vector that points to where the
  // stem leans; its length, at most kMaxLean_rad, is the angle from the vertical to the line from
  // foot to tip.
  BentStem(float height_m, const Eigen::Vector2f& lean_rad);

  // links()[0] is everything below the foot, which does not move; the last link has no upper end.
  const std::array<StemLink, kLinks + 1>& links() const { return links_; }

  // The bent position of a point of the plant; both relative to the foot, metres.
  Eigen::Vector3f bent(const Eigen::Vector3f& rest_m) const;

 private:
  std::array<StemLink, kLinks + 1> links_;
};

// Plants that lean further are lodged and do not sway any more.
inline constexpr float kMaxLean_rad = 0.7f;

// The tip's sideways distance from the foot at this lean, which no smaller lean exceeds.
float tip_reach_m(float height_m, float lean_rad);

}  // namespace plotscan::lidar
