// SPDX-License-Identifier: Apache-2.0
#pragma once

// Private to the library: the view of a field in which its plots show best.

#include <memory>
#include <span>

#include <Eigen/Core>

#include "plots/canopy_raster.h"
#include "plots/heading.h"
#include "plots/layout.h"

namespace plotscan::plots {

// A raster and the best layout on it.
struct Sighting {
  std::unique_ptr<const CanopyRaster> raster;  // the layout's view points to it
  Layout layout;
  double sown_width_m = 0;  // along c, of plots whose drill rows show; else 0
};

// Looks at the cover above threshold_m along the axes. Drill rows that show are put together into
// plots. Where no clear layout of plots shows, looks
// again along perpendicular axes (rows with offsets of their own can tilt the second one), above
// higher thresholds (tall leaves lean over the alleys), and with gaps between plants or drill rows
// closed, wider and wider; of these, the first clear layout, else the clearest.
Sighting find_layout(std::span<const Eigen::Vector3f> points, const FieldAxes& axes,
                     double threshold_m, double cell_m, const KnownSides& known, int threads);

}  // namespace plotscan::plots
