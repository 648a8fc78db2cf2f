// SPDX-License-Identifier: Apache-2.0
#include "farmfolder/internal/plant_visuals.h"

#include <array>
#include <span>

#include "core/error.h"
#include "farm/surface_class.h"
#include "sdfxml/elements.h"

namespace plotscan::farmfolder {
namespace {

constexpr std::array kKinds = {farm::PlantKind::crop, farm::PlantKind::weed};

bool is_scaled(const farm::Plant& plant) { return plant.scale != Eigen::Vector3d::Ones(); }

// The parts of the text before each of the gaps, which follow each other in it, and the rest.
std::vector<std::string> parts_around(std::span<const std::string> gaps, const std::string& text) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  for (const std::string& gap : gaps) {
    const std::size_t end = text.find(gap, begin);
    check(end != std::string::npos, "a plant's element has its name, pose and scale");
    parts.push_back(text.substr(begin, end - begin));
    begin = end + gap.size();
  }
  parts.push_back(text.substr(begin));
  return parts;
}

}  // namespace

void write_plant(sdfxml::XmlWriter& xml, const farm::Plant& plant, const std::string& uri) {
  xml.open("visual", sdfxml::plant_element_name(plant.id));
  xml.text("pose", sdfxml::sdf_pose(plant.position, plant.rotation));
  sdfxml::write_mesh_geometry(xml, uri, plant.scale);
  sdfxml::write_class(xml, farm::class_of(plant.kind));
  xml.close();
}

PlantVisuals::PlantVisuals(const std::vector<std::string>& uris, int depth) {
  for (const std::string& uri : uris) {
    for (const farm::PlantKind kind : kKinds) {
      for (const double scale : {1, 2}) {
        const farm::Plant plant{.id = 1, .kind = kind, .scale = Eigen::Vector3d::Constant(scale)};
        sdfxml::XmlElements elements(depth);
        write_plant(elements, plant, uri);
        std::vector<std::string> gaps = {sdfxml::plant_element_name(plant.id),
                                         sdfxml::sdf_pose(plant.position, plant.rotation)};
        if (is_scaled(plant)) gaps.push_back(sdfxml::sdf_numbers({scale, scale, scale}));
        parts_.push_back(parts_around(gaps, elements.printed()));
      }
    }
  }
}

const std::vector<std::string>& PlantVisuals::parts_of(const farm::Plant& plant) const {
  const std::size_t of_model = kKinds.size() * plant.model + static_cast<std::size_t>(plant.kind);
  return parts_[2 * of_model + (is_scaled(plant) ? 1 : 0)];
}

void PlantVisuals::append(std::string& text, const farm::Plant& plant) const {
  const std::vector<std::string>& parts = parts_of(plant);
  text.append(parts[0]).append(sdfxml::plant_element_name(plant.id)).append(parts[1]);
  sdfxml::append_sdf_pose(text, plant.position, plant.rotation);
  text.append(parts[2]);
  if (!is_scaled(plant)) return;
  sdfxml::append_sdf_numbers(text, {plant.scale.x(), plant.scale.y(), plant.scale.z()});
  text.append(parts[3]);
}

}  // namespace plotscan::farmfolder
