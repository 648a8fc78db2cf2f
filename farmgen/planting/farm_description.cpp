// SPDX-License-Identifier: Apache-2.0
#include "planting/farm_description.h"

#include <utility>

#include "planting/internal/plant_models.h"

namespace plotscan::planting {

std::vector<std::filesystem::path> input_files(const FarmDescription& description) {
  std::vector<std::filesystem::path> files = {description.source};
  for (std::filesystem::path& file : terrain::terrain_files(description.terrain))
    files.push_back(std::move(file));
  if (description.layout) {
    files.push_back(description.layout->plants);
    if (description.layout->plots) files.push_back(*description.layout->plots);
  }
  for (std::filesystem::path& file : model_files(description.models))
    files.push_back(std::move(file));
  return files;
}

}  // namespace plotscan::planting
