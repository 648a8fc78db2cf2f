// SPDX-License-Identifier: Apache-2.0
#include "gazebo/plant_models.h"

#include <algorithm>
#include <mutex>
#include <set>
#include <string_view>

#include <tbb/parallel_for.h>

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

SinglePlant write_single_mesh(const ModelFolder& models, const std::string& name,
                              const std::vector<Surface>& parts, const PlantSurfaces& surfaces) {
  const fs::path folder = mesh_folder(models, name);
  const fs::path images = models.path / name / kImages;
  std::vector<mesh::MtlEntry> entries;
  SinglePlant plant{.uri = mesh_uri(name, name + ".obj")};
  ObjFile obj(folder / (name + ".obj"), name + ".mtl", kPlantNormals);
  for (const Surface& surface : parts) {
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

// Around all plants of the group, along its heading, in the link's frame.
CollisionBox box_around(const PlantGroup& group, const PlantSurfaces& surfaces) {
  const Eigen::AngleAxisd link_from_box(group.heading_rad, Eigen::Vector3d::UnitZ());
  Eigen::AlignedBox3d box;
  for (const farm::Plant* plant : group.plants) {
    const Eigen::Affine3d box_from_plant = link_from_box.inverse() *
                                           Eigen::Translation3d(-group.origin) *
                                           farm::world_from_plant(*plant);
    for (const Surface& surface : surfaces.models[plant->model])
      for (const Eigen::Vector3f& v : surface.vertices)
        box.extend(box_from_plant * v.cast<double>());
  }
  return {.center = link_from_box * box.center(),
          .size = box.sizes(),
          .heading_rad = group.heading_rad};
}

// Writes models of merged plants: first the meshes of their links, then the models.
class MergedPlants {
 public:
  MergedPlants(const ModelFolder& models, const farm::Farm& farm, const PlantSurfaces& surfaces,
               Collision collision)
      : models_(models), farm_(farm), surfaces_(surfaces), collision_(collision) {}

  // The meshes of a link, one a material.
  std::vector<MergedMesh> write_meshes(const std::string& model, const PlantGroup& group) const {
    std::set<std::size_t> materials;
    for (const farm::Plant* plant : group.plants)
      for (const Surface& surface : surfaces_.models[plant->model])
        materials.insert(surface.material);
    return list_of(materials,
                   [&](std::size_t material) { return write_mesh(model, group, material); });
  }

  // The description of a model whose meshes are written.
  EntityCounts write_model(const PlantGroups& groups,
                           const std::vector<std::vector<MergedMesh>>& meshes) const {
    EntityCounts counts{.models = 1};
    sdfxml::XmlFile xml = begin_model(models_, groups.name, "Plants of the farm " + farm_.name);
    for (std::size_t i = 0; i < groups.links.size(); ++i)
      counts += write_link(xml, groups, groups.links[i], meshes[i]);
    end_model(xml);
    return counts;
  }

 private:
  MergedMesh write_mesh(const std::string& model, const PlantGroup& group,
                        std::size_t material) const {
    const fs::path folder = mesh_folder(models_, model);
    const std::string& name = surfaces_.names[material];
    const std::string stem = group.mesh_prefix + name;
    ObjFile obj(folder / (stem + ".obj"), stem + ".mtl", kPlantNormals);
    mesh::write_mtl(folder / (stem + ".mtl"),
                    {{.name = name,
                      .material = surfaces_.materials[material],
                      .images = "../../" + images_of(material)}},
                    kMatt);
    obj.use_material(name);
    const bool one_sided = !has_sim_material(models_.gazebo, surfaces_.materials[material]);
    for (const farm::Plant* plant : group.plants) {
      const Eigen::Affine3d link_from_plant =
          Eigen::Translation3d(-group.origin) * farm::world_from_plant(*plant);
      for (const Surface& surface : surfaces_.models[plant->model])
        if (surface.material == material)
          obj.add(surface, link_from_plant, one_sided && !surface.closed);
    }
    obj.close();
    return {.material = material, .file = stem + ".obj", .triangles = obj.triangles()};
  }

  EntityCounts write_link(sdfxml::XmlFile& xml, const PlantGroups& groups, const PlantGroup& group,
                          const std::vector<MergedMesh>& meshes) const {
    EntityCounts counts{.links = 1};
    xml.open("link", group.link);
    const Eigen::Vector3d place = group.origin - groups.origin;
    if (!place.isZero(0)) xml.text("pose", sdfxml::sdf_pose(place, Eigen::Quaterniond::Identity()));
    for (const MergedMesh& mesh : meshes) counts += write_visual(xml, groups, mesh);
    if (collision_ == Collision::box) {
      write_box_collision(xml, box_around(group, surfaces_), groups.label);
      ++counts.collisions;
    }
    xml.close();
    return counts;
  }

  EntityCounts write_visual(sdfxml::XmlFile& xml, const PlantGroups& groups,
                            const MergedMesh& mesh) const {
    const mesh::Material& material = surfaces_.materials[mesh.material];
    const std::string& name = surfaces_.names[mesh.material];
    const std::string uri = mesh_uri(groups.name, mesh.file);
    xml.open("visual", name);
    sdfxml::write_mesh_geometry(xml, uri);
    if (has_sim_material(models_.gazebo, material)) {
      write_sim_material(
          xml, material.colour,
          material.texture ? "model://" + images_of(mesh.material) + material.texture->name : "");
    }
    write_class(xml, groups.label);
    xml.close();
    EntityCounts counts{.visuals = 1, .triangles = mesh.triangles};
    if (collision_ == Collision::mesh) {
      // In SDF no two parts of a link have one name.
      sdfxml::write_mesh_part(xml, "collision", name + ".collision", uri, groups.label);
      ++counts.collisions;
    }
    return counts;
  }

  // The folder of a material's images, from that of all models: the first model that shows it has
  // them.
  std::string images_of(std::size_t material) const {
    const auto model = std::ranges::find_if(surfaces_.models, [&](const auto& surfaces) {
      return std::ranges::count(surfaces, material, &Surface::material) > 0;
    });
    return farm_.models[static_cast<std::size_t>(model - surfaces_.models.begin())].name + "/" +
           kImages;
  }

  const ModelFolder& models_;
  const farm::Farm& farm_;
  const PlantSurfaces& surfaces_;
  Collision collision_;
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

std::vector<SinglePlant> write_single_plants(const ModelFolder& models, const farm::Farm& farm,
                                             const PlantSurfaces& surfaces) {
  std::vector<SinglePlant> plants;
  const std::vector<SurfaceClass> classes = farm::classes_of_models(farm);
  for (std::size_t i = 0; i < farm.models.size(); ++i) {
    const std::string& name = farm.models[i].name;
    plants.push_back(write_single_mesh(models, name, surfaces.models[i], surfaces));
    sdfxml::XmlFile xml =
        begin_model(models, name, "Plant of the farm " + farm.name + ", foot at the origin");
    xml.open("link", "link");
    sdfxml::write_mesh_part(xml, "visual", "visual", plants.back().uri, classes[i]);
    xml.close();
    end_model(xml);
  }
  return plants;
}

EntityCounts write_merged_plants(const ModelFolder& models, const farm::Farm& farm,
                                 const std::vector<PlantGroups>& groups,
                                 const PlantSurfaces& surfaces, const ExportOptions& options,
                                 const ProgressReport& progress) {
  std::vector<std::pair<std::size_t, std::size_t>> links;
  std::vector<std::vector<std::vector<MergedMesh>>> meshes(groups.size());
  for (std::size_t i = 0; i < groups.size(); ++i) {
    meshes[i].resize(groups[i].links.size());
    for (std::size_t k = 0; k < groups[i].links.size(); ++k) links.emplace_back(i, k);
  }
  const MergedPlants writer(models, farm, surfaces, options.collision);
  std::mutex reporting;
  std::size_t done = 0;
  tbb::parallel_for(std::size_t{0}, links.size(), [&](std::size_t i) {
    const auto [model, link] = links[i];
    meshes[model][link] = writer.write_meshes(groups[model].name, groups[model].links[link]);
    const std::lock_guard lock(reporting);
    progress(static_cast<double>(++done) / static_cast<double>(links.size()));
  });
  EntityCounts counts;
  for (std::size_t i = 0; i < groups.size(); ++i)
    counts += writer.write_model(groups[i], meshes[i]);
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
    sdfxml::write_mesh_part(xml, part, part, uri, SurfaceClass::ground);
  xml.close();
  end_model(xml);
  return {.models = 1, .links = 1, .visuals = 1, .collisions = 1, .triangles = obj.triangles()};
}

}  // namespace plotscan::gazebo
