// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "planting/model_description.h"

namespace plotscan::planting {

enum class WeedPlace {
  everywhere,  // in the field: the rectangle about all plots, and its margin
  alleys,      // in the field, but outside every plot
  plots,
};

// The `weeds` section of farm.yaml (docs/farm-format.md).
struct WeedsDescription {
  double per_m2 = 0;  // of the ground that `where` names
  WeedPlace where = WeedPlace::everywhere;
  double margin_m = 1;                     // of the field about the plots
  std::vector<std::uint32_t> models = {};  // places in FarmDescription::models
  double min_scale = 1;                    // each axis' scale is uniform in [min, max]
  double max_scale = 1;
};

}  // namespace plotscan::planting
