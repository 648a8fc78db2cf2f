// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>

#include <Eigen/Geometry>

#include "farm/surface_class.h"
#include "sdfxml/xml_file.h"

// What SDF worlds of any kind are made of.
namespace plotscan::sdfxml {

// The terrain's model, and its folder below models/.
inline constexpr const char* kTerrainModel = "terrain";
// The model of the plants that belong to no plot.
inline constexpr const char* kPlantsOutsidePlots = "plants_outside_plots";

// "plot_12", "plant_345": what models, links and visuals of a plot or a plant are called.
std::string plot_element_name(std::uint32_t plot);
std::string plant_element_name(std::uint32_t plant);

// The numbers with blanks between them, each the shortest text that reads back as the same number.
std::string sdf_numbers(std::initializer_list<double> values);
void append_sdf_numbers(std::string& text, std::initializer_list<double> values);

// "x y z roll pitch yaw", metres and radians.
std::string sdf_pose(const Eigen::Vector3d& position, const Eigen::Quaterniond& rotation);
void append_sdf_pose(std::string& text, const Eigen::Vector3d& position,
                     const Eigen::Quaterniond& rotation);

// <geometry><mesh>, with the scale where it is not 1.
void write_mesh_geometry(XmlWriter& xml, const std::string& uri,
                         const Eigen::Vector3d& scale = Eigen::Vector3d::Ones());

// <laser_retro>: the class of what a ray meets.
void write_class(XmlWriter& xml, farm::SurfaceClass label);

// A part of a link, "visual" or "collision", that is a mesh.
void write_mesh_part(XmlWriter& xml, const char* part, const std::string& name,
                     const std::string& uri, farm::SurfaceClass label,
                     const Eigen::Vector3d& scale = Eigen::Vector3d::Ones());

// A directional light from the south-east, high up.
void write_sun(XmlWriter& xml);

// <model><static>true</static><link name="link">, to be closed by close_static_model.
void open_static_model(XmlWriter& xml, const std::string& name);
void close_static_model(XmlWriter& xml);

// models/NAME/model.config of a model in SDF of that version.
void write_model_config(const std::filesystem::path& file, const std::string& name,
                        const std::string& sdf_version, const std::string& description);

}  // namespace plotscan::sdfxml
