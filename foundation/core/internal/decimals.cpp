// SPDX-License-Identifier: Apache-2.0
#include "core/internal/decimals.h"

#include <algorithm>
#include <cmath>

namespace plotscan {
namespace {

constexpr int kFew = 6;

// The decimals of a number; kFew + 1 where there are more.
int decimals_of(double degrees) {
  constexpr double kExact = 1e-6;  // of the last decimal: doubles of 180 degrees hold 1e-8 of it
  double scaled = degrees;
  int decimals = 0;
  for (; decimals <= kFew; ++decimals, scaled *= 10)
    if (std::abs(scaled - std::round(scaled)) < kExact) break;
  return decimals;
}

// The most in nested lists of positions; -1 where there is none. A third number is a height.
int most_decimals(const nlohmann::json& coordinates) {
  if (!coordinates.is_array() || coordinates.empty()) return -1;
  int most = -1;
  if (coordinates[0].is_number()) {
    for (std::size_t i = 0; i < std::min<std::size_t>(coordinates.size(), 2); ++i)
      if (coordinates[i].is_number())
        most = std::max(most, decimals_of(coordinates[i].get<double>()));
    return most;
  }
  for (const nlohmann::json& part : coordinates) most = std::max(most, most_decimals(part));
  return most;
}

}  // namespace

std::optional<int> few_decimals_of(const nlohmann::json& map) {
  int most = -1;
  for (const nlohmann::json& feature : map.at("features")) {
    if (!feature.contains("geometry") || !feature["geometry"].is_object()) continue;
    const nlohmann::json& geometry = feature["geometry"];
    if (geometry.contains("coordinates"))
      most = std::max(most, most_decimals(geometry["coordinates"]));
  }
  return most >= 0 && most <= kFew ? std::optional(most) : std::nullopt;
}

}  // namespace plotscan
