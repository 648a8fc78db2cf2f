// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/random.h"
#include "strata/random_draws.h"

namespace plotscan::strata {

// The bounds between which a crop's plants are drawn.
struct CropRanges {
  Bounds spread;  // of a field's plants: their scales lie in [1 - spread, 1 + spread]
  std::map<std::string, Bounds> parameters;            // of the crop, as `farmgen plant` knows them
  std::vector<std::pair<std::string, Bounds>> stages;  // and plants a square metre at each
};

// plants.yaml: by crop. Throws InputError on an unknown key or an impossible value.
using PlantRanges = std::map<std::string, CropRanges>;
PlantRanges read_plant_ranges(const std::filesystem::path& file);

// A farm description's overrides, "plants.density_m2=20".
using Overrides = std::vector<std::string>;

// How a plot is sown: the plot's size is the sown area's.
struct Sowing {
  double width_m = 0;
  double length_m = 0;
  int drill_rows = 0;  // along the length, spaced evenly across the width; 0: plants at random
};

// Plants of a crop at one of its stages, drawn: parameters, seeds, number, scales, and in half of
// the fields 4 to 8 cultivars of different heights. `tufts` (wheat): a plant is 0.25 m of a drill
// row.
Overrides draw_plants(const std::string& crop, const CropRanges& ranges, const Sowing& sowing,
                      bool tufts, RandomStream& random);

// 6 to 10 cultivars of a diversity panel, in place of those that are set: at equal steps from 0.35
// to 0.6 times the field's plants up to as much above them.
Overrides draw_panel(RandomStream& random);

// Draws third-party plants (meshes; `folder` holds bean/ and maize/): a mesh, its size, the range
// by which its copies are stretched along each axis, and their number.
Overrides draw_meshes(const std::filesystem::path& folder, RandomStream& random);

// The value of "plants.models": the crop at a stage, 3 to 8 plants of drawn parameters and seed.
// `fixed`: "key=value, ..." of parameters that are not drawn.
std::string drawn_models(const std::string& crop, const std::string& stage,
                         const CropRanges& ranges, const std::string& fixed, RandomStream& random);

}  // namespace plotscan::strata
