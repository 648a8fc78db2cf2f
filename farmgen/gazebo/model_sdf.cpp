// SPDX-License-Identifier: Apache-2.0
#include "gazebo/model_sdf.h"

#include "core/number_text.h"

namespace plotscan::gazebo {
namespace fs = std::filesystem;

const char* sdf_version(Gazebo gazebo) { return gazebo == Gazebo::classic ? "1.6" : "1.9"; }

fs::path mesh_folder(const ModelFolder& models, const std::string& name) {
  fs::path folder = models.path / name / "meshes";
  fs::create_directories(folder);
  return folder;
}

std::string mesh_uri(const std::string& model, const std::string& file) {
  return "model://" + model + "/meshes/" + file;
}

sdfxml::XmlFile begin_model(const ModelFolder& models, const std::string& name,
                            const std::string& description, bool is_static) {
  const char* version = sdf_version(models.gazebo);
  sdfxml::write_model_config(models.path / name / "model.config", name, version, description);
  sdfxml::XmlFile xml(models.path / name / "model.sdf");
  xml.open("sdf");
  xml.attribute("version", version);
  xml.open("model", name);
  xml.text("static", is_static ? "true" : "false");
  return xml;
}

void end_model(sdfxml::XmlFile& xml) {
  xml.close();
  xml.close();
  xml.finish();
}

void open_material(sdfxml::XmlWriter& xml, const Eigen::Vector3f& colour) {
  std::string rgba;
  for (const float part : colour) rgba.append(NumberText(part)) += ' ';
  rgba += '1';
  xml.open("material");
  xml.text("ambient", rgba);
  xml.text("diffuse", rgba);
}

void write_sim_material(sdfxml::XmlFile& xml, const Eigen::Vector3f& colour,
                        const std::string& image) {
  open_material(xml, colour);
  xml.text("specular", "0 0 0 1");
  xml.text("double_sided", "true");
  xml.open("pbr");
  xml.open("metal");
  if (!image.empty()) xml.text("albedo_map", image);
  xml.text("roughness", "0.9");
  xml.text("metalness", "0");
  xml.close();
  xml.close();
  xml.close();
}

void write_box_collision(sdfxml::XmlFile& xml, const CollisionBox& box, farm::SurfaceClass label) {
  xml.open("collision", "box_collision");
  xml.text("pose", sdfxml::sdf_numbers(
                       {box.center.x(), box.center.y(), box.center.z(), 0, 0, box.heading_rad}));
  xml.open("geometry");
  xml.texts("box", {{"size", sdfxml::sdf_numbers({box.size.x(), box.size.y(), box.size.z()})}});
  xml.close();
  write_class(xml, label);
  xml.close();
}

}  // namespace plotscan::gazebo
