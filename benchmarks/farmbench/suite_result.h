// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "farmbench/farm_result.h"
#include "farmbench/suite.h"

namespace plotscan::farmbench {

// What the reports need to know of a case.
struct CaseInfo {
  std::string name;
  std::optional<double> published_rmse_cm = std::nullopt;
};

// A suite that has been run: everything that the reports are made from.
struct SuiteResult {
  std::string suite = {};
  std::vector<CaseInfo> cases = {};
  std::vector<std::string> methods = {};
  std::vector<std::string> entered = {};  // of the methods, those that are not Plotscan's own
  std::vector<std::string> truths = {};   // that the reports show; none: tallest and mean plant
  std::optional<Published> published = std::nullopt;
  std::optional<std::string> baseline = std::nullopt;
  std::optional<Sweep> sweep = std::nullopt;  // case i is its combination i
  std::vector<FarmResult> farms = {};         // by case, by seed, in the suite's order
};

SuiteResult result_of(const Suite& suite, std::vector<FarmResult> farms);

void to_json(nlohmann::json& document, const CaseInfo& info);
void to_json(nlohmann::json& document, const SuiteResult& result);
// Throws nlohmann::json::exception on anything that to_json does not write.
void from_json(const nlohmann::json& document, SuiteResult& result);
// Throws InputError where its parts do not belong together, as tables take for granted that they
// do: cases and farms that are named twice, farms and a baseline of no case, cases that are not the
// combinations of a sweep's axes, no method, no farm.
void require_whole(const SuiteResult& result);

}  // namespace plotscan::farmbench
