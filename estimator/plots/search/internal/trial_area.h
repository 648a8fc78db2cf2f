// SPDX-License-Identifier: Apache-2.0
#pragma once

// The ground that a trial takes.

#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/plot_box.h"
#include "core/trial_layout.h"

namespace plotscan::plots {

// The gap between a trial's plots, metres; pitch_m is 0 where there is one row or column.
double gap_of_trial_m(double pitch_m, double size_m);

// A trial's plots, each with half of the gaps beside it: leaves hang into them. In the frame of the
// layout.
std::vector<PlotBox> area_of(const TrialLayout& layout);

// The rectangle about all of a trial's plots, along its plots' sides.
PlotBox outline_of(const TrialLayout& layout);

// The finite points that lie in none of the boxes, to within 0.1 m.
std::vector<Eigen::Vector3f> points_outside(std::span<const Eigen::Vector3f> points,
                                            std::span<const PlotBox> boxes);

}  // namespace plotscan::plots
