// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "lidar/fly.h"
#include "strata/beside_plots.h"
#include "strata/plant_draw.h"

namespace plotscan::strata {

// Where fields are drawn from.
struct Sources {
  std::filesystem::path strata;  // field.yaml, plants.yaml: benchmarks/strata
  std::filesystem::path worlds;  // paper_half.yaml, kentland.yaml, ...
  std::filesystem::path meshes;  // plants that others modelled: bean/, maize/; may be absent
};

// What is stated of the plots to the estimator, besides the cloud.
enum class Stated { nothing, width, sides };

// One farm and its flight.
struct FieldPlan {
  std::string stratum;
  int index = 0;  // from 0, in the stratum
  std::uint64_t seed = 0;
  std::filesystem::path farm;  // description, of which `overrides` replace keys
  Overrides overrides = {};
  lidar::FlyOptions flight = {};
  // A larger cloud is thinned to this many random points, as from a lidar that fires less often.
  std::optional<std::size_t> most_points = std::nullopt;
  Beside beside = Beside::nothing;  // drawn by the seed
  // The cloud is cut to the rectangle about the plots, so far from them.
  std::optional<double> margin_m = std::nullopt;
  Stated stated = Stated::nothing;
};

// What makes the field: two plans with equal documents make the same one.
nlohmann::json to_json(const FieldPlan& plan);

// The strata whose fields are farms with plots, in the table's order (docs/benchmark.md).
const std::vector<std::string>& farm_strata();

// A field's own random stream: the same word, stratum and index always draw the same field, any
// change draws another.
RandomStream field_stream(const std::string& word, const std::string& stratum, int index);

// The index-th farm that the word draws in a stratum. Throws InputError on a file of `sources` that
// is missing or broken.
FieldPlan plan_field(const std::string& word, const std::string& stratum, int index,
                     const Sources& sources);

}  // namespace plotscan::strata
