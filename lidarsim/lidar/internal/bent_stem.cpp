// SPDX-License-Identifier: Apache-2.0
#include "lidar/internal/bent_stem.h"

#include <cmath>
#include <limits>

namespace plotscan::lidar {

BentStem::BentStem(float height_m, const Eigen::Vector2f& lean_rad) {
  constexpr float kEndless = std::numeric_limits<float>::infinity();
  const float lean = lean_rad.norm();
  const Eigen::Vector2f direction = lean > 0 ? (lean_rad / lean).eval() : Eigen::Vector2f::Zero();
  // The slope is turn / 2 in the first link and grows by `turn` from link to link.
  const float turn = 2 * lean / kLinks;
  const float sin_turn = std::sin(turn);
  const float cos_turn = std::cos(turn);
  float sine = std::sin(turn / 2);
  float cosine = std::cos(turn / 2);
  const float length_m = height_m / kLinks;
  links_[0] = {.rest_bottom_m = -kEndless, .bottom_m = -kEndless};
  for (int i = 1; i <= kLinks; ++i) {
    const StemLink& below = links_[static_cast<std::size_t>(i - 1)];
    const float below_m = i == 1 ? 0 : length_m;
    links_[static_cast<std::size_t>(i)] = {.rest_bottom_m = below.rest_top_m,
                                           .rest_top_m = length_m * static_cast<float>(i),
                                           .bottom_m = below.top_m,
                                           .top_m = below.top_m + length_m * cosine,
                                           .offset_m = below.offset_m + below_m * below.sideways,
                                           .sideways = sine * direction,
                                           .upward = cosine};
    const float next_sine = sine * cos_turn + cosine * sin_turn;
    cosine = cosine * cos_turn - sine * sin_turn;
    sine = next_sine;
  }
  links_[kLinks].rest_top_m = kEndless;
  links_[kLinks].top_m = kEndless;
}

Eigen::Vector3f BentStem::bent(const Eigen::Vector3f& rest_m) const {
  if (rest_m.z() <= 0) return rest_m;
  std::size_t i = 1;
  while (rest_m.z() > links_[i].rest_top_m) ++i;
  const StemLink& link = links_[i];
  const float in_link_m = rest_m.z() - link.rest_bottom_m;
  Eigen::Vector3f bent_m;
  bent_m << rest_m.head<2>() + link.offset_m + in_link_m * link.sideways,
      link.bottom_m + in_link_m * link.upward;
  return bent_m;
}

float tip_reach_m(float height_m, float lean_rad) {
  // The sum of the sines of the links' slopes, in closed form.
  if (lean_rad <= 0) return 0;
  const float half_turn = lean_rad / BentStem::kLinks;
  const float sine = std::sin(lean_rad);
  return height_m / BentStem::kLinks * sine * sine / std::sin(half_turn);
}

}  // namespace plotscan::lidar
