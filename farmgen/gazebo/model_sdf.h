// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include <Eigen/Geometry>

#include "farm/surface_class.h"
#include "gazebo/export_options.h"
#include "sdfxml/elements.h"
#include "sdfxml/xml_file.h"

// SDF elements of exported worlds and models.
namespace plotscan::gazebo {

const char* sdf_version(Gazebo gazebo);

// The models of one export: where they lie, and for which Gazebo they are.
struct ModelFolder {
  std::filesystem::path path;  // DIR/models
  Gazebo gazebo;
};

// DIR/models/NAME/meshes; created.
std::filesystem::path mesh_folder(const ModelFolder& models, const std::string& name);
// model://NAME/meshes/FILE
std::string mesh_uri(const std::string& model, const std::string& file);

// Begins models/NAME/model.sdf with a static model and writes its model.config; end_model ends it.
sdfxml::XmlFile begin_model(const ModelFolder& models, const std::string& name,
                            const std::string& description, bool is_static = true);
void end_model(sdfxml::XmlFile& xml);

// Begins a <material> with an opaque colour.
void open_material(sdfxml::XmlWriter& xml, const Eigen::Vector3f& colour);

// <material> of Gazebo Sim: diffuse colour, image (a URI, or "" for none), matt, both sides shown.
void write_sim_material(sdfxml::XmlFile& xml, const Eigen::Vector3f& colour,
                        const std::string& image);

// <collision> with a box in the frame around it.
struct CollisionBox {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  Eigen::Vector3d size = Eigen::Vector3d::Zero();
  double heading_rad = 0;
};
void write_box_collision(sdfxml::XmlFile& xml, const CollisionBox& box, farm::SurfaceClass label);

}  // namespace plotscan::gazebo
