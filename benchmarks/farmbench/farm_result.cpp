// SPDX-License-Identifier: Apache-2.0
#include "farmbench/farm_result.h"

#include "score/score_files.h"

namespace plotscan::farmbench {

using nlohmann::json;

json to_json(const FarmResult& result) {
  json methods = json::array();
  for (const MethodResult& method : result.methods) {
    methods.push_back({{"method", method.method},
                       {"failure", method.failure},
                       {"diagnostics", method.diagnostics},
                       {"score", score::to_json(method.score)}});
  }
  return {
      {"case", result.case_name},
      {"seed", result.seed},
      {"made_from", result.made_from},
      {"scan", {{"shots", result.shots}, {"points", result.points}, {"flight_s", result.flight_s}}},
      {"methods", methods}};
}

FarmResult farm_result_from_json(const json& document) {
  const json& scan = document.at("scan");
  FarmResult result{.case_name = document.at("case"),
                    .seed = document.at("seed"),
                    .made_from = document.at("made_from"),
                    .shots = scan.at("shots"),
                    .points = scan.at("points"),
                    .flight_s = scan.at("flight_s"),
                    .methods = {}};
  for (const json& method : document.at("methods")) {
    result.methods.push_back({.method = method.at("method"),
                              .failure = method.at("failure"),
                              .diagnostics = method.at("diagnostics"),
                              .score = score::field_from_json(method.at("score"))});
  }
  return result;
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
