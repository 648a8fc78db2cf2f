// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "mesh/mesh_import.h"

namespace plotscan::planting {

// A plant that is grown (crop::grow) instead of read from a file.
struct GrownPlant {
  std::string crop;
  std::string stage;  // empty: the crop's default stage
  std::uint64_t seed = 1;
  std::vector<std::string> assignments = {};  // "key=value"

  bool operator==(const GrownPlant&) const = default;
};

// An entry of a list of models in farm.yaml (docs/farm-format.md): a mesh file or a grown plant.
struct ModelDescription {
  std::string name;
  std::filesystem::path mesh;
  mesh::MeshImportOptions options;
  std::optional<std::filesystem::path> light = {};  // the same plant in few triangles
  std::optional<GrownPlant> grown = {};             // then there are no files
  std::map<std::string, float> reflectance = {};    // of materials by their names; over the model's

  bool operator==(const ModelDescription&) const = default;
};

}  // namespace plotscan::planting
