// SPDX-License-Identifier: Apache-2.0
#include "sdfxml/elements.h"

#include <algorithm>
#include <cmath>

#include "core/angle.h"
#include "core/number_text.h"

namespace plotscan::sdfxml {
namespace {

// Roll, pitch, yaw as SDF has them: rotation = Rz(yaw) Ry(pitch) Rx(roll).
Eigen::Vector3d roll_pitch_yaw(const Eigen::Quaterniond& q) {
  const double sin_pitch = std::clamp(2 * (q.w() * q.y() - q.z() * q.x()), -1.0, 1.0);
  // Within a microradian of straight up or down, roll and yaw turn about the same axis.
  constexpr double kGimbalLock = 1 - 1e-12;
  if (std::abs(sin_pitch) > kGimbalLock) {
    const double sign = std::copysign(1.0, sin_pitch);
    return {0, sign * kPi / 2, -2 * sign * std::atan2(q.x(), q.w())};
  }
  return {std::atan2(2 * (q.w() * q.x() + q.y() * q.z()), 1 - 2 * (q.x() * q.x() + q.y() * q.y())),
          std::asin(sin_pitch),
          std::atan2(2 * (q.w() * q.z() + q.x() * q.y()), 1 - 2 * (q.y() * q.y() + q.z() * q.z()))};
}

}  // namespace

std::string plot_element_name(std::uint32_t plot) { return "plot_" + std::to_string(plot); }

std::string plant_element_name(std::uint32_t plant) { return "plant_" + std::to_string(plant); }

void append_sdf_numbers(std::string& text, std::initializer_list<double> values) {
  const char* between = "";
  for (const double value : values) {
    text.append(between).append(NumberText(value + 0.0));  // adding zero turns -0 into 0
    between = " ";
  }
}

std::string sdf_numbers(std::initializer_list<double> values) {
  std::string text;
  append_sdf_numbers(text, values);
  return text;
}

void append_sdf_pose(std::string& text, const Eigen::Vector3d& position,
                     const Eigen::Quaterniond& rotation) {
  const Eigen::Vector3d rpy = roll_pitch_yaw(rotation);
  append_sdf_numbers(text, {position.x(), position.y(), position.z(), rpy.x(), rpy.y(), rpy.z()});
}

std::string sdf_pose(const Eigen::Vector3d& position, const Eigen::Quaterniond& rotation) {
  std::string text;
  append_sdf_pose(text, position, rotation);
  return text;
}

void write_mesh_geometry(XmlWriter& xml, const std::string& uri, const Eigen::Vector3d& scale) {
  xml.open("geometry");
  xml.open("mesh");
  xml.text("uri", uri);
  if (scale != Eigen::Vector3d::Ones())
    xml.text("scale", sdf_numbers({scale.x(), scale.y(), scale.z()}));
  xml.close();
  xml.close();
}

void write_class(XmlWriter& xml, farm::SurfaceClass label) {
  xml.text("laser_retro", std::to_string(static_cast<int>(label)));
}

void write_mesh_part(XmlWriter& xml, const char* part, const std::string& name,
                     const std::string& uri, farm::SurfaceClass label,
                     const Eigen::Vector3d& scale) {
  xml.open(part, name);
  write_mesh_geometry(xml, uri, scale);
  write_class(xml, label);
  xml.close();
}

void write_sun(XmlWriter& xml) {
  xml.open("light", "sun");
  xml.attribute("type", "directional");
  xml.text("cast_shadows", "true");
  xml.text("pose", "0 0 100 0 0 0");
  xml.text("diffuse", "0.9 0.9 0.9 1");
  xml.text("specular", "0.1 0.1 0.1 1");
  xml.text("direction", "-0.4 0.3 -0.9");
  xml.close();
}

void open_static_model(XmlWriter& xml, const std::string& name) {
  xml.open("model", name);
  xml.text("static", "true");
  xml.open("link", "link");
}

void close_static_model(XmlWriter& xml) {
  xml.close();
  xml.close();
}

void write_model_config(const std::filesystem::path& file, const std::string& name,
                        const std::string& sdf_version, const std::string& description) {
  XmlFile config(file);
  config.open("model");
  config.text("name", name);
  config.text("version", "1.0");
  config.open("sdf");
  config.attribute("version", sdf_version);
  config.content("model.sdf");
  config.close();
  config.text("description", description);
  config.close();
  config.finish();
}

}  // namespace plotscan::sdfxml
