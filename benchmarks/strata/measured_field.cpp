// SPDX-License-Identifier: Apache-2.0
#include "strata/measured_field.h"

#include <chrono>
#include <set>

#include "methods/lattice/lattice.h"

#include "core/error.h"

namespace plotscan::strata {

MeasuredField measure_field(const std::string& stratum, int index, const KeptField& field,
                            int threads) {
  MeasuredField measured{.stratum = stratum, .index = index, .score = {}, .failure = {}};
  estimate::Estimate estimate{.method = "lattice"};
  const auto start = std::chrono::steady_clock::now();
  try {
    estimate = methods::lattice::estimate_plots(field.cloud, {.threads = threads});
    measured.points = estimate.diagnostics.points.value().read;
  } catch (const InputError& error) {
    measured.failure = error.what();
  }
  measured.seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const std::vector<score::TruePlot> truth =
      field.farm.empty() ? std::vector<score::TruePlot>{} : score::read_truth(field.farm);
  measured.score = score::score_field(truth, estimate);
  const std::set<PlotId> extra(measured.score.extra.begin(), measured.score.extra.end());
  for (const estimate::PlotEstimate& plot : estimate.plots) {
    if (!plot.confidence) continue;
    (extra.contains(plot.id) ? measured.false_confidences : measured.true_confidences)
        .push_back(*plot.confidence);
  }
  return measured;
}

}  // namespace plotscan::strata
