// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <limits>
#include <set>

#include "core/list_of.h"
#include "core/yaml_section.h"
#include "crop/grow.h"
#include "description/internal/sections.h"
#include "description/internal/shared_keys.h"

namespace plotscan::description {
namespace {

constexpr std::size_t kMostModels = 1000;
constexpr std::size_t kMostAssignments = 1000;
constexpr std::int64_t kMostVariants = 1000;

std::map<std::string, float> read_reflectance(const YamlSection& section) {
  std::map<std::string, float> reflectance;
  if (!section.has("reflectance")) return reflectance;
  const YamlSection given = section.section("reflectance");
  for (const std::string& material : given.keys())
    reflectance[material] = static_cast<float>(reflectance_at(given, material));
  return reflectance;
}

// Reflectances of a crop's materials. The crop's file names all of them; a plant may lack some at
// its stage.
std::map<std::string, float> read_crop_reflectance(const YamlSection& section,
                                                   const std::string& crop) {
  if (!section.has("reflectance")) return {};
  const auto materials =
      list_of(crop::cultivar(crop).colours, [](const auto& colour) { return colour.first; });
  section.section("reflectance").allow_only(materials);
  return read_reflectance(section);
}

planting::ModelDescription read_mesh_model(const YamlSection& section) {
  planting::ModelDescription model;
  model.mesh = file_at(section, "mesh");
  model.name = name_at(section, "name", model.mesh.stem().string());
  model.options = read_mesh_options(section);
  if (section.choice("foot", {"origin", "lowest"}, 0) == 1)
    model.options.foot = mesh::MeshFoot::lowest;
  if (section.has("light")) model.light = file_at(section, "light");
  model.reflectance = read_reflectance(section);
  return model;
}

planting::GrownPlant read_grown_plant(const YamlSection& section) {
  const std::vector<std::string> crops = crop::crops();
  planting::GrownPlant plant{.crop = crops[section.choice("crop", crops)], .stage = ""};
  if (section.has("stage")) {
    const std::vector<std::string> stages = crop::stages(plant.crop);
    plant.stage = stages[section.choice("stage", stages)];
  }
  if (section.has("seed")) plant.seed = section.unsigned_integer("seed");
  if (!section.has("set")) return plant;
  for (const YamlSection& entry : section.list("set", kMostAssignments, "assignment"))
    plant.assignments.push_back(entry.text("assignment"));
  return plant;
}

// One plant, or as many variants of it, each of the next seed.
std::vector<planting::ModelDescription> read_grown_models(const YamlSection& section) {
  const planting::GrownPlant first = read_grown_plant(section);
  const std::map<std::string, float> reflectance = read_crop_reflectance(section, first.crop);
  const std::int64_t variants = section.integer("variants", 1, kMostVariants, 1);
  const std::string kind = first.crop + (first.stage.empty() ? "" : "_") + first.stage;
  const std::string name = name_at(section, "name", kind);
  if (first.seed >
      std::numeric_limits<std::uint64_t>::max() - static_cast<std::uint64_t>(variants - 1))
    section.fail("variants", "need seeds after the largest there is; a smaller seed leaves some");
  std::vector<planting::ModelDescription> models;
  for (std::int64_t i = 0; i < variants; ++i) {
    planting::GrownPlant plant = first;
    plant.seed += static_cast<std::uint64_t>(i);
    std::string own = name;
    if (!section.has("name"))
      own += "_s" + std::to_string(plant.seed);
    else if (section.has("variants"))
      own += "_" + std::to_string(i + 1);
    planting::ModelDescription& model = models.emplace_back();
    model.name = own;
    model.grown = std::move(plant);
    model.reflectance = reflectance;
  }
  return models;
}

std::vector<planting::ModelDescription> read_entry(const YamlSection& section) {
  std::vector<planting::ModelDescription> models =
      section.has("crop") ? read_grown_models(section)
                          : std::vector<planting::ModelDescription>{read_mesh_model(section)};
  for (const planting::ModelDescription& model : models)
    if (model.name == "terrain") section.fail("name", "\"terrain\" is the terrain's own name");
  return models;
}

}  // namespace

std::vector<std::uint32_t> read_models(const YamlSection& section,
                                       std::vector<planting::ModelDescription>& models) {
  std::vector<std::uint32_t> places;
  std::set<std::string> names;
  for (const YamlSection& entry : section.list("models", kMostModels, "mesh")) {
    for (planting::ModelDescription& model : read_entry(entry)) {
      if (!names.insert(model.name).second) {
        section.fail("models", "has two models named \"{}\"; give one of them another name",
                     model.name);
      }
      const auto known = std::ranges::find(models, model.name, &planting::ModelDescription::name);
      if (known != models.end() && *known != model) {
        section.fail("models",
                     "names a model \"{}\", and another list names another one so; give one of "
                     "them another name",
                     model.name);
      }
      if (known == models.end() && models.size() == kMostModels)
        section.fail("models", "make more than {} models in the whole farm", kMostModels);
      places.push_back(static_cast<std::uint32_t>(known - models.begin()));
      if (known == models.end()) models.push_back(std::move(model));
    }
  }
  return places;
}

}  // namespace plotscan::description
