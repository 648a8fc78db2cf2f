// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "farm/farm.h"
#include "farm/surface_class.h"
#include "gazebo/export_options.h"

namespace plotscan::gazebo {

// Plants whose surfaces are merged: one link.
struct MergedLink {
  std::string name = "link";     // in the model
  std::string mesh_prefix = {};  // of its mesh files in the model's folder: "" or "plot_12_"
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  // of the link, world frame; no rotation
  double heading_rad = 0;                            // along which a box around it lies
  std::vector<const farm::Plant*> plants;            // in the order of the farm
};

// A static model of plants of one class.
struct MergedModel {
  std::string name;
  farm::SurfaceClass label = farm::SurfaceClass::crop;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  // world frame; no rotation
  std::vector<MergedLink> links;
};

// The models of merge `plot` or `row` with the names of naming.h, by plot or row, crop before
// weeds; then the plants outside plots, by tiles of kTile_m where they are more than kTilePlants.
std::vector<MergedModel> merged_models(const farm::Farm& farm, Merge merge);

inline constexpr double kTile_m = 10;
inline constexpr std::size_t kTilePlants = 500;

}  // namespace plotscan::gazebo
