// SPDX-License-Identifier: Apache-2.0
#include "heights/flags.h"

#include <algorithm>
#include <string_view>

namespace plotscan::heights {
namespace {

constexpr std::string_view kUnsure = " height is unsure by centimetres";

// Own choice.
struct FlagLimits {
  double least_returns_m2 = 60;           // fewer and the plot's top is chance
  std::size_t least_returns = 100;        // in a plot
  double least_scanned_share = 0.9;       // less and the survey's edge cuts the plot
  double least_ground_share = 0.95;       // less of the plot has a ground
  double largest_ground_error_m = 0.025;  // standard error of any place in the plot
  double least_top_m = 0.05;              // lower and there is no crop to measure
  double least_top_sigmas = 3;            // of the heights' noise
  double largest_error_m = 0.025;         // standard error of a height: +-5 cm at 95 %
};
constexpr FlagLimits kLimits;

}  // namespace

std::string unsure_flag(const std::string& name) { return name + std::string(kUnsure); }

bool is_unsure(const Height& height) { return height.standard_error_m > kLimits.largest_error_m; }

std::optional<std::string> height_of_flag(const std::string& flag) {
  if (!flag.ends_with(kUnsure)) return std::nullopt;
  return flag.substr(0, flag.size() - kUnsure.size());
}

bool is_bare(const PlotEvidence& evidence) {
  return evidence.returns > 0 &&
         evidence.top_m <
             std::max(kLimits.least_top_m, kLimits.least_top_sigmas * evidence.noise_m);
}

std::vector<std::string> flags_of(const PlotEvidence& evidence,
                                  const std::map<std::string, Height>& heights) {
  std::vector<std::string> flags;
  const auto raise = [&](bool raised, const char* flag) {
    if (raised) flags.emplace_back(flag);
  };
  const auto returns = static_cast<double>(evidence.returns);
  raise(evidence.returns < kLimits.least_returns ||
            returns < kLimits.least_returns_m2 * evidence.area_m2,
        "too few returns");
  raise(evidence.scanned_share < kLimits.least_scanned_share, "part of the plot was not scanned");
  raise(evidence.ground.reached_share < kLimits.least_ground_share, "no ground within reach");
  raise(evidence.ground.worst_error_m > kLimits.largest_ground_error_m,
        "ground is unsure by centimetres");
  raise(is_bare(evidence), "canopy is too low to measure");
  raise(evidence.reached, "plants of a taller plot beside it reach into it");
  raise(evidence.novelty > 1, "plants unlike those the calibration knows");
  for (const auto& [name, height] : heights)
    if (is_unsure(height)) flags.push_back(unsure_flag(name));
  return flags;
}

}  // namespace plotscan::heights
