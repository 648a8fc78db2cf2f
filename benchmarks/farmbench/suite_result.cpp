// SPDX-License-Identifier: Apache-2.0
#include "farmbench/suite_result.h"

#include <algorithm>
#include <utility>

#include "core/format.h"

namespace plotscan::farmbench {

using nlohmann::json;

SuiteResult result_of(const Suite& suite, std::vector<FarmResult> farms) {
  SuiteResult result{.suite = suite.name,
                     .cases = {},
                     .methods = suite.methods,
                     .truths = suite.truths,
                     .published = suite.published,
                     .baseline = suite.baseline,
                     .sweep = suite.sweep,
                     .farms = std::move(farms)};
  for (const CommandMethod& command : suite.commands) {
    if (std::ranges::count(suite.methods, command.name) > 0) result.entered.push_back(command.name);
  }
  for (const SuiteCase& suite_case : suite.cases)
    result.cases.push_back({suite_case.name, suite_case.published_rmse_cm});
  return result;
}

json to_json(const SuiteResult& result) {
  json cases = json::array();
  for (const CaseInfo& info : result.cases) {
    cases.push_back({{"name", info.name}});
    if (info.published_rmse_cm) cases.back()["published_rmse_cm"] = *info.published_rmse_cm;
  }
  json farms = json::array();
  for (const FarmResult& farm : result.farms) farms.push_back(to_json(farm));
  json document = {{"format", kFormat},
                   {"suite", result.suite},
                   {"cases", cases},
                   {"methods", result.methods},
                   {"farms", farms}};
  if (result.published)
    document["published"] = {{"source", result.published->source},
                             {"methods", result.published->methods}};
  if (!result.entered.empty()) document["entered"] = result.entered;
  if (!result.truths.empty()) document["truths"] = result.truths;
  if (result.baseline) document["baseline"] = *result.baseline;
  if (result.sweep) document["sweep"] = to_json(*result.sweep);
  return document;
}

SuiteResult suite_result_from_json(const json& document) {
  SuiteResult result{.suite = document.at("suite"),
                     .cases = {},
                     .methods = document.at("methods"),
                     .entered = document.value("entered", std::vector<std::string>()),
                     .truths = document.value("truths", std::vector<std::string>()),
                     .published = {},
                     .baseline = {},
                     .sweep = {},
                     .farms = {}};
  for (const json& info : document.at("cases")) {
    result.cases.push_back({info.at("name"), {}});
    if (info.contains("published_rmse_cm"))
      result.cases.back().published_rmse_cm = info["published_rmse_cm"].get<double>();
  }
  if (document.contains("published")) {
    const json& published = document["published"];
    result.published = {.source = published.at("source"), .methods = published.at("methods")};
  }
  if (document.contains("baseline")) result.baseline = document["baseline"].get<std::string>();
  if (document.contains("sweep")) result.sweep = sweep_from_json(document["sweep"]);
  for (const json& farm : document.at("farms")) result.farms.push_back(farm_result_from_json(farm));
  return result;
}

}  // namespace plotscan::farmbench
