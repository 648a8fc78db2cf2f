// SPDX-License-Identifier: Apache-2.0
#include <set>

#include <fmt/core.h>

#include "core/error.h"
#include "core/text.h"
#include "crop/grow.h"
#include "mesh/image_names.h"
#include "mesh/measure.h"
#include "planting/internal/plants.h"

namespace plotscan::planting {
namespace {

constexpr double kTallest_m = 120;                  // no tree is taller
constexpr double kTallCrop_m = 10;                  // no crop of a field is taller
constexpr std::size_t kMostTriangles = 20'000'000;  // of all models, scan and light: about 1 GB

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
    throw InputError(source, "model {}: {}", model.name, error.what());
  }
}

// Gives the mesh's materials the reflectances stated for their names; returns the names it has.
std::set<std::string> apply_reflectance(const std::map<std::string, float>& stated,
                                        mesh::Mesh& mesh) {
  std::set<std::string> names;
  for (mesh::Material& material : mesh.materials) {
    if (!material.name.empty()) names.insert(material.name);
    const auto found = stated.find(material.name);
    if (found != stated.end()) material.reflectance = found->second;
  }
  return names;
}

// Throws InputError when a mesh file has no material that is named. (Of a grown plant
// read_crop_reflectance has seen to it.)
void apply_reflectance(const ModelDescription& description, const std::filesystem::path& source,
                       farm::PlantModel& model) {
  const std::set<std::string> names = apply_reflectance(description.reflectance, model.mesh);
  if (model.light) apply_reflectance(description.reflectance, *model.light);
  for (const auto& [name, reflectance] : description.reflectance) {
    if (description.grown || names.contains(name)) continue;
    throw InputError(source, "model {}: reflectance: {} is not a material of {}, which has {}",
                     model.name, name, description.mesh.string(),
                     names.empty() ? "none" : joined({names.begin(), names.end()}, ", "));
  }
}

// Those whose files lie in the model's folder.
std::vector<mesh::Mesh*> meshes_of(farm::PlantModel& model) {
  std::vector<mesh::Mesh*> meshes = {&model.mesh};
  if (model.light) meshes.push_back(&*model.light);
  return meshes;
}

// In the order in which make_model takes them.
std::vector<mesh::MeshFile> files_of(const std::vector<ModelDescription>& models) {
  std::vector<mesh::MeshFile> files;
  for (const ModelDescription& model : models) {
    if (model.grown) continue;
    files.push_back({.path = model.mesh, .options = model.options});
    if (model.light) files.push_back({.path = *model.light, .options = model.options});
  }
  return files;
}

farm::PlantModel make_model(const ModelDescription& description, mesh::MeshReader& meshes,
                            const std::filesystem::path& source) {
  farm::PlantModel model{.name = description.name, .mesh = {}};
  if (description.grown) {
    model.mesh = grown(description, crop::Detail::scan, source);
    model.light = grown(description, crop::Detail::light, source);
  } else {
    mesh::ImportedMesh imported = meshes.next();
    model.mesh = std::move(imported.mesh);
    model.notes = std::move(imported.notes);
    if (description.light) model.light = meshes.next().mesh;
  }
  mesh::name_images_apart(meshes_of(model));
  apply_reflectance(description, source, model);
  model.height_m = mesh::mesh_height(model.mesh);
  if (model.height_m > kTallest_m) {
    throw InputError(description.grown ? source : description.mesh,
                     "model {} is {:.4g} m tall; a plant has up to {:.0f} m (unit_m says what the "
                     "file's numbers are)",
                     model.name, model.height_m, kTallest_m);
  }
  if (model.height_m > kTallCrop_m) {
    model.notes.push_back(fmt::format(
        "model {} is {:.4g} m tall, more than any crop of a field: unit_m says what the "
        "file's numbers are",
        model.name, model.height_m));
  }
  if (model.height_m > 0) return model;
  if (description.grown) throw InputError(source, "model {}: has no height", model.name);
  throw InputError(description.mesh,
                   "has no vertex above its origin; is z its up axis? (up: y, foot: lowest)");
}

}  // namespace

std::vector<farm::PlantModel> make_models(const std::vector<ModelDescription>& models,
                                          const std::filesystem::path& source) {
  std::vector<farm::PlantModel> made;
  made.reserve(models.size());
  mesh::MeshReader meshes(files_of(models));
  std::size_t triangles = 0;
  for (const ModelDescription& model : models) {
    made.push_back(make_model(model, meshes, source));
    triangles += made.back().mesh.triangles.size();
    if (made.back().light) triangles += made.back().light->triangles.size();
    if (triangles <= kMostTriangles) continue;
    throw InputError(source,
                     "models: the first {} of {} have {} triangles; at most {} are allowed; fewer "
                     "or simpler models would fit",
                     made.size(), models.size(), triangles, kMostTriangles);
  }
  return made;
}

}  // namespace plotscan::planting
