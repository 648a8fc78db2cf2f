// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/plot_box.h"
#include "view/internal/axes.h"
#include "view/internal/page.h"

namespace plotscan::view {

// A plot's points from the side: (distance along its length from its start, z), metres.
class SideView {
 public:
  SideView(const PlotBox& box, double beyond_m) : box_(box), beyond_m_(beyond_m) {}

  // Keeps the points between the box's long sides, up to a distance beyond its ends; evenly thinned
  // if there are more than a picture can show.
  void add(std::span<const Eigen::Vector3d> points);
  const std::vector<Eigen::Vector2d>& points() const { return points_; }
  // Points in the box, inside colour, and beyond its ends, the darker the more there are.
  Raster drawn(const Axes& axes, const Rgb& inside, const Rgb& beyond) const;

 private:
  PlotBox box_;
  double beyond_m_;
  std::vector<Eigen::Vector2d> points_;
  std::size_t stride_ = 1;  // one in this many points is kept
  std::size_t seen_ = 0;
};

}  // namespace plotscan::view
