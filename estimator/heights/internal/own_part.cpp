// SPDX-License-Identifier: Apache-2.0
#include "heights/internal/own_part.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/each_index.h"
#include "core/extent.h"
#include "core/list_of.h"
#include "core/statistics.h"

namespace plotscan::heights {
namespace {

constexpr double kReach_m = 0.6;  // of plants over their plot's side: half a leaf of maize and more
constexpr double kReachStrip_m = 0.1;
constexpr double kTaller_m = 0.05;  // less and what reaches over does not stand out
constexpr double kOwnShare = 0.99;  // of the middle's returns, below which a plot's own plants are
constexpr double kMostAbove = 0.03;
constexpr std::size_t kLeastReturns = 20;  // of the middle
constexpr int kSides = 4;                  // +length, -length, +width, -width

// A plot's box, and the part of it that no neighbour reaches.
struct Middle {
  Eigen::Vector2d half = Eigen::Vector2d::Zero();   // of the box: along its length, its width
  Eigen::Vector2d inset = Eigen::Vector2d::Zero();  // from the sides to the middle
  double own_top_m = kNaN;                          // below which its own plants are
};

Eigen::Vector2d in_box(const PlotBox& box, const Eigen::Vector3f& point) {
  return box.box_from_world(point.head<2>().cast<double>());
}

// How far the point lies inside of that side, metres.
double depth(const Middle& plot, const Eigen::Vector2d& point, int side) {
  const int axis = side / 2;
  return plot.half[axis] - (side % 2 == 0 ? point[axis] : -point[axis]);
}

Middle middle_of(const PlotPoints& plot) {
  constexpr double kInset_m = 0.5;
  constexpr double kMostShare = 1.0 / 3;
  Middle middle{.half = Eigen::Vector2d(plot.box.length_m, plot.box.width_m) / 2};
  middle.inset = (2 * kMostShare * middle.half).cwiseMin(kInset_m);
  std::vector<double> heights_m;
  for (const Eigen::Vector3f& point : plot.points) {
    const Eigen::Vector2d from_center = in_box(plot.box, point);
    if ((from_center.cwiseAbs().array() < (middle.half - middle.inset).array()).all())
      heights_m.push_back(point.z());
  }
  if (heights_m.size() >= kLeastReturns)
    middle.own_top_m = quantile(std::move(heights_m), kOwnShare);
  return middle;
}

// The side of the plot at which the other box lies; kSides where it lies at none.
int side_of(const PlotBox& box, const Middle& plot, const PlotBox& other) {
  Eigen::AlignedBox2d extent;
  for (const Eigen::Vector2d& corner : other.corners()) extent.extend(box.box_from_world(corner));
  for (int side = 0; side < kSides; ++side) {
    const int axis = side / 2, across = 1 - axis;
    const Eigen::Vector2d nearest = side % 2 == 0 ? extent.min() : extent.max();
    const double inside_m = depth(plot, nearest, side);
    const bool beside =
        extent.max()[across] > -plot.half[across] && extent.min()[across] < plot.half[across];
    if (beside && inside_m > -kReach_m && inside_m < plot.inset[axis]) return side;
  }
  return kSides;
}

// How far plants reach over that side: as far as strips hold much that is too high for the plot.
double reached_m(const PlotPoints& plot, const Middle& middle, int side) {
  const double inset_m = middle.inset[side / 2];
  const auto strips = static_cast<std::size_t>(std::ceil(inset_m / kReachStrip_m));
  std::vector<std::size_t> all(strips, 0), above(strips, 0);
  for (const Eigen::Vector3f& point : plot.points) {
    const double depth_m = std::max(0.0, depth(middle, in_box(plot.box, point), side));
    if (depth_m >= inset_m) continue;
    const auto strip = static_cast<std::size_t>(depth_m / kReachStrip_m);
    ++all[strip];
    if (point.z() > middle.own_top_m) ++above[strip];
  }
  const auto is_reached = [&](std::size_t strip) {
    return static_cast<double>(above[strip]) > kMostAbove * static_cast<double>(all[strip]);
  };
  std::size_t reached = 0;
  while (reached < strips && is_reached(reached)) ++reached;
  return std::min(inset_m, kReachStrip_m * static_cast<double>(reached));
}

// For each plot the sides at which a taller one stands.
std::vector<std::array<bool, kSides>> sides_of_taller(std::span<const PlotPoints> plots,
                                                      const std::vector<Middle>& middles) {
  std::vector<std::array<bool, kSides>> taller(plots.size(), std::array<bool, kSides>{});
  const auto extents = list_of(plots, [](const PlotPoints& plot) {
    Eigen::AlignedBox2d extent = extent_of(plot.box);
    extent.min().array() -= kReach_m / 2;
    extent.max().array() += kReach_m / 2;
    return extent;
  });
  for_each_meeting(extents, [&](std::size_t a, std::size_t b) {
    if (middles[a].own_top_m > middles[b].own_top_m) std::swap(a, b);
    if (!(middles[b].own_top_m > middles[a].own_top_m + kTaller_m)) return true;
    const int side = side_of(plots[a].box, middles[a], plots[b].box);
    if (side < kSides) taller[a][static_cast<std::size_t>(side)] = true;
    return true;
  });
  return taller;
}

OwnPart own_part(const PlotPoints& plot, const Middle& middle,
                 const std::array<bool, kSides>& taller) {
  std::array<double, kSides> cut_m = {};
  for (int side = 0; side < kSides; ++side)
    if (taller[static_cast<std::size_t>(side)])
      cut_m[static_cast<std::size_t>(side)] = reached_m(plot, middle, side);
  OwnPart part{.box = plot.box};
  part.box.center += (cut_m[1] - cut_m[0]) / 2 * plot.box.length_axis() +
                     (cut_m[3] - cut_m[2]) / 2 * plot.box.width_axis();
  part.box.length_m -= cut_m[0] + cut_m[1];
  part.box.width_m -= cut_m[2] + cut_m[3];
  part.reached = std::ranges::any_of(cut_m, [](double cut) { return cut > 0; });
  return part;
}

}  // namespace

std::vector<OwnPart> own_parts(std::span<const PlotPoints> plots, int threads) {
  std::vector<Middle> middles(plots.size());
  for_each_index(plots.size(), threads, [&](std::size_t i) { middles[i] = middle_of(plots[i]); });
  const auto taller = sides_of_taller(plots, middles);
  std::vector<OwnPart> parts(plots.size());
  for_each_index(plots.size(), threads,
                 [&](std::size_t i) { parts[i] = own_part(plots[i], middles[i], taller[i]); });
  return parts;
}

}  // namespace plotscan::heights
