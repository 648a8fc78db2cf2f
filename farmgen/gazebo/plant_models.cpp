// SPDX-License-Identifier: Apache-2.0
#include "gazebo/plant_models.h"

#include <algorithm>
#include <fstream>
#include <mutex>
#include <set>

#include "sdfxml/elements.h"
#include <tbb/parallel_for.h>

#include "core/text_file.h"
#include "farm/surface_colours.h"
#include "gazebo/internal/obj_file.h"
#include "mesh/alpha_mask.h"

namespace plotscan::gazebo {
namespace fs = std::filesystem;
namespace {

// Directions of normals: 64^2 are 2 degrees apart, enough for leaves; smooth ground shows more.
constexpr int kPlantNormals = 64;
constexpr int kGroundNormals = 1024;

// Gazebo Classic leaves out what is seen from behind, and has no means to say otherwise. Gazebo Sim
// has, in <material>, but not for a mesh with several materials. <material> takes the place of the
// mesh's own, and has no mask: holes in leaves would be closed.
bool has_sim_material(Gazebo gazebo, const mesh::Material& material) {
  return gazebo == Gazebo::sim && material.mask == nullptr;
}

bool needs_back_faces(const Surface& surface, bool double_sided_material) {
  return !surface.closed && !double_sided_material;
}

// The model whose folder holds a material's image: the first that shows it.
std::string home_of_image(const farm::Farm& farm, const PlantSurfaces& surfaces,
                          std::size_t material) {
  for (std::size_t i = 0; i < surfaces.models.size(); ++i) {
    for (const Surface& surface : surfaces.models[i]) {
      if (surface.material == material) return farm.models[i].name;
    }
  }
  return "";
}

MtlEntry mtl_entry(const PlantSurfaces& surfaces, std::size_t material, const std::string& images) {
  return {
      .name = surfaces.names[material], .material = surfaces.materials[material], .images = images};
}

void write_image(const fs::path& model_folder, const mesh::Image& image) {
  const fs::path folder = model_folder / "materials" / "textures";
  fs::create_directories(folder);
  TextFile file(folder / image.name);
  file << image.bytes;
  file.close();
}

SinglePlant write_single_mesh(const ModelFolder& models, const std::string& name,
                              const std::vector<Surface>& parts, const PlantSurfaces& surfaces) {
  const fs::path folder = mesh_folder(models, name);
  std::vector<MtlEntry> entries;
  SinglePlant plant{.uri = mesh_uri(name, name + ".obj")};
  ObjFile obj(folder / (name + ".obj"), name + ".mtl", kPlantNormals);
  for (const Surface& surface : parts) {
    const mesh::Material& material = surfaces.materials[surface.material];
    entries.push_back(mtl_entry(surfaces, surface.material, "../materials/textures/"));
    if (material.texture) write_image(models.path / name, *material.texture);
    if (material.mask) write_image(models.path / name, *material.mask->image());
    obj.use_material(entries.back().name);
    obj.add(surface, Eigen::Affine3d::Identity(), needs_back_faces(surface, false));
    for (const Eigen::Vector3f& v : surface.vertices) plant.bounds.extend(v.cast<double>());
  }
  obj.close();
  write_mtl(folder / (name + ".mtl"), entries);
  plant.triangles = obj.triangles();
  return plant;
}

// One mesh of a merged model.
struct MergedMesh {
  std::size_t material = 0;
  std::string file;
  std::uint64_t triangles = 0;
};

MergedMesh write_merged_mesh(const ModelFolder& models, const std::string& model,
                             const PlantGroup& group, std::size_t material, const farm::Farm& farm,
                             const PlantSurfaces& surfaces) {
  const fs::path folder = mesh_folder(models, model);
  const std::string stem = group.mesh_prefix + surfaces.names[material];
  ObjFile obj(folder / (stem + ".obj"), stem + ".mtl", kPlantNormals);
  const std::string home = home_of_image(farm, surfaces, material);
  write_mtl(folder / (stem + ".mtl"),
            {mtl_entry(surfaces, material, "../../" + home + "/materials/textures/")});
  obj.use_material(surfaces.names[material]);
  const bool double_sided_material = has_sim_material(models.gazebo, surfaces.materials[material]);
  for (const farm::Plant* plant : group.plants) {
    const Eigen::Affine3d link_from_plant =
        Eigen::Translation3d(-group.origin) * farm::world_from_plant(*plant);
    for (const Surface& surface : surfaces.models[plant->model]) {
      if (surface.material != material) continue;
      obj.add(surface, link_from_plant, needs_back_faces(surface, double_sided_material));
    }
  }
  obj.close();
  return {.material = material, .file = stem + ".obj", .triangles = obj.triangles()};
}

std::vector<MergedMesh> write_merged_meshes(const ModelFolder& models, const std::string& model,
                                            const PlantGroup& group, const farm::Farm& farm,
                                            const PlantSurfaces& surfaces) {
  std::set<std::size_t> materials;
  for (const farm::Plant* plant : group.plants) {
    for (const Surface& surface : surfaces.models[plant->model]) materials.insert(surface.material);
  }
  std::vector<MergedMesh> meshes;
  meshes.reserve(materials.size());
  for (const std::size_t material : materials)
    meshes.push_back(write_merged_mesh(models, model, group, material, farm, surfaces));
  return meshes;
}

// Around all plants of the group, along its heading, in the link's frame.
CollisionBox box_around(const PlantGroup& group, const PlantSurfaces& surfaces) {
  const Eigen::AngleAxisd link_from_box(group.heading_rad, Eigen::Vector3d::UnitZ());
  Eigen::AlignedBox3d box;
  for (const farm::Plant* plant : group.plants) {
    const Eigen::Affine3d box_from_plant = link_from_box.inverse() *
                                           Eigen::Translation3d(-group.origin) *
                                           farm::world_from_plant(*plant);
    for (const Surface& surface : surfaces.models[plant->model]) {
      for (const Eigen::Vector3f& v : surface.vertices)
        box.extend(box_from_plant * v.cast<double>());
    }
  }
  return {.center = link_from_box * box.center(),
          .size = box.sizes(),
          .heading_rad = group.heading_rad};
}

class MergedModelWriter {
 public:
  MergedModelWriter(const ModelFolder& models, const farm::Farm& farm,
                    const PlantSurfaces& surfaces, const ExportOptions& options)
      : models_(models), farm_(farm), surfaces_(surfaces), options_(options) {}

  EntityCounts write(const PlantGroups& groups,
                     const std::vector<std::vector<MergedMesh>>& meshes) const {
    EntityCounts counts{.models = 1};
    sdfxml::XmlFile xml = begin_model(models_, groups.name, "Plants of the farm " + farm_.name);
    for (std::size_t i = 0; i < groups.links.size(); ++i)
      counts += write_link(xml, groups, groups.links[i], meshes[i]);
    end_model(xml);
    return counts;
  }

 private:
  EntityCounts write_link(sdfxml::XmlFile& xml, const PlantGroups& groups, const PlantGroup& group,
                          const std::vector<MergedMesh>& meshes) const {
    EntityCounts counts{.links = 1};
    xml.open("link", group.link);
    const Eigen::Vector3d place = group.origin - groups.origin;
    if (!place.isZero(0)) xml.text("pose", sdfxml::sdf_pose(place, Eigen::Quaterniond::Identity()));
    for (const MergedMesh& mesh : meshes) {
      counts += write_mesh(xml, groups, mesh);
    }
    if (options_.collision == Collision::box) {
      write_box_collision(xml, box_around(group, surfaces_), groups.label);
      ++counts.collisions;
    }
    xml.close();
    return counts;
  }

  EntityCounts write_mesh(sdfxml::XmlFile& xml, const PlantGroups& groups,
                          const MergedMesh& mesh) const {
    const std::string& name = surfaces_.names[mesh.material];
    const std::string uri = mesh_uri(groups.name, mesh.file);
    xml.open("visual", name);
    sdfxml::write_mesh_geometry(xml, uri);
    if (has_sim_material(options_.gazebo, surfaces_.materials[mesh.material]))
      write_sim_material(xml, surfaces_.materials[mesh.material].colour, image_uri(mesh.material));
    write_class(xml, groups.label);
    xml.close();
    EntityCounts counts{.visuals = 1, .triangles = mesh.triangles};
    if (options_.collision == Collision::mesh) {
      // In SDF no two parts of a link have one name.
      write_mesh_collision(xml, name + ".collision", uri, Eigen::Vector3d::Ones(), groups.label);
      ++counts.collisions;
    }
    return counts;
  }

  std::string image_uri(std::size_t material) const {
    const auto& image = surfaces_.materials[material].texture;
    if (!image) return "";
    return "model://" + home_of_image(farm_, surfaces_, material) + "/materials/textures/" +
           image->name;
  }

  const ModelFolder& models_;
  const farm::Farm& farm_;
  const PlantSurfaces& surfaces_;
  const ExportOptions& options_;
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
    xml.open("visual", "visual");
    sdfxml::write_mesh_geometry(xml, plants.back().uri);
    write_class(xml, classes[i]);
    xml.close();
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
  std::mutex reporting;
  std::size_t done = 0;
  tbb::parallel_for(std::size_t{0}, links.size(), [&](std::size_t i) {
    const auto [model, link] = links[i];
    meshes[model][link] =
        write_merged_meshes(models, groups[model].name, groups[model].links[link], farm, surfaces);
    const std::lock_guard lock(reporting);
    progress(static_cast<double>(++done) / static_cast<double>(links.size()));
  });
  const MergedModelWriter writer(models, farm, surfaces, options);
  EntityCounts counts;
  for (std::size_t i = 0; i < groups.size(); ++i) counts += writer.write(groups[i], meshes[i]);
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
  write_mtl(folder / (name + ".mtl"), {{.name = soil.name, .material = soil, .images = ""}});

  const std::string uri = mesh_uri(name, name + ".obj");
  sdfxml::XmlFile xml = begin_model(models, name, "Terrain of the farm " + farm.name);
  xml.open("link", "link");
  xml.open("visual", "visual");
  sdfxml::write_mesh_geometry(xml, uri);
  write_class(xml, SurfaceClass::ground);
  xml.close();
  write_mesh_collision(xml, "collision", uri, Eigen::Vector3d::Ones(), SurfaceClass::ground);
  xml.close();
  end_model(xml);
  return {.models = 1, .links = 1, .visuals = 1, .collisions = 1, .triangles = obj.triangles()};
}

}  // namespace plotscan::gazebo
