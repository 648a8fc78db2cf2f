// SPDX-License-Identifier: Apache-2.0
#include "farmbench/suite_result.h"

#include <set>
#include <utility>

#include "core/contains.h"
#include "core/error.h"
#include "core/format_version.h"

namespace plotscan::farmbench {
namespace {

using nlohmann::json;

void require_axes(const Sweep& sweep, std::size_t cases) {
  std::size_t combinations = 1;
  for (const SweepAxis& axis : sweep.axes) {
    combinations *= axis.values.size();
    for (const json& value : axis.values)
      if (!value.is_number() && !value.is_string())
        throw InputError("axis " + axis.key + " has the value " + value.dump() +
                         "; it must be a number or a text");
  }
  if (combinations != cases)
    throw InputError("the sweep's axes have " + std::to_string(combinations) +
                     " combinations; they must be its cases, " + std::to_string(cases));
}

}  // namespace

SuiteResult result_of(const Suite& suite, std::vector<FarmResult> farms) {
  SuiteResult result{.suite = suite.name,
                     .methods = suite.methods,
                     .truths = suite.truths,
                     .published = suite.published,
                     .baseline = suite.baseline,
                     .sweep = suite.sweep,
                     .farms = std::move(farms)};
  for (const CommandMethod& command : suite.commands) {
    if (contains(suite.methods, command.name)) result.entered.push_back(command.name);
  }
  for (const SuiteCase& suite_case : suite.cases)
    result.cases.push_back({suite_case.name, suite_case.published_rmse_cm});
  return result;
}

void to_json(json& document, const CaseInfo& info) {
  document = {{"name", info.name}};
  if (info.published_rmse_cm) document["published_rmse_cm"] = *info.published_rmse_cm;
}

void from_json(const json& document, CaseInfo& info) {
  info = {.name = document.at("name")};
  if (document.contains("published_rmse_cm"))
    info.published_rmse_cm = document["published_rmse_cm"].get<double>();
}

void to_json(json& document, const SuiteResult& result) {
  document = {{"format", kFormat},
              {"suite", result.suite},
              {"cases", result.cases},
              {"methods", result.methods},
              {"farms", result.farms}};
  if (result.published) document["published"] = *result.published;
  if (!result.entered.empty()) document["entered"] = result.entered;
  if (!result.truths.empty()) document["truths"] = result.truths;
  if (result.baseline) document["baseline"] = *result.baseline;
  if (result.sweep) document["sweep"] = *result.sweep;
}

void from_json(const json& document, SuiteResult& result) {
  result = {.suite = document.at("suite"),
            .cases = document.at("cases"),
            .methods = document.at("methods"),
            .entered = document.value("entered", std::vector<std::string>()),
            .truths = document.value("truths", std::vector<std::string>())};
  if (document.contains("published")) result.published = document["published"].get<Published>();
  if (document.contains("baseline")) result.baseline = document["baseline"].get<std::string>();
  if (document.contains("sweep")) result.sweep = document["sweep"].get<Sweep>();
  document.at("farms").get_to(result.farms);
}

void require_whole(const SuiteResult& result) {
  if (result.methods.empty()) throw InputError("names no method; it must have one or more");
  if (result.farms.empty()) throw InputError("has no farms; it must have one or more");
  std::set<std::string> cases;
  for (const CaseInfo& info : result.cases)
    if (!cases.insert(info.name).second)
      throw InputError("has two cases " + info.name + "; each must have a name of its own");
  std::set<std::pair<std::string, std::uint64_t>> farms;
  for (const FarmResult& farm : result.farms) {
    const std::string name = farm_name(farm.case_name, farm.seed);
    if (!cases.contains(farm.case_name))
      throw InputError("farm " + name + " is of no case; its case must be one of \"cases\"");
    if (!farms.emplace(farm.case_name, farm.seed).second)
      throw InputError("has two farms " + name + "; it must have each once");
  }
  if (result.baseline && !cases.contains(*result.baseline))
    throw InputError("the baseline " + *result.baseline + " must be one of \"cases\"");
  if (result.sweep) require_axes(*result.sweep, result.cases.size());
}

}  // namespace plotscan::farmbench
