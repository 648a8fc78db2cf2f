// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "score/score.h"

namespace plotscan::farmbench {

// One method on one farm.
struct MethodResult {
  std::string method = {};    // Method::name
  double seconds = 0;         // from the map in memory to the heights; 0: not known
  double peak_memory_mb = 0;  // of a program of others; 0: not known
  std::string failure =
      {};  // why the method gave up, "" when it did not; every plot is missed then
  nlohmann::json diagnostics = nlohmann::json::object();  // estimate::to_json of the estimate's
  score::FieldScore score = {};
};

// One farm of a suite: flown, and measured by every method.
struct FarmResult {
  std::string case_name = {};
  std::uint64_t seed = 0;
  nlohmann::json made_from = {};  // all that the result depends on
  std::uint64_t shots = 0;
  std::uint64_t points = 0;
  double flight_s = 0;  // duration of the flight
  std::vector<MethodResult> methods = {};
};

// All but the times, which no two runs share.
void to_json(nlohmann::json& document, const FarmResult& result);
// Throws nlohmann::json::exception on anything that to_json does not write.
void from_json(const nlohmann::json& document, FarmResult& result);

// A farm's name in files, "flat-1".
std::string farm_name(const std::string& case_name, std::uint64_t seed);

// The seconds of each method, and the megabytes where they are known, by its name.
nlohmann::json times_of(const FarmResult& result);
// Sets the times of the methods that `times` names. Throws nlohmann::json::exception on anything
// that times_of does not write.
void set_times(FarmResult& result, const nlohmann::json& times);

}  // namespace plotscan::farmbench
