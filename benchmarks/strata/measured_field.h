// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "score/score.h"
#include "strata/kept_field.h"

namespace plotscan::strata {

// What the estimator made of one field.
struct MeasuredField {
  std::string stratum;  // or the kind of a field without plots
  int index = 0;
  score::FieldScore score;  // without plots: all that was found is extra
  // How sure the estimator was of each plot that it found, true and false ones; those that it says
  // nothing of are in neither.
  std::vector<double> true_confidences = {};
  std::vector<double> false_confidences = {};
  // Of the found plots' boxes: centres along both axes, widths and lengths of which the estimator
  // says how sure it is, and those within 1.96 of its standard errors of the true ones.
  std::size_t box_figures = 0, box_figures_inside = 0;
  std::size_t points = 0;  // of the cloud
  double seconds = 0;      // from the cloud's file to the heights
  std::string failure;     // why the estimator gave up; "" when it did not
};

// Runs the default method on the cloud and nothing else, and scores what it says.
MeasuredField measure_field(const std::string& stratum, int index, const KeptField& field,
                            int threads);

}  // namespace plotscan::strata
