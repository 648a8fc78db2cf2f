// SPDX-License-Identifier: Apache-2.0
#include "farm/model_description.h"

#include <algorithm>
#include <limits>
#include <set>

#include "core/error.h"
#include "core/text.h"
#include "core/yaml_section.h"
#include "crop/grow.h"
#include "farm/description_values.h"
#include "farm/farm.h"
#include "mesh/measure.h"

namespace plotscan::farm {
namespace {

constexpr std::size_t kMostModels = 1000;
constexpr std::size_t kMostAssignments = 1000;
constexpr std::int64_t kMostVariants = 1000;
constexpr double kTallest_m = 120;                  // no tree is taller
constexpr std::size_t kMostTriangles = 20'000'000;  // of all models, scan and light: about 1 GB

std::map<std::string, float> read_reflectance(const YamlSection& section) {
  std::map<std::string, float> reflectance;
  if (!section.has("reflectance")) return reflectance;
  const YamlSection given = section.section("reflectance");
  for (const std::string& material : given.keys())
    reflectance[material] = static_cast<float>(reflectance_at(given, material));
  return reflectance;
}

// Of a crop's materials, all of which its file names; a plant may lack some at its stage.
std::map<std::string, float> read_crop_reflectance(const YamlSection& section,
                                                   const std::string& crop) {
  if (!section.has("reflectance")) return {};
  std::vector<std::string> materials;
  for (const auto& [material, colour] : crop::cultivar(crop).colours) materials.push_back(material);
  section.section("reflectance").allow_only(materials);
  return read_reflectance(section);
}

ModelDescription read_mesh_model(const YamlSection& section) {
  section.allow_only({"mesh", "name", "up", "unit_m", "foot", "light", "reflectance"});
  ModelDescription model;
  model.mesh = file_at(section, "mesh");
  model.name = name_at(section, "name", model.mesh.stem().string());
  model.options = read_mesh_options(section);
  if (section.choice("foot", {"origin", "lowest"}, 0) == 1)
    model.options.foot = mesh::MeshFoot::lowest;
  if (section.has("light")) model.light = file_at(section, "light");
  model.reflectance = read_reflectance(section);
  return model;
}

GrownPlant read_grown_plant(const YamlSection& section) {
  const std::vector<std::string> crops = crop::crops();
  GrownPlant plant{.crop = crops[section.choice("crop", crops)], .stage = ""};
  if (section.has("stage")) {
    const std::vector<std::string> stages = crop::stages(plant.crop);
    plant.stage = stages[section.choice("stage", stages)];
  }
  if (section.has("seed")) plant.seed = section.unsigned_integer("seed");
  if (!section.has("set")) return plant;
  for (const YamlSection& entry : section.list("set", kMostAssignments, "assignment")) {
    entry.allow_only({"assignment"});
    plant.assignments.push_back(entry.text("assignment"));
  }
  return plant;
}

// One plant, or as many variants of it, each of the next seed.
std::vector<ModelDescription> read_grown_models(const YamlSection& section) {
  section.allow_only({"crop", "stage", "seed", "set", "name", "variants", "reflectance"});
  const GrownPlant first = read_grown_plant(section);
  const std::map<std::string, float> reflectance = read_crop_reflectance(section, first.crop);
  const std::int64_t variants = section.integer("variants", 1, kMostVariants, 1);
  const std::string kind = first.crop + (first.stage.empty() ? "" : "_") + first.stage;
  const std::string name = name_at(section, "name", kind);
  std::vector<ModelDescription> models;
  for (std::int64_t i = 0; i < variants; ++i) {
    GrownPlant plant = first;
    plant.seed += static_cast<std::uint64_t>(i);
    std::string own = name;
    if (!section.has("name")) {
      own += "_s" + std::to_string(plant.seed);
    } else if (section.has("variants")) {
      own += "_" + std::to_string(i + 1);
    }
    ModelDescription& model = models.emplace_back();
    model.name = own;
    model.grown = std::move(plant);
    model.reflectance = reflectance;
  }
  return models;
}

std::vector<ModelDescription> read_entry(const YamlSection& section) {
  std::vector<ModelDescription> models =
      section.has("crop") ? read_grown_models(section)
                          : std::vector<ModelDescription>{read_mesh_model(section)};
  for (const ModelDescription& model : models) {
    if (model.name == "terrain") section.fail("name", "\"terrain\" is the terrain's own name");
  }
  return models;
}

bool same(const GrownPlant& a, const GrownPlant& b) {
  return a.crop == b.crop && a.stage == b.stage && a.seed == b.seed &&
         a.assignments == b.assignments;
}

bool same(const ModelDescription& a, const ModelDescription& b) {
  const bool same_grown = a.grown && b.grown ? same(*a.grown, *b.grown) : !a.grown && !b.grown;
  return same_grown && a.mesh == b.mesh && a.light == b.light && a.options.up == b.options.up &&
         a.options.unit_m == b.options.unit_m && a.options.foot == b.options.foot &&
         a.reflectance == b.reflectance;
}

// The light mesh is for simulators, which show leaves as pictures; the scan mesh is for lasers.
mesh::Mesh grown(const ModelDescription& model, crop::Detail detail,
                 const std::filesystem::path& source) {
  const GrownPlant& plant = *model.grown;
  try {
    return crop::grow({.crop = plant.crop,
                       .stage = plant.stage,
                       .assignments = plant.assignments,
                       .detail = detail,
                       .textured = detail == crop::Detail::light},
                      plant.seed);
  } catch (const InputError& error) {
    throw InputError(source, "model " + model.name + ": " + error.what());
  }
}

// Gives the mesh's materials the reflectances stated for their names; returns the names it has.
std::set<std::string> apply_reflectance(const std::map<std::string, float>& stated,
                                        mesh::Mesh& mesh) {
  std::set<std::string> names;
  for (mesh::Material& material : mesh.materials) {
    names.insert(material.name);
    const auto found = stated.find(material.name);
    if (found != stated.end()) material.reflectance = found->second;
  }
  return names;
}

// Throws InputError when a mesh file has no material that is named. (Of a grown plant
// read_crop_reflectance has seen to it.)
void apply_reflectance(const ModelDescription& description, const std::filesystem::path& source,
                       PlantModel& model) {
  const std::set<std::string> names = apply_reflectance(description.reflectance, model.mesh);
  if (model.light) apply_reflectance(description.reflectance, *model.light);
  for (const auto& [name, reflectance] : description.reflectance) {
    if (description.grown || names.contains(name)) continue;
    throw InputError(source, "model " + model.name + ": reflectance: " + name +
                                 " is not a material of " + description.mesh.string() +
                                 ", which has " + joined({names.begin(), names.end()}, ", "));
  }
}

PlantModel make_model(const ModelDescription& description, const std::filesystem::path& source) {
  PlantModel model{.name = description.name, .mesh = {}};
  if (description.grown) {
    model.mesh = grown(description, crop::Detail::scan, source);
    model.light = grown(description, crop::Detail::light, source);
  } else {
    model.mesh = mesh::import_mesh(description.mesh, description.options, &model.notes);
    if (description.light) model.light = mesh::import_mesh(*description.light, description.options);
  }
  apply_reflectance(description, source, model);
  model.height_m = mesh::mesh_height(model.mesh);
  if (model.height_m > kTallest_m) {
    throw InputError(description.grown ? source : description.mesh,
                     "model " + model.name + formatted(" is %.4g m tall", model.height_m) +
                         formatted("; a plant has up to %.0f m (unit_m says what the file's "
                                   "numbers are)",
                                   kTallest_m));
  }
  if (model.height_m > 0) return model;
  if (description.grown) throw InputError(source, "model " + model.name + ": has no height");
  throw InputError(description.mesh,
                   "has no vertex above its origin; is z its up axis? (up: y, foot: lowest)");
}

}  // namespace

std::vector<std::uint32_t> read_models(const YamlSection& section,
                                       std::vector<ModelDescription>& models) {
  std::vector<std::uint32_t> places;
  std::set<std::string> names;
  for (const YamlSection& entry : section.list("models", kMostModels, "mesh")) {
    for (ModelDescription& model : read_entry(entry)) {
      if (!names.insert(model.name).second) {
        section.fail("models",
                     "has two models named \"" + model.name + "\"; give one of them another name");
      }
      const auto known = std::find_if(models.begin(), models.end(),
                                      [&](const auto& other) { return other.name == model.name; });
      if (known != models.end() && !same(*known, model)) {
        section.fail("models", "names a model \"" + model.name +
                                   "\", and another list names another one so; give one of them "
                                   "another name");
      }
      if (known == models.end() && models.size() == kMostModels) {
        section.fail("models",
                     "make more than " + std::to_string(kMostModels) + " models in the whole farm");
      }
      places.push_back(static_cast<std::uint32_t>(known - models.begin()));
      if (known == models.end()) models.push_back(std::move(model));
    }
  }
  return places;
}

std::vector<std::filesystem::path> model_files(const std::vector<ModelDescription>& models) {
  std::vector<std::filesystem::path> files;
  for (const ModelDescription& model : models) {
    if (!model.grown) files.push_back(model.mesh);
    if (model.light) files.push_back(*model.light);
  }
  return files;
}

std::vector<PlantModel> make_models(const std::vector<ModelDescription>& models,
                                    const std::filesystem::path& source) {
  std::vector<PlantModel> made;
  made.reserve(models.size());
  std::size_t triangles = 0;
  for (const ModelDescription& model : models) {
    made.push_back(make_model(model, source));
    triangles += made.back().mesh.triangles.size();
    if (made.back().light) triangles += made.back().light->triangles.size();
    if (triangles <= kMostTriangles) continue;
    throw InputError(source, "models: the first " + std::to_string(made.size()) + " of " +
                                 std::to_string(models.size()) + " have " +
                                 std::to_string(triangles) + " triangles; at most " +
                                 std::to_string(kMostTriangles) +
                                 " are allowed; fewer or simpler models would fit");
  }
  return made;
}

}  // namespace plotscan::farm
