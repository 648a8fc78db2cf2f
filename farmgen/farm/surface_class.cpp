// SPDX-License-Identifier: Apache-2.0
#include "farm/surface_class.h"

#include <optional>

namespace plotscan::farm {

std::vector<SurfaceClass> classes_of_models(const Farm& farm) {
  std::vector<std::optional<SurfaceClass>> first(farm.models.size());
  for (const Plant& plant : farm.plants) {
    std::optional<SurfaceClass>& label = first.at(plant.model);
    if (!label) label = class_of(plant.kind);
  }
  std::vector<SurfaceClass> classes;
  classes.reserve(first.size());
  for (const auto& label : first) classes.push_back(label.value_or(SurfaceClass::crop));
  return classes;
}

}  // namespace plotscan::farm
