// SPDX-License-Identifier: Apache-2.0
#include "planting/farm_description.h"

namespace plotscan::planting {

std::vector<std::filesystem::path> input_files(const FarmDescription& description) {
  const terrain::TerrainDescription& terrain = description.terrain;
  std::vector<std::filesystem::path> files = {description.source};
  if (terrain.mesh) files.push_back(*terrain.mesh);
  if (terrain.heightmap) files.push_back(terrain.heightmap->image);
  if (terrain.xyz) files.push_back(terrain.xyz->file);
  if (description.layout) {
    files.push_back(description.layout->plants);
    if (description.layout->plots) files.push_back(*description.layout->plots);
  }
  for (const ModelDescription& model : description.models) {
    if (!model.grown) files.push_back(model.mesh);
    if (model.light) files.push_back(*model.light);
  }
  return files;
}

}  // namespace plotscan::planting
