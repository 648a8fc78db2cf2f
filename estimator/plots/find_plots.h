// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "plots/ground_error.h"
#include "plots/hints.h"
#include "plots/plot_field.h"

namespace plotscan::plots {

// Finds the plots of one trial in a field from its points as (x, y, height above the ground),
// metres; boxes are in the frame of x and y. noise_m is the sigma of the heights; with
// ground_error, ridges that the ground's model may have cut off do not count as canopy. Without
// plots, `why_none` of the result says why. Same result for any number of threads.
PlotField find_plots(std::span<const Eigen::Vector3f> points, double noise_m, const Hints& hints,
                     int threads, const GroundError& ground_error = {});

// The same for each of the trials that lie on the field, with sizes, steps and headings of their
// own: one or more, from the south-west on (x + y). Where there is none, one result says why.
std::vector<PlotField> find_trials(std::span<const Eigen::Vector3f> points, double noise_m,
                                   const Hints& hints, int threads,
                                   const GroundError& ground_error = {});

}  // namespace plotscan::plots
