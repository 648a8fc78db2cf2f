// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "score/score.h"
#include "strata/field_plan.h"
#include "strata/kept_field.h"

namespace plotscan::strata {

// The estimator's result for one field.
struct MeasuredField {
  std::string stratum;  // or the kind of a field without plots
  int index = 0;
  score::FieldScore score;  // without plots: all that was found is extra
  // The estimator's confidence in each plot that it found, for true and for false ones; plots
  // without a confidence are in neither.
  std::vector<double> true_confidences = {};
  std::vector<double> false_confidences = {};
  // Counts over the found plots' boxes of figures (centre along both axes, width, length) with a
  // standard error, and of those within 1.96 standard errors of the true ones.
  std::size_t box_figures = 0, box_figures_inside = 0;
  std::size_t points = 0;  // of the cloud
  double seconds = 0;      // from the cloud's file to the heights
  std::string failure;     // why the estimator gave up; "" when it did not
};

struct MeasureOptions {
  Stated stated = Stated::nothing;
  int hand_measured = 0;  // plots of each trial that are measured by hand (agree_with_hand)
  int threads = 1;
};

// Runs the default method on the cloud and on what is stated of the plots, and scores its estimate.
MeasuredField measure_field(const std::string& stratum, int index, const KeptField& field,
                            const MeasureOptions& options);

}  // namespace plotscan::strata
