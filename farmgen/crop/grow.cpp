// SPDX-License-Identifier: Apache-2.0
#include "crop/grow.h"

#include <fmt/core.h>

#include "core/error.h"
#include "core/list_of.h"
#include "core/text.h"
#include "crop/internal/crop_files.h"
#include "crop/internal/form.h"
#include "crop/internal/textures.h"

namespace plotscan::crop {
namespace {

struct Crop {
  const char* name;  // its file is models/NAME/NAME.yaml
  Form form;
};

const std::vector<Crop>& known_crops() {
  static const std::vector<Crop> kCrops = {
      {.name = "soybean", .form = Form::soybean},
      {.name = "wheat", .form = Form::wheat},
      {.name = "maize", .form = Form::maize},
  };
  return kCrops;
}

const Crop& crop_named(const std::string& name) {
  const auto found = std::ranges::find(known_crops(), name, &Crop::name);
  if (found != known_crops().end()) return *found;
  throw InputError(fmt::format("crop {} is not known; known are {}", name, joined(crops(), ", ")));
}

void grow_organs(Form form, const Traits& traits, std::uint64_t seed, PlantBuilder& plant) {
  switch (form) {
    case Form::soybean:
      return grow_soybean(traits, seed, plant);
    case Form::wheat:
      return grow_wheat(traits, seed, plant);
    case Form::maize:
      return grow_maize(traits, seed, plant);
  }
}

}  // namespace

std::vector<std::string> crops() { return list_of<std::string>(known_crops(), &Crop::name); }

std::vector<std::string> stages(const std::string& crop) {
  return list_of(cultivar(crop).stages, &Stage::name);
}

Cultivar cultivar(const std::string& crop, const std::string& file) {
  const std::string name = crop_named(crop).name;
  Cultivar own = parse_cultivar(crop_file(name), name + ".yaml");
  return file.empty() ? own : override_cultivar(own, file);
}

StageFacts stage_facts(const std::string& crop, const std::string& stage, const std::string& file) {
  const Cultivar described = cultivar(crop, file);
  return {.stage = described.stage(stage),
          .plants_per_m2 = described.plants_per_m2,
          .row_spacing_m = described.row_spacing_m};
}

mesh::Mesh grow(const GrowOptions& options, std::uint64_t seed) {
  const Crop& crop = crop_named(options.crop);
  const Cultivar described = cultivar(options.crop, options.cultivar_file);
  const Traits traits(described, described.stage(options.stage), options.assignments);
  PlantBuilder plant(options.detail, described.colours);
  grow_organs(crop.form, traits, seed, plant);
  mesh::Mesh mesh = plant.take(options.textured);
  if (options.textured) add_textures(mesh, crop.form, options.crop);
  for (mesh::Material& material : mesh.materials) {
    const auto stated = described.reflectance.find(material.name);
    if (stated != described.reflectance.end()) material.reflectance = stated->second;
  }
  return mesh;
}

}  // namespace plotscan::crop
