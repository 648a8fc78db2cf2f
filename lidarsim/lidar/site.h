// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/geodesy.h"
#include "core/plot_box.h"
#include "farm/farm.h"
#include "lidar/scene_content.h"

namespace plotscan::lidar {

// What a planned flight has to cover.
struct Site {
  std::string kind;  // "farm" or "world"
  std::string name;
  std::vector<PlotBox> areas;      // world frame
  std::optional<double> ground_m;  // mean height of the ground under the areas; absent: none there
  std::optional<Anchor> anchor = {};  // of the world frame's origin
};

// A farm's plots over its terrain: the mean of its heights at their centres and corners.
Site site_of(const farm::Farm& farm);

// A world whose plots nobody states: one area, the bounding rectangle (along x and y) of all that
// is labelled crop or weed. Where nothing is, of everything but the ground, and where there is
// nothing else, of the ground. The ground is what is labelled so; where nothing is, the one surface
// of the largest extent that is no crop. Its height is the mean over a grid of rays cast down on
// it; without any under the area, the height of the area's lowest thing. Turned meshes count by the
// corners of their boxes.
Site site_of(const std::string& world_name, const SceneContent& content);

}  // namespace plotscan::lidar
