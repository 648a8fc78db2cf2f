// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>

#include "core/progress.h"
#include "farmbench/farm_result.h"
#include "farmbench/suite.h"

namespace plotscan::farmbench {

// All that a farm's result depends on: the version and build of Plotscan, the farm's description
// and meshes (by hash), what the suite replaces in it, the seed, the flight, the methods.
nlohmann::json made_from(const Suite& suite, const SuiteCase& suite_case, std::uint64_t seed,
                         const std::string& build);

// Generates the farm into `folder`/farm, scans it into `folder`/scan, runs and scores every method.
// A method that finds no plots (InputError) is scored as having missed them all. Throws InputError
// when the farm cannot be made or flown.
FarmResult run_farm(const Suite& suite, const SuiteCase& suite_case, std::uint64_t seed,
                    const std::filesystem::path& folder, int threads,
                    const ProgressReport& progress);

}  // namespace plotscan::farmbench
