// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <functional>
#include <numeric>
#include <vector>

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

inline Eigen::AlignedBox2d extent_of(const PlotBox& box) { return extent_of(std::array{box}); }

// Calls visit(i, j) for each pair of extents that have area in common, i being the one that starts
// farther left, until it returns false.
template <class Visit>
void for_each_meeting(const std::vector<Eigen::AlignedBox2d>& extents, const Visit& visit) {
  std::vector<std::size_t> order(extents.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return extents[i].min().x(); });
  for (auto one = order.begin(); one != order.end(); ++one) {
    for (auto other = std::next(one); other != order.end(); ++other) {
      if (extents[*other].min().x() >= extents[*one].max().x()) break;
      const bool apart = extents[*other].min().y() >= extents[*one].max().y() ||
                         extents[*one].min().y() >= extents[*other].max().y();
      if (!apart && !visit(*one, *other)) return;
    }
  }
}

}  // namespace plotscan
