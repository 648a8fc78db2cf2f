// SPDX-License-Identifier: Apache-2.0
#include "farm/sdf.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <vector>

#include <tinyxml2.h>

#include "core/csv.h"
#include "core/error.h"

namespace plotscan::farm {
namespace {

constexpr const char* kSdfVersion = "1.6";

// An XML file written element by element, so that memory does not grow with the farm.
class XmlFile {
 public:
  explicit XmlFile(const std::filesystem::path& path)
      : path_(path), file_(std::fopen(path.c_str(), "wb"), &std::fclose) {
    if (!file_) throw InputError(path_, "cannot be written");
    printer_ = std::make_unique<tinyxml2::XMLPrinter>(file_.get());
    printer_->PushHeader(false, true);
  }

  void open(const char* element) { printer_->OpenElement(element); }
  void open(const char* element, const std::string& name) {
    open(element);
    attribute("name", name);
  }
  void attribute(const char* name, const std::string& value) {
    printer_->PushAttribute(name, value.c_str());
  }
  void close() { printer_->CloseElement(); }
  void text(const char* element, const std::string& value) {
    open(element);
    printer_->PushText(value.c_str());
    close();
  }

  void finish() {
    if (std::fflush(file_.get()) != 0 || std::ferror(file_.get()) != 0)
      throw InputError(path_, "cannot be written");
  }

 private:
  std::filesystem::path path_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
  std::unique_ptr<tinyxml2::XMLPrinter> printer_;
};

std::string numbers(std::initializer_list<double> values) {
  std::string text;
  // Adding zero turns -0 into 0.
  for (const double value : values) text += (text.empty() ? "" : " ") + format_number(value + 0.0);
  return text;
}

// Roll, pitch, yaw as SDF has them: rotation = Rz(yaw) Ry(pitch) Rx(roll).
Eigen::Vector3d roll_pitch_yaw(const Eigen::Quaterniond& q) {
  const double sin_pitch = std::clamp(2 * (q.w() * q.y() - q.z() * q.x()), -1.0, 1.0);
  // Within a microradian of straight up or down, roll and yaw turn about the same axis.
  constexpr double kGimbalLock = 1 - 1e-12;
  if (std::abs(sin_pitch) > kGimbalLock) {
    const double sign = std::copysign(1.0, sin_pitch);
    return {0, sign * M_PI / 2, -2 * sign * std::atan2(q.x(), q.w())};
  }
  return {std::atan2(2 * (q.w() * q.x() + q.y() * q.z()), 1 - 2 * (q.x() * q.x() + q.y() * q.y())),
          std::asin(sin_pitch),
          std::atan2(2 * (q.w() * q.z() + q.x() * q.y()), 1 - 2 * (q.y() * q.y() + q.z() * q.z()))};
}

void write_mesh(XmlFile& xml, const std::string& uri, const Eigen::Vector3d& scale) {
  xml.open("geometry");
  xml.open("mesh");
  xml.text("uri", uri);
  if (scale != Eigen::Vector3d::Ones()) {
    xml.text("scale", numbers({scale.x(), scale.y(), scale.z()}));
  }
  xml.close();
  xml.close();
}

void write_sun(XmlFile& xml) {
  xml.open("light", "sun");
  xml.attribute("type", "directional");
  xml.text("cast_shadows", "true");
  xml.text("pose", "0 0 100 0 0 0");
  xml.text("diffuse", "0.9 0.9 0.9 1");
  xml.text("specular", "0.1 0.1 0.1 1");
  xml.text("direction", "-0.4 0.3 -0.9");
  xml.close();
}

void open_static_model(XmlFile& xml, const std::string& name) {
  xml.open("model", name);
  xml.text("static", "true");
  xml.open("link", "link");
}

void close_static_model(XmlFile& xml) {
  xml.close();
  xml.close();
}

void write_one_mesh_model(XmlFile& xml, const std::string& name, const std::string& uri,
                          bool with_collision) {
  open_static_model(xml, name);
  xml.open("visual", "visual");
  write_mesh(xml, uri, Eigen::Vector3d::Ones());
  xml.close();
  if (with_collision) {
    xml.open("collision", "collision");
    write_mesh(xml, uri, Eigen::Vector3d::Ones());
    xml.close();
  }
  close_static_model(xml);
}

void write_plant(XmlFile& xml, const Plant& plant, const std::string& uri) {
  const Eigen::Vector3d rpy = roll_pitch_yaw(plant.rotation);
  xml.open("visual", "plant_" + std::to_string(plant.id));
  xml.text("pose", numbers({plant.position.x(), plant.position.y(), plant.position.z(), rpy.x(),
                            rpy.y(), rpy.z()}));
  write_mesh(xml, uri, plant.scale);
  xml.close();
}

void write_plants_by_plot(XmlFile& xml, const Farm& farm, const ProgressReport& progress) {
  std::vector<std::string> uris;
  for (const PlantModel& model : farm.models) {
    uris.push_back(model_mesh_path(model.name).generic_string());
  }
  std::map<std::uint32_t, std::vector<const Plant*>> by_plot;
  for (const Plant& plant : farm.plants) by_plot[plant.plot].push_back(&plant);
  std::size_t written = 0;
  for (const auto& [plot, plants] : by_plot) {
    open_static_model(xml, plot == 0 ? "plants_outside_plots" : "plot_" + std::to_string(plot));
    for (const Plant* plant : plants) write_plant(xml, *plant, uris[plant->model]);
    close_static_model(xml);
    written += plants.size();
    progress(static_cast<double>(written) / static_cast<double>(farm.plants.size()));
  }
}

}  // namespace

std::filesystem::path model_mesh_path(const std::string& name) {
  return std::filesystem::path("models") / name / "meshes" / (name + ".obj");
}

void write_world(const std::filesystem::path& path, const Farm& farm,
                 const ProgressReport& progress) {
  XmlFile xml(path);
  xml.open("sdf");
  xml.attribute("version", kSdfVersion);
  xml.open("world", farm.name);
  write_sun(xml);
  write_one_mesh_model(xml, kTerrainModel, model_mesh_path(kTerrainModel).generic_string(), true);
  write_plants_by_plot(xml, farm, progress);
  xml.close();
  xml.close();
  xml.finish();
}

void write_model_description(const std::filesystem::path& models_folder, const std::string& name,
                             const std::string& text, bool with_collision) {
  XmlFile config(models_folder / name / "model.config");
  config.open("model");
  config.text("name", name);
  config.text("version", "1.0");
  config.open("sdf");
  config.attribute("version", kSdfVersion);
  config.close();
  config.text("description", text);
  config.close();
  config.finish();

  XmlFile sdf(models_folder / name / "model.sdf");
  sdf.open("sdf");
  sdf.attribute("version", kSdfVersion);
  write_one_mesh_model(sdf, name, "model://" + name + "/meshes/" + name + ".obj", with_collision);
  sdf.close();
  sdf.finish();
}

}  // namespace plotscan::farm
