// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cloud/cloud_map.h"

#include "core/plot_box.h"

namespace plotscan::cloud {

// The rectangle that holds the boxes when both ends of each are lengthened by extend_m.
Area surroundings(std::vector<PlotBox> boxes, double extend_m);

}  // namespace plotscan::cloud
