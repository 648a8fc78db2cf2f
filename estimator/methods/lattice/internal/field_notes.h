// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "cloud/field_cloud.h"
#include "estimate/diagnostics.h"
#include "estimate/estimate.h"
#include "ground/surface.h"
#include "methods/lattice/lattice.h"
#include "plots/plot_field.h"

// What the method says to the user of a field: why it shows no plots, and notes on what was stated.
namespace plotscan::methods::lattice {

// "too few points to show plots: about 65 a square metre are needed".
std::string too_few(const std::string& for_what);

// Why a field in which plots were searched shows none; `by_plots` is the search's own reason.
std::string why_none(const std::string& by_plots, double density_m2, double noise_m,
                     const Options& options);

// The message for a cloud in which hardly any point has ground beneath it.
std::string no_ground_because(const cloud::FieldCloud& cloud, const estimate::PointAccount& points);

// Each adds a note to the diagnostics where there is something to say.

// The stated heading is that of the longer side, and both are searched.
void note_heading(const plots::PlotField& trial, const Options& options,
                  estimate::Diagnostics& diagnostics);
// Canopy is what stands higher than the noise: where that is said to be less than it is, bare
// ground looks like canopy.
void note_noise(const ground::Surface& surface, const Options& options,
                estimate::Diagnostics& diagnostics);
// The steps in which the cloud counts.
void note_steps(const cloud::FieldCloud& cloud, estimate::Diagnostics& diagnostics);
// The given boxes, of which canopy would fill more if all were moved.
void note_shift(std::span<const Eigen::Vector3f> heights,
                const std::vector<estimate::PlotEstimate>& given, double noise_m,
                estimate::Diagnostics& diagnostics);

}  // namespace plotscan::methods::lattice
