// SPDX-License-Identifier: Apache-2.0
#include "farm/surface_class.h"

#include <optional>

#include "core/list_of.h"

namespace plotscan::farm {

std::vector<SurfaceClass> classes_of_models(const Farm& farm) {
  std::vector<std::optional<SurfaceClass>> first(farm.models.size());
  for (const Plant& plant : farm.plants) {
    std::optional<SurfaceClass>& label = first.at(plant.model);
    if (!label) label = class_of(plant.kind);
  }
  return list_of(first, [](const auto& label) { return label.value_or(SurfaceClass::crop); });
}

}  // namespace plotscan::farm
