// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "cloud/area.h"
#include "estimate/estimate.h"
#include "farmbench/farm_result.h"
#include "farmbench/suite.h"
#include "score/score.h"
#include "terrain/terrain.h"

// What a suite's page shows of one farm of each case.
namespace plotscan::farmbench {

struct FarmView {
  std::filesystem::path scan;  // folder, or the cloud where only that was given to the methods
  cloud::Area area;            // of which points are shown
  std::size_t points = 1;      // at most
  // Of the suite's methods; the first one's plots are shown, and how each came to its own.
  const std::vector<estimate::Estimate>& estimates;
  const std::vector<score::TruePlot>& truth;
  const terrain::Terrain& terrain;
  const FarmResult& result;  // whose case, seed and counts are shown
};

// How many points a farm's view has at most, so that a page with one farm of each case stays small.
std::size_t view_points(const Suite& suite);

// Where a results folder keeps a farm's view.
std::filesystem::path farm_view_file(const std::filesystem::path& output, const std::string& farm);

// Writes report::packed_field of the farm as CBOR.
void write_farm_view(const std::filesystem::path& file, const FarmView& view);

// Reads it back; absent where there is no such file. Throws InputError where it is broken.
std::optional<nlohmann::json> read_farm_view(const std::filesystem::path& file);

}  // namespace plotscan::farmbench
