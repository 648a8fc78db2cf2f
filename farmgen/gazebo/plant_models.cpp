// SPDX-License-Identifier: Apache-2.0
#include "gazebo/plant_models.h"

#include <algorithm>
#include <mutex>
#include <set>
#include <string_view>

#include <tbb/parallel_for.h>

#include "core/contains.h"
#include "core/list_of.h"
#include "farm/surface_colours.h"
#include "gazebo/internal/obj_file.h"
#include "mesh/obj.h"

namespace plotscan::gazebo {
namespace fs = std::filesystem;
namespace {

// Directions of normals: 64^2 are 2 degrees apart, enough for leaves; smooth ground shows more.
constexpr int kPlantNormals = 64;
constexpr int kGroundNormals = 1024;

// Leaves and soil do not shine, for renderers of the plain model and of the physically based one.
constexpr std::string_view kMatt = "Ks 0 0 0\nNs 1\nPr 0.9\nPm 0\n";
constexpr const char* kImages = "materials/textures/";  // folder of images in a model's folder

// Gazebo Classic leaves out what is seen from behind, and has no means to say otherwise. Gazebo Sim
// has, in <material>, but not for a mesh with several materials. <material> takes the place of the
// mesh's own, and has no mask: holes in leaves would be closed.
bool has_sim_material(Gazebo gazebo, const mesh::Material& material) {
  return gazebo == Gazebo::sim && material.mask == nullptr;
}

SinglePlant write_single_mesh(const ExportedPlants& plants, std::size_t model) {
  const std::string& name = plants.farm.models[model].name;
  const PlantSurfaces& surfaces = plants.surfaces;
  const fs::path folder = mesh_folder(plants.folder, name);
  const fs::path images = plants.folder.path / name / kImages;
  std::vector<mesh::MtlEntry> entries;
  SinglePlant plant{.uri = mesh_uri(name, name + ".obj")};
  ObjFile obj(folder / (name + ".obj"), name + ".mtl", kPlantNormals);
  for (const Surface& surface : surfaces.models[model]) {
    const mesh::Material& material = surfaces.materials[surface.material];
    entries.push_back({.name = surfaces.names[surface.material],
                       .material = material,
                       .images = std::string("../") + kImages});
    if (material.texture || material.mask) fs::create_directories(images);
    mesh::write_images(images, material);
    obj.use_material(entries.back().name);
    obj.add(surface, Eigen::Affine3d::Identity(), !surface.closed);
    for (const Eigen::Vector3f& v : surface.vertices) plant.bounds.extend(v.cast<double>());
  }
  obj.close();
  mesh::write_mtl(folder / (name + ".mtl"), entries, kMatt);
  plant.triangles = obj.triangles();
  return plant;
}

// One mesh of a merged model.
struct MergedMesh {
  std::size_t material = 0;
  std::string file;
  std::uint64_t triangles = 0;
};

// Around all plants of the link, along its heading, in the link's frame.
CollisionBox box_around(const MergedLink& link, const PlantSurfaces& surfaces) {
  const Eigen::AngleAxisd link_from_box(link.heading_rad, Eigen::Vector3d::UnitZ());
  Eigen::AlignedBox3d box;
  for (const farm::Plant* plant : link.plants) {
    const Eigen::Affine3d box_from_plant = link_from_box.inverse() *
                                           Eigen::Translation3d(-link.origin) *
                                           farm::world_from_plant(*plant);
    for (const Surface& surface : surfaces.models[plant->model])
      for (const Eigen::Vector3f& v : surface.vertices)
        box.extend(box_from_plant * v.cast<double>());
  }
  return {
      .center = link_from_box * box.center(), .size = box.sizes(), .heading_rad = link.heading_rad};
}

// Writes models of merged plants: first the meshes of their links, then the models.
class MergedPlants {
 public:
  explicit MergedPlants(const ExportedPlants& plants) : plants_(plants) {}

  // The meshes of a link, one a material.
  std::vector<MergedMesh> write_meshes(const std::string& model, const MergedLink& link) const {
    std::set<std::size_t> materials;
    for (const farm::Plant* plant : link.plants)
      for (const Surface& surface : plants_.surfaces.models[plant->model])
        materials.insert(surface.material);
    return list_of(materials,
                   [&](std::size_t material) { return write_mesh(model, link, material); });
  }

  // The description of a model whose meshes are written.
  EntityCounts write_model(const MergedModel& model,
                           const std::vector<std::vector<MergedMesh>>& meshes) const {
    EntityCounts counts{.models = 1};
    sdfxml::XmlFile xml =
        begin_model(plants_.folder, model.name, "Plants of the farm " + plants_.farm.name);
    for (std::size_t i = 0; i < model.links.size(); ++i)
      counts += write_link(xml, model, model.links[i], meshes[i]);
    end_model(xml);
    return counts;
  }

 private:
  MergedMesh write_mesh(const std::string& model, const MergedLink& link,
                        std::size_t material) const {
    const fs::path folder = mesh_folder(plants_.folder, model);
    const std::string& name = plants_.surfaces.names[material];
    const std::string stem = link.mesh_prefix + name;
    ObjFile obj(folder / (stem + ".obj"), stem + ".mtl", kPlantNormals);
    mesh::write_mtl(folder / (stem + ".mtl"),
                    {{.name = name,
                      .material = plants_.surfaces.materials[material],
                      .images = "../../" + images_of(material)}},
                    kMatt);
    obj.use_material(name);
    const bool one_sided =
        !has_sim_material(plants_.folder.gazebo, plants_.surfaces.materials[material]);
    for (const farm::Plant* plant : link.plants) {
      const Eigen::Affine3d link_from_plant =
          Eigen::Translation3d(-link.origin) * farm::world_from_plant(*plant);
      for (const Surface& surface : plants_.surfaces.models[plant->model])
        if (surface.material == material)
          obj.add(surface, link_from_plant, one_sided && !surface.closed);
    }
    obj.close();
    return {.material = material, .file = stem + ".obj", .triangles = obj.triangles()};
  }

  EntityCounts write_link(sdfxml::XmlFile& xml, const MergedModel& model, const MergedLink& link,
                          const std::vector<MergedMesh>& meshes) const {
    EntityCounts counts{.links = 1};
    xml.open("link", link.name);
    const Eigen::Vector3d place = link.origin - model.origin;
    if (!place.isZero(0)) xml.text("pose", sdfxml::sdf_pose(place, Eigen::Quaterniond::Identity()));
    for (const MergedMesh& mesh : meshes) counts += write_visual(xml, model, mesh);
    if (plants_.collision == Collision::box) {
      write_box_collision(xml, box_around(link, plants_.surfaces), model.label);
      ++counts.collisions;
    }
    xml.close();
    return counts;
  }

  EntityCounts write_visual(sdfxml::XmlFile& xml, const MergedModel& model,
                            const MergedMesh& mesh) const {
    const mesh::Material& material = plants_.surfaces.materials[mesh.material];
    const std::string& name = plants_.surfaces.names[mesh.material];
    const std::string uri = mesh_uri(model.name, mesh.file);
    xml.open("visual", name);
    sdfxml::write_mesh_geometry(xml, uri);
    if (has_sim_material(plants_.folder.gazebo, material)) {
      write_sim_material(
          xml, material.colour,
          material.texture ? "model://" + images_of(mesh.material) + material.texture->name : "");
    }
    write_class(xml, model.label);
    xml.close();
    EntityCounts counts{.visuals = 1, .triangles = mesh.triangles};
    if (plants_.collision == Collision::mesh) {
      // In SDF no two parts of a link have one name.
      sdfxml::write_mesh_part(xml, "collision", name + ".collision", uri, model.label);
      ++counts.collisions;
    }
    return counts;
  }

  // The folder of a material's images, from that of all models: the first model that shows it has
  // them.
  std::string images_of(std::size_t material) const {
    const auto model = std::ranges::find_if(plants_.surfaces.models, [&](const auto& surfaces) {
      return contains(surfaces, material, &Surface::material);
    });
    return plants_.farm.models[static_cast<std::size_t>(model - plants_.surfaces.models.begin())]
               .name +
           "/" + kImages;
  }

  const ExportedPlants& plants_;
};

}  // namespace

EntityCounts& EntityCounts::operator+=(const EntityCounts& other) {
  models += other.models;
  links += other.links;
  visuals += other.visuals;
  collisions += other.collisions;
  triangles += other.triangles;
  return *this;
}

nlohmann::json counts_json(const EntityCounts& counts) {
  return {{"models", counts.models},
          {"links", counts.links},
          {"visuals", counts.visuals},
          {"collisions", counts.collisions},
          {"triangles", counts.triangles}};
}

std::vector<SinglePlant> write_single_plants(const ExportedPlants& plants) {
  const farm::Farm& farm = plants.farm;
  std::vector<SinglePlant> written;
  const std::vector<farm::SurfaceClass> classes = farm::classes_of_models(farm);
  for (std::size_t i = 0; i < farm.models.size(); ++i) {
    written.push_back(write_single_mesh(plants, i));
    sdfxml::XmlFile xml = begin_model(plants.folder, farm.models[i].name,
                                      "Plant of the farm " + farm.name + ", foot at the origin");
    xml.open("link", "link");
    sdfxml::write_mesh_part(xml, "visual", "visual", written.back().uri, classes[i]);
    xml.close();
    end_model(xml);
  }
  return written;
}

EntityCounts write_merged_plants(const ExportedPlants& plants,
                                 const std::vector<MergedModel>& models,
                                 const ProgressReport& progress) {
  std::vector<std::pair<std::size_t, std::size_t>> links;
  std::vector<std::vector<std::vector<MergedMesh>>> meshes(models.size());
  for (std::size_t i = 0; i < models.size(); ++i) {
    meshes[i].resize(models[i].links.size());
    for (std::size_t k = 0; k < models[i].links.size(); ++k) links.emplace_back(i, k);
  }
  const MergedPlants writer(plants);
  std::mutex reporting;
  std::size_t done = 0;
  tbb::parallel_for(std::size_t{0}, links.size(), [&](std::size_t i) {
    const auto [model, link] = links[i];
    meshes[model][link] = writer.write_meshes(models[model].name, models[model].links[link]);
    const std::lock_guard lock(reporting);
    progress(static_cast<double>(++done) / static_cast<double>(links.size()));
  });
  EntityCounts counts;
  for (std::size_t i = 0; i < models.size(); ++i)
    counts += writer.write_model(models[i], meshes[i]);
  return counts;
}

EntityCounts write_terrain_model(const ModelFolder& models, const farm::Farm& farm) {
  std::vector<mesh::Material> materials;
  const std::vector<Surface> surfaces = surfaces_of(terrain::mesh_of(farm.terrain), materials);
  const std::string name = sdfxml::kTerrainModel;
  const fs::path folder = mesh_folder(models, name);
  ObjFile obj(folder / (name + ".obj"), name + ".mtl", kGroundNormals);
  obj.use_material("soil");
  for (const Surface& surface : surfaces) obj.add(surface, Eigen::Affine3d::Identity(), false);
  obj.close();
  mesh::Material soil{.name = "soil", .colour = farm::kSoilBrown};
  if (farm.soil_reflectance) soil.reflectance = static_cast<float>(*farm.soil_reflectance);
  mesh::write_mtl(folder / (name + ".mtl"), {{.name = soil.name, .material = soil}}, kMatt);

  const std::string uri = mesh_uri(name, name + ".obj");
  sdfxml::XmlFile xml = begin_model(models, name, "Terrain of the farm " + farm.name);
  xml.open("link", "link");
  for (const char* part : {"visual", "collision"})
    sdfxml::write_mesh_part(xml, part, part, uri, farm::SurfaceClass::ground);
  xml.close();
  end_model(xml);
  return {.models = 1, .links = 1, .visuals = 1, .collisions = 1, .triangles = obj.triangles()};
}

}  // namespace plotscan::gazebo
