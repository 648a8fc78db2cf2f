// SPDX-License-Identifier: Apache-2.0
#include "methods/agree.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <fmt/core.h>

#include "core/error.h"
#include "core/text.h"
#include "estimate/height_properties.h"
#include "heights/agreement.h"
#include "heights/flags.h"

namespace plotscan::methods {
namespace {

using estimate::PlotEstimate;
using heights::Height;
constexpr const char* kOutOfOrder =
    "heights are out of order: only those measured by hand were moved";

using Pairs = std::vector<heights::MeasuredPair>;

std::set<std::string> measured_names(const estimate::MeasuredHeights& measured) {
  std::set<std::string> names;
  for (const auto& [id, heights_m] : measured.plots_m)
    for (const auto& [property, height_m] : heights_m) names.insert(estimate::height_of(property));
  return names;
}

// Throws unless the estimate has every measured height, and how sure it is of it.
void require_estimated(const estimate::MeasuredHeights& measured,
                       const estimate::Estimate& estimate) {
  std::set<std::string> sure;
  for (const PlotEstimate& plot : estimate.plots)
    for (const auto& [name, error] : plot.errors) sure.insert(name);
  for (const std::string& name : measured_names(measured)) {
    if (sure.contains(name)) continue;
    const std::string property = estimate::property_of(name);
    throw InputError(measured.file,
                     "{} no height that the method gives with a standard error: {}; a column is "
                     "named after one of them, such as height_mean_cm",
                     property == estimate::kUnnamedHeight ? "its column does not say which height "
                                                            "was measured, and is"
                                                          : property + " is",
                     joined({sure.begin(), sure.end()}, ", "));
  }
}

Height height_of(const PlotEstimate& plot, const std::string& name) {
  const estimate::HeightError& error = plot.errors.at(name);
  return {plot.heights_m.at(name), error.standard_error_m, error.low95_m, error.high95_m};
}

void set(const Height& height, const std::string& name, PlotEstimate& plot) {
  plot.heights_m[name] = height.value_m;
  plot.errors[name] = {height.standard_error_m, height.low95_m, height.high95_m};
  const std::string unsure = heights::unsure_flag(name);
  std::erase(plot.flags, unsure);
  if (heights::is_unsure(height)) plot.flags.push_back(unsure);
}

// A height in another unit, or with a digit too many, would move all others. Nobody's plants are
// twice as high as estimated, or half, and five standard errors off.
void require_plausible(const estimate::MeasuredHeights& measured, const std::string& name,
                       const PlotEstimate& plot, double measured_m) {
  constexpr double kMostTimes = 2, kMostErrors = 5;
  const Height estimated = height_of(plot, name);
  const double times = measured_m / estimated.value_m;
  const double errors = std::abs(measured_m - estimated.value_m) / estimated.standard_error_m;
  if ((times <= kMostTimes && times >= 1 / kMostTimes) || errors <= kMostErrors) return;
  throw InputError(measured.file,
                   "plot {} has {} {:g} m, and {:.3f} m by the cloud: is it in another unit than "
                   "its column says, or mistyped?",
                   plot.id.text(), name, measured_m, estimated.value_m);
}

// The plots of each trial that were measured and have this height.
std::map<int, Pairs> pairs_by_trial(const estimate::MeasuredHeights& measured,
                                    const std::string& name, const estimate::Estimate& estimate) {
  std::map<int, Pairs> pairs;
  for (const PlotEstimate& plot : estimate.plots) {
    const auto found = measured.plots_m.find(plot.id);
    if (found == measured.plots_m.end() || !plot.errors.contains(name)) continue;
    const auto height_m = found->second.find(estimate::property_of(name));
    if (height_m == found->second.end() || plot.heights_m.at(name) <= 0) continue;
    require_plausible(measured, name, plot, height_m->second);
    pairs[plot.trial].push_back({height_of(plot, name), height_m->second});
  }
  return pairs;
}

// Whether the heights are in the order that they have by definition.
bool in_order(const PlotEstimate& plot) {
  const auto at = [&](const char* name) {
    const auto found = plot.heights_m.find(name);
    return found == plot.heights_m.end() ? std::nullopt : std::optional(found->second);
  };
  const auto below = [&](const char* low, const char* high) {
    const std::optional<double> lower = at(low), higher = at(high);
    return !lower || !higher || *lower <= *higher;
  };
  return below("mean", "max") && below("p50", "p90") && below("p90", "p95") &&
         below("p95", "p99") && below("p99", "max") && below("canopy_p95", "canopy_p99");
}

}  // namespace

void agree_with(const estimate::MeasuredHeights& measured, estimate::Estimate& estimate) {
  if (estimate.plots.empty()) return;
  require_estimated(measured, estimate);
  estimate::GivenMeasured given{.id_column = measured.id_column,
                                .not_found = estimate::not_found(measured, estimate)};
  for (const std::string& name : measured_names(measured)) {
    for (const auto& [trial, pairs] : pairs_by_trial(measured, name, estimate)) {
      if (pairs.size() < heights::kLeastMeasured) continue;
      const heights::Agreement agreement = heights::agreement(pairs);
      for (PlotEstimate& plot : estimate.plots) {
        if (plot.trial == trial && plot.errors.contains(name))
          set(heights::agreed(agreement, height_of(plot, name)), name, plot);
      }
      given.heights.push_back({.height = name,
                               .trial = trial,
                               .plots = agreement.plots,
                               .factor = agreement.factor,
                               .factor_sd = agreement.factor_sd,
                               .residual_m = agreement.residual_m});
    }
  }
  for (PlotEstimate& plot : estimate.plots)
    if (!in_order(plot)) plot.flags.emplace_back(kOutOfOrder);
  if (given.heights.empty())
    throw InputError(measured.file,
                     "has too few measured plots that are in the estimate: at least {} "
                     "of a trial are needed for a height",
                     heights::kLeastMeasured);
  estimate.diagnostics.measured = std::move(given);
}

}  // namespace plotscan::methods
