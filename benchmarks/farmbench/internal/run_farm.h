// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include <nlohmann/json.hpp>

#include "core/progress.h"
#include "farmbench/farm_result.h"
#include "farmbench/farm_scan.h"

namespace plotscan::farmbench {

// All that a farm's result depends on: the version and build of Plotscan, the farm's description
// and meshes (by hash), what the suite replaces in it, the seed, the flight, the methods.
nlohmann::json made_from(const Suite& suite, const SuiteCase& suite_case, std::uint64_t seed,
                         const std::string& build);

// One farm of a suite to be run.
struct FarmRun {
  const Suite& suite;
  FarmPlace place;
  // A file for what pages show of the farm (farm_view.h), of the suite's first method.
  std::optional<std::filesystem::path> view = std::nullopt;
};

// Generates the farm into place.folder/farm, scans it into place.folder/scan, runs and scores every
// method. A method that finds no plots (InputError) is scored as having missed them all. Throws
// InputError when the farm cannot be made or flown.
FarmResult run_farm(const FarmRun& run, const ProgressReport& progress);

}  // namespace plotscan::farmbench
