// SPDX-License-Identifier: Apache-2.0
#include "view/internal/box_labels.h"

#include <algorithm>

#include "core/angle.h"
#include "view/internal/page.h"

namespace plotscan::view {
namespace {

// As shares of the largest text.
constexpr double kSmallest = 0.5;    // legible
constexpr double kLevelUpTo = 0.75;  // smaller level text gives way to text along the boxes
constexpr double kAir = 0.15;        // around a text, of its size
constexpr double kBetween = 1.5;     // between thinned labels, of their size

// Background of a label of that size and direction, a box with its length along the text.
PlotBox background(const BoxLabel& label, double size_px, double turn_rad) {
  const Eigen::Vector2d text = text_size_px(label.text, {.size_px = size_px, .bold = true});
  const double air = 2 * kAir * size_px;
  return {.center = label.box_px.center,
          .width_m = text.y() + air,
          .length_m = text.x() + air,
          .heading_rad = turn_rad};
}

bool fits(const BoxLabel& label, double size_px, double turn_rad) {
  const auto corners = background(label, size_px, turn_rad).corners();
  return std::ranges::all_of(corners,
                             [&](const auto& corner) { return label.box_px.contains(corner); });
}

// Along the longer side of the box, read from left to right.
double turn_along(const PlotBox& box) {
  const double heading = box.length_m >= box.width_m ? box.heading_rad : box.heading_rad + kPi / 2;
  const double turn = wrap_heading(heading);
  return turn > kPi / 2 + 1e-6 ? turn - kPi : turn;
}

// The largest size at which the widest label fits its box.
double fitting_size(const std::vector<BoxLabel>& labels, double largest_px, bool along) {
  double size_px = largest_px;
  while (size_px > kSmallest * largest_px) {
    const bool all = std::ranges::all_of(labels, [&](const BoxLabel& label) {
      return fits(label, size_px, along ? turn_along(label.box_px) : 0);
    });
    if (all) return size_px;
    size_px *= 0.95;
  }
  return 0;
}

}  // namespace

std::vector<PlacedLabel> place_labels(const std::vector<BoxLabel>& labels, double largest_px) {
  double size_px = fitting_size(labels, largest_px, false);
  const double along_px =
      size_px < kLevelUpTo * largest_px ? fitting_size(labels, largest_px, true) : 0;
  const bool along = along_px > size_px;
  size_px = std::max(size_px, along_px);
  const bool thinned = size_px == 0;
  if (thinned) size_px = kSmallest * largest_px;

  std::vector<std::size_t> order;
  for (const bool important : {true, false}) {
    for (std::size_t i = 0; i < labels.size(); ++i)
      if (labels[i].important == important) order.push_back(i);
  }
  std::vector<PlacedLabel> placed;
  std::vector<PlotBox> taken;
  for (const std::size_t i : order) {
    const double turn_rad = along ? turn_along(labels[i].box_px) : 0;
    const PlotBox box = background(labels[i], size_px, turn_rad);
    PlotBox needed = box;
    needed.width_m += kBetween * size_px;
    needed.length_m += kBetween * size_px;
    const bool free = !thinned || std::ranges::none_of(taken, [&](const PlotBox& other) {
      return intersection_area(needed, other) > 0;
    });
    if (!free) continue;
    const auto corners = box.corners();
    placed.push_back({i, size_px, turn_rad, {corners.begin(), corners.end()}});
    taken.push_back(box);
  }
  return placed;
}

}  // namespace plotscan::view
