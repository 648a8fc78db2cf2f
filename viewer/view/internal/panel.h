// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "view/internal/page.h"

class vtkRenderer;

namespace plotscan::view {

// Pixels drawn each way for one of a panel.
inline constexpr int kPanelSamples = 3;

// The renderer's view, anti-aliased. With shade_m above 0, corners and gaps between things at most
// shade_m apart are darker, as under a cloudy sky (screen-space ambient occlusion). Needs a
// Display.
Raster drawn_panel(vtkRenderer& renderer, const Eigen::Vector2i& size_px, double shade_m);

}  // namespace plotscan::view
