// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "farm/farm.h"
#include "sdfxml/xml_file.h"

namespace plotscan::farmfolder {

// A plant's <visual> in world.sdf; `uri` is its model's mesh.
void write_plant(sdfxml::XmlWriter& xml, const farm::Plant& plant, const std::string& uri);

// The same elements, put together from parts of the text that were printed once: a farm has many
// plants, and only names and numbers differ.
class PlantVisuals {
 public:
  // For plants of models with these meshes, where `depth` elements are open.
  PlantVisuals(const std::vector<std::string>& uris, int depth);

  // Appends a plant's element, on a line of its own.
  void append(std::string& text, const farm::Plant& plant) const;

 private:
  const std::vector<std::string>& parts_of(const farm::Plant& plant) const;

  // By model, kind, and whether the plant is scaled: what lies around its name, its pose and, if it
  // is scaled, its scale.
  std::vector<std::vector<std::string>> parts_;
};

}  // namespace plotscan::farmfolder
