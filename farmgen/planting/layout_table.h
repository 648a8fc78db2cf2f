// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "farm/farm.h"

namespace plotscan::planting {

// One line of a table of plants.
struct LayoutPlant {
  std::uint32_t model = 0;  // index into the model names
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  std::optional<double> z_m;  // absent: the foot is on the terrain
  Eigen::Vector3d scale = Eigen::Vector3d::Ones();
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  std::optional<std::uint32_t> plot;
  farm::PlantKind kind = farm::PlantKind::crop;
  std::size_t line = 0;  // in the table's file, for messages
};

// The names that a table's columns may have (docs/farm-format.md).
std::vector<std::string> layout_columns();

// Reads a CSV of plants. `column_names` maps ours to the table's where they differ; `models` are
// the names that the model column may hold. Throws InputError on a missing or unknown column, a
// value that is no number, a scale outside [0.01, 100], an unknown model, an id out of order.
std::vector<LayoutPlant> read_layout_table(const std::filesystem::path& file,
                                           const std::map<std::string, std::string>& column_names,
                                           const std::vector<std::string>& models);

}  // namespace plotscan::planting
