// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "lidar/fly.h"

namespace plotscan::calibration {

using Bounds = std::pair<double, double>;

// Plants of one kind, and how they may be sown: at random if only a density is stated, in drilled
// rows if only a spacing is stated, either way if both are.
struct Library {
  std::string name;
  std::string crop;
  std::string stage;
  std::optional<double> height_m = {};          // of a usual plant, where plants may be stretched
  std::map<std::string, std::string> set = {};  // parameters of the crop
  std::map<std::string, Bounds> vary = {};      // others, drawn for each farm
  std::set<std::string> always = {};            // of these, which farms of usual plants draw too
  std::optional<Bounds> density_m2 = {};        // plants a square metre
  std::optional<Bounds> row_m = {};             // between drilled rows
  std::optional<Bounds> spacing_m = {};         // from plant to plant in them
  Bounds spread = {0, 0};                       // scales are in [1 - spread, 1 + spread]
  Bounds variants = {1, 1};                     // different plants
  std::optional<Bounds> vigour = {};            // scale of all of them, in a third of the farms
  std::uint64_t first_seed = 0;                 // of the farms
};

// Reads libraries.yaml; parameters that a library does not set are drawn from the ranges named
// `ranges` in that file. Throws InputError on an unknown key or an impossible value.
std::vector<Library> read_libraries(const std::filesystem::path& file, const std::string& ranges);

// One farm and its flight.
struct FarmPlan {
  std::string library;
  std::uint64_t seed = 0;
  std::vector<std::string> overrides;  // of the base farm's description
  lidar::FlyOptions flight;
};

// The number-th farm of a library. library_number and `number` determine all that is drawn: plants,
// their sowing and scales, cultivars, plots, terrain, sensor, height and speed of the flight,
// noise, beam, wind and errors of the poses.
FarmPlan plan_farm(const Library& library, std::size_t library_number, int number);

}  // namespace plotscan::calibration
