// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "planting/plots_description.h"

namespace plotscan {
class YamlSection;
}

namespace plotscan::description {

// The `plots` section of farm.yaml (docs/farm-format.md). Throws InputError as load_description
// does.
planting::PlotGridDescription read_plot_grid(const YamlSection& section);

}  // namespace plotscan::description
