// SPDX-License-Identifier: Apache-2.0
#include "view/internal/side_view.h"

#include <algorithm>
#include <cmath>

#include "view/internal/height_colours.h"

namespace plotscan::view {
namespace {

constexpr std::size_t kMostPoints = 1'000'000;
constexpr double kOpacity = 0.55;  // of one point
// Fewer points have larger dots, which would cover this share of the frame side by side.
constexpr double kCover = 0.12;
constexpr double kSmallestDot_px = 2;
constexpr double kLargestDot_px = 6;

}  // namespace

void SideView::add(std::span<const Eigen::Vector3d> points) {
  for (const Eigen::Vector3d& point : points) {
    const Eigen::Vector2d place = box_.box_from_world(point.head<2>());
    if (std::abs(place.y()) > box_.width_m / 2) continue;
    if (std::abs(place.x()) > box_.length_m / 2 + beyond_m_) continue;
    if (seen_++ % stride_ != 0) continue;
    points_.emplace_back(place.x() + box_.length_m / 2, point.z());
    if (points_.size() < kMostPoints) continue;
    for (std::size_t i = 0; 2 * i < points_.size(); ++i) points_[i] = points_[2 * i];
    points_.resize((points_.size() + 1) / 2);
    stride_ *= 2;
  }
}

Raster SideView::drawn(const Axes& axes, const Rgb& inside, const Rgb& beyond) const {
  const Eigen::Vector2i size = axes.frame_px.sizes().cast<int>();
  const double pixels = static_cast<double>(size.x()) * size.y();
  const double share_px = std::sqrt(kCover * pixels / static_cast<double>(points_.size()));
  const int dot_px = static_cast<int>(std::clamp(share_px, kSmallestDot_px, kLargestDot_px));
  std::vector<int> count(static_cast<std::size_t>(pixels), 0);
  for (const Eigen::Vector2d& point : points_) {
    const Eigen::Vector2d px = axes.at(point) - axes.frame_px.min();
    const int left = static_cast<int>(std::floor(px.x() - dot_px / 2.0 + 0.5));
    const int low = static_cast<int>(std::floor(px.y() - dot_px / 2.0 + 0.5));
    for (int y = std::max(0, low); y < std::min(size.y(), low + dot_px); ++y)
      for (int x = std::max(0, left); x < std::min(size.x(), left + dot_px); ++x)
        ++count[static_cast<std::size_t>(y) * size.x() + x];
  }
  Raster raster{.width = size.x(), .height = size.y()};
  raster.pixels.reserve(count.size());
  const double start_px = axes.at({0, 0}).x() - axes.frame_px.min().x();
  const double end_px = axes.at({box_.length_m, 0}).x() - axes.frame_px.min().x();
  for (std::size_t i = 0; i < count.size(); ++i) {
    const double x = static_cast<double>(i % static_cast<std::size_t>(size.x())) + 0.5;
    const Rgb& ink = x >= start_px && x <= end_px ? inside : beyond;
    raster.pixels.push_back(mixed(kWhite, ink, 1 - std::pow(1 - kOpacity, count[i])));
  }
  return raster;
}

}  // namespace plotscan::view
