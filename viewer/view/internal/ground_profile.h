// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "core/plot_box.h"
#include "ground/surface.h"

namespace plotscan::view {

// The ground at one place of a line.
struct ProfilePoint {
  double along_m = 0;           // from the box's start
  double z_m = 0;               // NaN where no ground is within reach
  double standard_error_m = 0;  // NaN where that is
  bool seen = false;            // at the grid's nearest node; else interpolated
};

// The ground along a plot's middle, in the direction of its length axis, from `beyond_m` before the
// box's start to as much behind its end, at steps of a quarter of the ground's grid.
std::vector<ProfilePoint> ground_profile(const ground::Surface& ground, const PlotBox& box,
                                         double beyond_m);

// A part of a profile without gaps.
using ProfileRun = std::span<const ProfilePoint>;

// The profile's parts with ground; with `by_seen` also split where seen changes to interpolated, at
// a point that belongs to both parts.
std::vector<ProfileRun> runs_of(const std::vector<ProfilePoint>& profile, bool by_seen);

}  // namespace plotscan::view
