// SPDX-License-Identifier: Apache-2.0
#include "strata/hand_measured.h"

#include <algorithm>
#include <map>
#include <utility>

#include "core/random.h"
#include "estimate/measured_heights.h"
#include "methods/agree.h"

namespace plotscan::strata {
namespace {

constexpr const char* kThreePlants = "height_hand3_m";
constexpr const char* kMean = "height_mean_m";

// A plot that was found, and what would be measured in it.
struct HandMeasured {
  PlotId truth;
  PlotId estimate;
  double height_m = 0;
};

using ByTrial = std::map<int, std::vector<HandMeasured>>;

ByTrial found_by_trial(const std::vector<score::TruePlot>& truth,
                       const estimate::Estimate& estimate) {
  std::map<PlotId, int> trials;
  for (const estimate::PlotEstimate& plot : estimate.plots) trials[plot.id] = plot.trial;
  ByTrial found;
  for (const score::PlotScore& plot : score::score_field(truth, estimate).plots) {
    const auto height = plot.truth.heights_m.find(kThreePlants);
    if (plot.found && height != plot.truth.heights_m.end())
      found[trials.at(plot.found->estimate)].push_back(
          {plot.truth.id, plot.found->estimate, height->second});
  }
  return found;
}

// So many of the plots, without replacement (Fisher and Yates).
std::vector<HandMeasured> drawn(std::size_t count, RandomStream& random,
                                std::vector<HandMeasured> plots) {
  for (std::size_t i = 0; i < count; ++i)
    std::swap(plots[i], plots[i + random.below(plots.size() - i)]);
  plots.resize(count);
  return plots;
}

}  // namespace

void agree_with_hand(int plots, int index, std::vector<score::TruePlot>& truth,
                     estimate::Estimate& estimate) {
  const auto count = static_cast<std::size_t>(plots);
  RandomStream random(1, random_purpose("strata/hand_measured"), static_cast<std::uint64_t>(index));
  estimate::MeasuredHeights measured{.file = "hand", .id_column = "plot_number"};
  for (const auto& [trial, found] : found_by_trial(truth, estimate)) {
    if (found.size() <= count) continue;
    for (const HandMeasured& plot : drawn(count, random, found)) {
      measured.plots_m[plot.estimate][kMean] = plot.height_m;
      std::ranges::find(truth, plot.truth, &score::TruePlot::id)->scored = false;
    }
  }
  if (!measured.plots_m.empty()) methods::agree_with(measured, estimate);
}

}  // namespace plotscan::strata
