// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "mesh/mesh_import.h"

namespace plotscan {
class YamlSection;
}

namespace plotscan::farm {

struct PlantModel;

// A plant that is grown in place of read (crop::grow).
struct GrownPlant {
  std::string crop;
  std::string stage;  // empty: the crop's default stage
  std::uint64_t seed = 1;
  std::vector<std::string> assignments = {};  // "key=value"
};

// An entry of a list of models in farm.yaml (docs/farm-format.md): a mesh file or a grown plant.
struct ModelDescription {
  std::string name;
  std::filesystem::path mesh;
  mesh::MeshImportOptions options;
  std::optional<std::filesystem::path> light = {};  // the same plant in few triangles
  std::optional<GrownPlant> grown = {};             // then there are no files
  std::map<std::string, float> reflectance = {};    // of materials by their names; over the model's
};

// Reads the list at the section's key "models" and puts those that `models` does not hold yet
// behind it; returns the places of all. Throws InputError as load_description does, and when two
// entries of the list, or two different models, have one name.
std::vector<std::uint32_t> read_models(const YamlSection& section,
                                       std::vector<ModelDescription>& models);

// The files that the models are read from.
std::vector<std::filesystem::path> model_files(const std::vector<ModelDescription>& models);

// Reads or grows the models. Throws InputError when a file cannot be read, a plant cannot be grown
// (naming `source`, the description), has no height, or lacks a material that is given a
// reflectance.
std::vector<PlantModel> make_models(const std::vector<ModelDescription>& models,
                                    const std::filesystem::path& source);

}  // namespace plotscan::farm
