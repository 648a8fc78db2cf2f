// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include <Eigen/Geometry>

#include "core/plot_box.h"

namespace plotscan {

// The smallest rectangle along a frame's axes (by default the world's) that holds all boxes; empty
// if there are none. `box` picks an item's box: by default the item itself, or a member of it.
template <class Items, class Member = std::identity>
Eigen::AlignedBox2d extent_of(
    const Items& items, const Member& box = {},
    const Eigen::Rotation2Dd& frame_from_world = Eigen::Rotation2Dd::Identity()) {
  Eigen::AlignedBox2d extent;
  for (const auto& item : items)
    for (const Eigen::Vector2d& corner : std::invoke(box, item).corners())
      extent.extend(frame_from_world * corner);
  return extent;
}

}  // namespace plotscan
