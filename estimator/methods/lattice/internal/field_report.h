// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "plots/plot_field.h"

namespace plotscan::methods::lattice {

// A field's entry in the manifest: its layout, and the signs that its plots are really plots
// (docs/estimate-format.md).
nlohmann::json json_of(const plots::PlotField& field);
// The same for people; none where there are no plots.
std::vector<std::string> lines_of(const plots::PlotField& field);

}  // namespace plotscan::methods::lattice
