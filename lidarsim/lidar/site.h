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
  std::optional<double> ground_m;  // mean height of the ground under the areas; absent: no ground
  std::optional<Anchor> anchor = {};  // of the world frame's origin
};

// The site of a farm: its plots. ground_m is the mean terrain height at their centres and corners.
Site site_of(const farm::Farm& farm);

// The site of a world, in which no plots are stated. It has one area: the bounding rectangle (along
// x and y) of everything labelled crop or weed; if there is none, of everything but the ground; if
// there is nothing else, of the ground. Ground is what is labelled so; if nothing is, the largest
// surface that is no crop or weed. ground_m is the mean over a grid of rays cast down on it; if
// none hits, the lowest z of the area's content. A turned mesh counts by the box around its turned
// bounding box.
Site site_of(const std::string& world_name, const SceneContent& content);

}  // namespace plotscan::lidar
