// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include <nlohmann/json.hpp>

#include "score/height_score.h"
#include "score/score.h"

namespace plotscan::score {

// As they stand in scores.json (docs/benchmark.md); NaN becomes null.
void to_json(nlohmann::json& document, const BoxScore& boxes);
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(HeightScore, height, truth, plots, without, rmse_m, bias_m,
                                   mae_m, standard_error_m, r2, correlation2, coverage95, flagged,
                                   large_unflagged, large_unflagged_share)
void to_json(nlohmann::json& document, const TrialScore& trial);

// A field's plots as JSON, and back. from_json throws nlohmann::json::exception on anything else.
void to_json(nlohmann::json& document, const FieldScore& field);
void from_json(const nlohmann::json& document, FieldScore& field);

// One row a true plot: its box errors, its true heights, its estimated heights.
void write_plot_table(const std::filesystem::path& path, const FieldScore& field);

}  // namespace plotscan::score
