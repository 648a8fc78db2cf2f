// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "crop/cultivar.h"
#include "crop/plant_builder.h"
#include "mesh/mesh.h"

namespace plotscan::crop {

struct GrowOptions {
  std::string crop;                           // one of crops()
  std::string stage = {};                     // one of stages(crop); empty: the default stage
  std::vector<std::string> assignments = {};  // "key=value" in place of the crop's parameters
  Detail detail = Detail::scan;
  std::string cultivar_file = {};  // a user's file over the crop's own (docs/plants.md); or empty
  // Materials get pictures of their surfaces (crop/internal/textures.h) in place of plain colours.
  bool textured = false;
};

// "soybean", ...
std::vector<std::string> crops();
// The growth stages of a crop, in the order in which it passes through them.
std::vector<std::string> stages(const std::string& crop);
// A crop with its parameters, stages and default plot; with a user's file over it where one is
// named. Throws InputError on an unknown crop or a file that is not sound.
Cultivar cultivar(const std::string& crop, const std::string& file = "");

// Published facts of a crop's default plot at a stage.
struct StageFacts {
  Stage stage;
  double plants_per_m2 = 0;
  double row_spacing_m = 0;
};
// The default stage for "", with a user's file as in cultivar(). Throws InputError on an unknown
// crop or stage, or a file that is not sound.
StageFacts stage_facts(const std::string& crop, const std::string& stage = "",
                       const std::string& file = "");

// Grows one plant, its stem's foot at the origin, metres, z up. The same options and seed give the
// same mesh; both details show the same plant. Throws InputError on an unknown crop, stage or key,
// or a value out of its range.
mesh::Mesh grow(const GrowOptions& options, std::uint64_t seed);

}  // namespace plotscan::crop
