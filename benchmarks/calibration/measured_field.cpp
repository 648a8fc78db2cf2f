// SPDX-License-Identifier: Apache-2.0
#include "calibration/measured_field.h"

#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "heights/features.h"
#include "heights/known_returns.h"

namespace plotscan::calibration {
namespace {

// A share of the returns, drawn for the farm: all of half of the farms, else 1 to 1/30, but about
// 100 a square metre.
double kept_share(const FieldSample& sample) {
  constexpr double kLeast_m2 = 100;
  RandomStream random(sample.seed, random_purpose("calibration/thinned"), 0);
  if (random.uniform() < 0.5) return 1;
  const double share = std::pow(10, -random.uniform(0, 1.5));
  double returns = 0;
  double area_m2 = 0;
  for (const PlotSample& plot : sample.plots) {
    returns += static_cast<double>(plot.points.size());
    area_m2 += plot.box.area_m2();
  }
  return std::max(share, kLeast_m2 * area_m2 / std::max(1.0, returns));
}

std::vector<Eigen::Vector3f> thinned(const PlotSample& plot, double share, std::uint64_t seed,
                                     std::size_t number) {
  RandomStream random(seed, random_purpose("calibration/thin"), number);
  std::vector<Eigen::Vector3f> kept;
  for (const Eigen::Vector3f& point : plot.points)
    if (random.uniform() < share) kept.push_back(point);
  return kept;
}

}  // namespace

MeasuredField measure(const FieldSample& sample, Returns returns) {
  constexpr double kLeastTop_m = 0.05;
  MeasuredField field{.library = sample.library, .plots = {}};
  const bool perfect = returns == Returns::perfect;
  const double noise_m = perfect ? 0 : sample.surface.noise_m;
  const double share = kept_share(sample);
  for (std::size_t i = 0; i < sample.plots.size(); ++i) {
    const PlotSample& plot = sample.plots[i];
    const std::vector<Eigen::Vector3f> points =
        perfect ? plot.perfect : thinned(plot, share, sample.seed, i);
    if (points.empty()) continue;
    const heights::KnownReturns known = heights::known_returns(plot.box, points, sample.surface);
    heights::CanopyFeatures features =
        heights::see_canopy(plot.box, perfect ? points : known.points, noise_m, known.ground.slope)
            .features;
    if (features.top_m < kLeastTop_m) continue;
    field.plots.push_back(
        {.top_m = features.top_m, .features = std::move(features.values), .truth = plot.truth});
  }
  return field;
}

Eigen::VectorXd ratios_of(const MeasuredPlot& plot, const std::vector<std::string>& heights) {
  Eigen::VectorXd ratios(static_cast<Eigen::Index>(heights.size()));
  for (std::size_t k = 0; k < heights.size(); ++k)
    ratios(static_cast<Eigen::Index>(k)) = plot.truth.at(heights[k]) / plot.top_m;
  return ratios;
}

}  // namespace plotscan::calibration
