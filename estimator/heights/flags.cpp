// SPDX-License-Identifier: Apache-2.0
#include "heights/flags.h"

#include <algorithm>
#include <string_view>

namespace plotscan::heights {
namespace {

constexpr std::string_view kUnsure = " height is unsure by centimetres";

}  // namespace

std::string unsure_flag(const std::string& name) { return name + std::string(kUnsure); }

bool is_unsure(const Height& height, const FlagOptions& options) {
  return height.standard_error_m > options.largest_error_m;
}

std::optional<std::string> height_of_flag(const std::string& flag) {
  if (!flag.ends_with(kUnsure)) return std::nullopt;
  return flag.substr(0, flag.size() - kUnsure.size());
}

bool is_bare(const PlotEvidence& evidence, const FlagOptions& options) {
  return evidence.returns > 0 &&
         evidence.top_m <
             std::max(options.least_top_m, options.least_top_sigmas * evidence.noise_m);
}

std::vector<std::string> flags_of(const PlotEvidence& evidence,
                                  const std::map<std::string, Height>& heights,
                                  const FlagOptions& options) {
  std::vector<std::string> flags;
  const auto raise = [&](bool raised, const char* flag) {
    if (raised) flags.emplace_back(flag);
  };
  const auto returns = static_cast<double>(evidence.returns);
  raise(evidence.returns < options.least_returns ||
            returns < options.least_returns_m2 * evidence.area_m2,
        "too few returns");
  raise(evidence.scanned_share < options.least_scanned_share, "part of the plot was not scanned");
  raise(evidence.ground.reached_share < options.least_ground_share, "no ground within reach");
  raise(evidence.ground.worst_error_m > options.largest_ground_error_m,
        "ground is unsure by centimetres");
  raise(is_bare(evidence, options), "canopy is too low to measure");
  raise(evidence.reached, "plants of a taller plot beside it reach into it");
  raise(evidence.novelty > 1, "plants unlike those the calibration knows");
  for (const auto& [name, height] : heights)
    if (is_unsure(height, options)) flags.push_back(unsure_flag(name));
  return flags;
}

}  // namespace plotscan::heights
