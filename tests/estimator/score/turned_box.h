// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/plot_box.h"

namespace plotscan::score {

inline PlotBox turned_box(double x, double heading_rad = 0) {
  return {.center = {x, 0}, .width_m = 1, .length_m = 4, .heading_rad = heading_rad};
}

}  // namespace plotscan::score
