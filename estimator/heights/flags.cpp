// SPDX-License-Identifier: Apache-2.0
#include "heights/flags.h"

#include <algorithm>

namespace plotscan::heights {

bool is_unsure(const Height& mean, const FlagOptions& options) {
  return mean.standard_error_m > options.largest_error_m;
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
  raise(evidence.novelty > 1, "plants unlike those the calibration knows");
  const auto mean = heights.find("mean");
  raise(mean != heights.end() && is_unsure(mean->second, options), kUnsureMean);
  return flags;
}

}  // namespace plotscan::heights
