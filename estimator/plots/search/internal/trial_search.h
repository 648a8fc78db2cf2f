// SPDX-License-Identifier: Apache-2.0
#pragma once

// The search of a field for plots of one size at equal steps.

#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "plots/canopy/field_blocks.h"
#include "plots/ground_error.h"
#include "plots/hints.h"
#include "plots/plot_field.h"

namespace plotscan::plots {

// A field as it was scanned, and what is known of it. Keeps references.
struct ScannedField {
  std::span<const Eigen::Vector3f> points;  // x, y, height above the ground, metres
  const FieldBlocks& blocks;                // of the points
  double noise_m = 0;                       // sigma of the heights
  const Hints& hints;
  int threads = 1;
  const GroundError& ground_error;
};

// What a look at a field shows: plots, or a layout that is refused, or nothing.
struct Look {
  PlotField field;
  double evidence = 0;       // of its plots; 0 where there are none
  std::size_t may_be = 0;    // plots, refused ones too, if those may be a trial beside others
  std::size_t edgeless = 0;  // of its plots: those at whose sides canopy does not end
  double explained = 0;      // share of all that stands on the field, in the plots and their gaps
};

// The number of plots that show edges, times the field's confidence; 0 without plots.
double expected_plots(const Look& look);

// Of what stands on a field: what is left is no trial.
inline constexpr double kNearlyAll = 0.97;

// Looks at all canopy together, with each of the heights that the crop may have.
Look look_once(const ScannedField& scanned);
// The same, and also as if nothing but plots stood here: where only that shows plots, or shows that
// they are nearly all.
Look look_twice(const ScannedField& scanned);

// What shows of all canopy along each pair of axes and, where the best of it does not explain
// nearly all of the canopy, the best of this and of other explanations (docs/plot-finding.md, step
// 11).
struct Looks {
  std::vector<Look> at_all;
  Look best;
};
Looks look_in_all_ways(const ScannedField& scanned);

}  // namespace plotscan::plots
