// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include <nlohmann/json.hpp>

#include "score/height_score.h"
#include "score/score.h"

namespace plotscan::score {

// As they stand in scores.json (docs/benchmark.md); NaN becomes null.
nlohmann::json to_json(const BoxScore& boxes);
nlohmann::json to_json(const HeightScore& score);

// A field's plots as JSON, and back. field_from_json throws nlohmann::json::exception on anything
// else.
nlohmann::json to_json(const FieldScore& field);
FieldScore field_from_json(const nlohmann::json& document);

// One row a true plot: its box errors, its true heights, its estimated heights.
void write_plot_table(const std::filesystem::path& path, const FieldScore& field);

}  // namespace plotscan::score
