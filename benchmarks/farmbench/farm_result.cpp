// SPDX-License-Identifier: Apache-2.0
#include "farmbench/farm_result.h"

#include "score/score_files.h"

namespace plotscan::farmbench {

using nlohmann::json;

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(MethodResult, method, failure, diagnostics, score)

void to_json(json& document, const FarmResult& result) {
  document = {
      {"case", result.case_name},
      {"seed", result.seed},
      {"made_from", result.made_from},
      {"scan", {{"shots", result.shots}, {"points", result.points}, {"flight_s", result.flight_s}}},
      {"methods", result.methods}};
}

void from_json(const json& document, FarmResult& result) {
  const json& scan = document.at("scan");
  result = {.case_name = document.at("case"),
            .seed = document.at("seed"),
            .made_from = document.at("made_from"),
            .shots = scan.at("shots"),
            .points = scan.at("points"),
            .flight_s = scan.at("flight_s"),
            .methods = document.at("methods")};
}

std::string farm_name(const std::string& case_name, std::uint64_t seed) {
  return case_name + "-" + std::to_string(seed);
}

json times_of(const FarmResult& result) {
  json times = json::object();
  for (const MethodResult& method : result.methods) {
    times[method.method] = {{"seconds", method.seconds}};
    if (method.peak_memory_mb > 0) times[method.method]["peak_memory_mb"] = method.peak_memory_mb;
  }
  return times;
}

void set_times(FarmResult& result, const json& times) {
  for (MethodResult& method : result.methods) {
    const auto taken = times.find(method.method);
    if (taken == times.end()) continue;
    method.seconds = taken->at("seconds").get<double>();
    method.peak_memory_mb = taken->value("peak_memory_mb", 0.0);
  }
}

}  // namespace plotscan::farmbench
