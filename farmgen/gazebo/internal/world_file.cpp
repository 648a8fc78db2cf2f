// SPDX-License-Identifier: Apache-2.0
#include "gazebo/internal/world_file.h"

#include "gazebo/internal/naming.h"
#include "sdfxml/elements.h"
#include "terrain/extent.h"

namespace plotscan::gazebo {
namespace {

using sdfxml::sdf_numbers;

// Where the drone waits: so far over the farm's middle.
constexpr double kWaiting_m = 8;

class WorldFile {
 public:
  WorldFile(const std::filesystem::path& path, const World& world, PluginNames names)
      : xml_(path), world_(world), farm_(world.farm), options_(world.options), names_(names) {}

  EntityCounts write() {
    xml_.open("sdf");
    xml_.attribute("version", sdf_version(options_.gazebo));
    xml_.open("world", farm_.name);
    write_physics();
    if (names_ != PluginNames::none) write_systems();
    xml_.texts(
        "scene",
        {{"ambient", "0.5 0.5 0.5 1"}, {"background", "0.65 0.78 0.92 1"}, {"shadows", "true"}});
    if (farm_.anchor) write_spherical_coordinates();
    sdfxml::write_sun(xml_);
    include(sdfxml::kTerrainModel, Eigen::Vector3d::Zero(), farm::SurfaceClass::ground);
    for (const MergedModel& model : world_.merged) include(model.name, model.origin, model.label);
    EntityCounts counts;
    if (options_.merge == Merge::none)
      for (const farm::Plant& plant : farm_.plants) counts += write_plant(plant);
    if (options_.drone)
      include(kDroneModel, middle() + kWaiting_m * Eigen::Vector3d::UnitZ(),
              farm::SurfaceClass::other);
    xml_.close();
    xml_.close();
    xml_.finish();
    return counts;
  }

 private:
  Eigen::Vector3d middle() const {
    const Eigen::AlignedBox3d box = terrain::extent_of(farm_.terrain);
    Eigen::Vector3d place = box.center();
    place.z() = farm_.terrain.height(place.x(), place.y()).value_or(box.max().z());
    return place;
  }

  void write_physics() {
    xml_.open("physics", "default_physics");
    xml_.attribute("default", "true");
    xml_.attribute("type", "ode");
    xml_.text("max_step_size", sdf_numbers({kStep_s}));
    xml_.text("real_time_factor", "1");
    xml_.text("real_time_update_rate", sdf_numbers({1 / kStep_s}));
    xml_.close();
  }

  void open_plugin(const std::string& file, const std::string& name) {
    const bool gz = names_ == PluginNames::gz;
    xml_.open("plugin");
    xml_.attribute("filename", (gz ? "gz-sim-" : "ignition-gazebo-") + file + "-system");
    xml_.attribute("name", (gz ? "gz::sim::systems::" : "ignition::gazebo::systems::") + name);
  }

  void write_system(const std::string& file, const std::string& name) {
    open_plugin(file, name);
    xml_.close();
  }

  void write_systems() {
    write_system("physics", "Physics");
    write_system("user-commands", "UserCommands");
    write_system("scene-broadcaster", "SceneBroadcaster");
    open_plugin("sensors", "Sensors");
    xml_.text("render_engine", "ogre2");
    xml_.close();
    if (!options_.drone) return;
    write_system("imu", "Imu");
    if (farm_.anchor) write_system("navsat", "NavSat");
  }

  void write_spherical_coordinates() {
    const Anchor& anchor = *farm_.anchor;
    xml_.texts("spherical_coordinates", {{"surface_model", "EARTH_WGS84"},
                                         {"world_frame_orientation", "ENU"},
                                         {"latitude_deg", sdf_numbers({anchor.latitude_deg})},
                                         {"longitude_deg", sdf_numbers({anchor.longitude_deg})},
                                         {"elevation", sdf_numbers({anchor.altitude_m})},
                                         {"heading_deg", "0"}});
  }

  // The label that Gazebo Sim's segmentation and bounding box cameras show. It stands in the world
  // and not in the model, since Fortress calls the plugin by another name.
  void write_label(farm::SurfaceClass label) {
    if (names_ == PluginNames::none) return;
    open_plugin("label", "Label");
    xml_.text("label", std::to_string(static_cast<int>(label)));
    xml_.close();
  }

  void include(const std::string& model, const Eigen::Vector3d& position,
               farm::SurfaceClass label) {
    xml_.open("include");
    xml_.text("uri", "model://" + model);
    xml_.text("name", model);
    xml_.text("pose", sdfxml::sdf_pose(position, Eigen::Quaterniond::Identity()));
    write_label(label);
    xml_.close();
  }

  EntityCounts write_plant(const farm::Plant& plant) {
    const SinglePlant& mesh = world_.single_plants[plant.model];
    const farm::SurfaceClass label = farm::class_of(plant.kind);
    EntityCounts counts{.models = 1, .links = 1, .visuals = 1, .triangles = mesh.triangles};
    xml_.open("model", plant_model_name(plant.plot, plant.id));
    xml_.text("static", "true");
    xml_.text("pose", sdfxml::sdf_pose(plant.position, plant.rotation));
    write_label(label);
    xml_.open("link", "link");
    sdfxml::write_mesh_part(xml_, "visual", "visual", mesh.uri, label, plant.scale);
    if (options_.collision == Collision::mesh)
      sdfxml::write_mesh_part(xml_, "collision", "collision", mesh.uri, label, plant.scale);
    if (options_.collision == Collision::box) {
      write_box_collision(xml_,
                          {.center = plant.scale.cwiseProduct(mesh.bounds.center()),
                           .size = plant.scale.cwiseProduct(mesh.bounds.sizes())},
                          label);
    }
    if (options_.collision != Collision::none) ++counts.collisions;
    xml_.close();
    xml_.close();
    return counts;
  }

  sdfxml::XmlFile xml_;
  const World& world_;
  const farm::Farm& farm_;
  const ExportOptions& options_;
  PluginNames names_;
};

}  // namespace

EntityCounts write_world(const std::filesystem::path& path, const World& world, PluginNames names) {
  return WorldFile(path, world, names).write();
}

}  // namespace plotscan::gazebo
