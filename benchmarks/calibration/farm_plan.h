// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "lidar/fly.h"

namespace plotscan::calibration {

using Bounds = std::pair<double, double>;

// Plants of one kind, and how they may stand.
struct Library {
  std::string name;
  std::string crop;
  std::string stage;
  std::map<std::string, std::string> set = {};  // parameters of the crop
  std::map<std::string, Bounds> vary = {};      // others, drawn for each farm
  Bounds density_m2 = {0, 0};  // plants a square metre where they stand at random, else 0
  Bounds row_m = {0, 0};       // between drilled rows
  double spacing_m = 0.25;     // from plant to plant in them
  Bounds spread = {0, 0};      // scales are in [1 - spread, 1 + spread]
  Bounds variants = {1, 1};    // different plants
};

// Reads libraries.yaml. Throws InputError on an unknown key or an impossible value.
std::vector<Library> read_libraries(const std::filesystem::path& file);

// One farm and its flight.
struct FarmPlan {
  std::string library;
  std::uint64_t seed = 0;
  std::vector<std::string> overrides;  // of the base farm's description
  lidar::FlyOptions flight;
};

// The number-th farm of a library, drawn from both: its plants, their density and scales, plots,
// terrain, height and speed of the flight, noise, beam and wind.
FarmPlan plan_farm(const Library& library, std::size_t library_number, int number);

}  // namespace plotscan::calibration
