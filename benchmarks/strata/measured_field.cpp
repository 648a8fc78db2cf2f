// SPDX-License-Identifier: Apache-2.0
#include "strata/measured_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "core/error.h"
#include "core/stopwatch.h"
#include "methods/lattice/lattice.h"
#include "strata/hand_measured.h"

namespace plotscan::strata {

namespace {

// Ends of a normal distribution's 95 %.
constexpr double kSigmas95 = 1.96;

void count_box_figures(const PlotBox& truth, const estimate::PlotEstimate& plot,
                       MeasuredField& field) {
  if (!plot.box_error) return;
  const PlotBoxError& error = *plot.box_error;
  const Eigen::Vector2d off = truth.box_from_world(plot.box.center);
  const std::array figures = {std::pair{off.x(), error.along_m}, std::pair{off.y(), error.across_m},
                              std::pair{plot.box.length_m - truth.length_m, error.length_m},
                              std::pair{plot.box.width_m - truth.width_m, error.width_m}};
  for (const auto& [off_m, standard_error_m] : figures) {
    ++field.box_figures;
    field.box_figures_inside += std::abs(off_m) <= kSigmas95 * standard_error_m ? 1 : 0;
  }
}

methods::lattice::Options stated_to_lattice(Stated stated,
                                            const std::vector<score::TruePlot>& truth,
                                            int threads) {
  methods::lattice::Options options{.threads = threads};
  if (stated == Stated::nothing) return options;
  const PlotBox& plot = truth.front().box;
  const auto [width_m, length_m] = std::minmax(plot.width_m, plot.length_m);
  options.plot_width_m = width_m;
  // Of plots that are wider than long it is the length that nothing shows.
  if (stated == Stated::sides || plot.width_m > plot.length_m) options.plot_length_m = length_m;
  return options;
}

}  // namespace

MeasuredField measure_field(const std::string& stratum, int index, const KeptField& field,
                            const MeasureOptions& options) {
  MeasuredField measured{.stratum = stratum, .index = index, .score = {}, .failure = {}};
  std::vector<score::TruePlot> truth =
      field.farm.empty() ? std::vector<score::TruePlot>{} : score::read_truth(field.farm);
  estimate::Estimate estimate{.method = "lattice"};
  const Stopwatch watch;
  try {
    estimate = methods::lattice::estimate_plots(
        field.cloud, stated_to_lattice(options.stated, truth, options.threads));
    measured.points = estimate.diagnostics.points.value().read;
  } catch (const InputError& error) {
    measured.failure = error.what();
  }
  measured.seconds = watch.seconds();
  if (options.hand_measured > 0) agree_with_hand(options.hand_measured, index, truth, estimate);
  measured.score = score::score_field(truth, estimate);
  const std::set<PlotId> extra(measured.score.extra.begin(), measured.score.extra.end());
  for (const estimate::PlotEstimate& plot : estimate.plots) {
    if (!plot.confidence) continue;
    (extra.contains(plot.id) ? measured.false_confidences : measured.true_confidences)
        .push_back(*plot.confidence);
  }
  for (const score::PlotScore& plot : measured.score.plots) {
    if (!plot.found) continue;
    const auto found =
        std::ranges::find(estimate.plots, plot.found->estimate, &estimate::PlotEstimate::id);
    count_box_figures(plot.truth.box, *found, measured);
  }
  return measured;
}

}  // namespace plotscan::strata
