// SPDX-License-Identifier: Apache-2.0
#include "view/internal/top_heights.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/statistics.h"

namespace plotscan::view {
namespace {

// By pixel, both lower than any height.
constexpr float kEmpty = -std::numeric_limits<float>::infinity();
constexpr float kNoGround = -1e9F;

constexpr double kLargestFilled_px = 6;
constexpr double kPointsInDot = 4;  // on average

// The highest within `radius` pixels along a line of them.
void spread(const float* from, float* to, int count, std::ptrdiff_t stride, int radius) {
  for (int i = 0; i < count; ++i) {
    float top = kEmpty;
    for (int j = std::max(0, i - radius); j <= std::min(count - 1, i + radius); ++j)
      top = std::max(top, from[j * stride]);
    to[i * stride] = top;
  }
}

}  // namespace

TopHeights::TopHeights(const Eigen::AlignedBox2d& shown, const Eigen::Vector2i& size_px)
    : shown_(shown),
      size_px_(size_px),
      top_m_(static_cast<std::size_t>(size_px.x()) * static_cast<std::size_t>(size_px.y()),
             kEmpty) {}

void TopHeights::add(std::span<const Eigen::Vector3d> points, const ground::Surface& ground) {
  const Eigen::Vector2d px_per_m = size_px_.cast<double>().cwiseQuotient(shown_.sizes());
  for (const Eigen::Vector3d& point : points) {
    const Eigen::Vector2d place = point.head<2>();
    if (!shown_.contains(place)) continue;
    const Eigen::Vector2i px = (place - shown_.min())
                                   .cwiseProduct(px_per_m)
                                   .cast<int>()
                                   .cwiseMin(size_px_ - Eigen::Vector2i::Ones());
    const double ground_z = ground.height(place);
    const float height_m =
        std::isnan(ground_z) ? kNoGround : static_cast<float>(point.z() - ground_z);
    groundless_ = groundless_ || std::isnan(ground_z);
    float& top = top_m_[static_cast<std::size_t>(px.y()) * size_px_.x() + px.x()];
    top = std::max(top, height_m);
    ++points_;
  }
}

double TopHeights::quantile_m(double share) const {
  std::vector<double> heights;
  for (const float top : top_m_)
    if (top > kNoGround) heights.push_back(top);
  return heights.empty() ? 0 : quantile(std::move(heights), share);
}

// So that chance leaves hardly a pixel empty among points spread at random.
int TopHeights::dot_radius_px() const {
  const double pixels = static_cast<double>(top_m_.size());
  const double side_px =
      std::sqrt(kPointsInDot * pixels / std::max<double>(1, static_cast<double>(points_)));
  return static_cast<int>(std::clamp(std::ceil((side_px - 1) / 2), 1.0, kLargestFilled_px));
}

Raster TopHeights::drawn(const HeightColours& colours) const {
  const int radius = dot_radius_px();
  std::vector<float> rows(top_m_.size());
  std::vector<float> shown(top_m_.size());
  for (int y = 0; y < size_px_.y(); ++y) {
    const std::size_t first = static_cast<std::size_t>(y) * size_px_.x();
    spread(&top_m_[first], &rows[first], size_px_.x(), 1, radius);
  }
  for (int x = 0; x < size_px_.x(); ++x)
    spread(&rows[x], &shown[x], size_px_.y(), size_px_.x(), radius);

  Raster raster{.width = size_px_.x(), .height = size_px_.y()};
  raster.pixels.reserve(shown.size());
  for (std::size_t i = 0; i < shown.size(); ++i) {
    // Only empty pixels take their neighbours' heights: leaves keep their outlines.
    const float top = top_m_[i] == kEmpty ? shown[i] : top_m_[i];
    if (top == kEmpty)
      raster.pixels.push_back(kWhite);
    else
      raster.pixels.push_back(top == kNoGround ? kNoGroundColour : colours.of(top));
  }
  return raster;
}

}  // namespace plotscan::view
