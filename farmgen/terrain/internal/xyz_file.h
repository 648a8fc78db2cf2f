// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include <Eigen/Core>

namespace plotscan::terrain {

// The points of a text file: x, y and z on each line, separated by spaces, tabs, commas or
// semicolons; what follows a '#' and empty lines are passed over. Throws InputError naming file and
// line on another line, a number that is not finite, a place that is given twice, fewer than three
// points or more than kMostTerrainVertices.
std::vector<Eigen::Vector3d> read_xyz(const std::filesystem::path& path);

}  // namespace plotscan::terrain
