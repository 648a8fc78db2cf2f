// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "estimate/diagnostics.h"
#include "plots/plot_field.h"

namespace plotscan::methods::lattice {

// A field's entry in the manifest: its layout, and the signs that its plots are really plots
// (docs/estimate-format.md).
nlohmann::json json_of(const plots::PlotField& field);
// The same for people; none where there are no plots.
std::vector<std::string> lines_of(const plots::PlotField& field);

// Adds both to the diagnostics: the field's, or those of each of its trials.
void report_trials(std::span<const plots::PlotField> trials, estimate::Diagnostics& diagnostics);

}  // namespace plotscan::methods::lattice
