// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "plots/ground_error.h"
#include "plots/hints.h"
#include "plots/plot_field.h"

namespace plotscan::plots {

// Finds the plots of a field from its points as (x, y, height above the ground), metres; boxes are
// in the frame of x and y. Each of the trials that lie on the field has plots with a size, steps
// and a heading of its own: one result for each, from the south-west on (x + y). Where no plots are
// found, one result says why (`why_none`). noise_m is the sigma of the heights; with ground_error,
// ridges that the ground's model may have cut off do not count as canopy. Same result for any
// number of threads.
std::vector<PlotField> find_trials(std::span<const Eigen::Vector3f> points, double noise_m,
                                   const Hints& hints, int threads,
                                   const GroundError& ground_error = {});

}  // namespace plotscan::plots
