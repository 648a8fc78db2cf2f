// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <Eigen/Geometry>

#include "view/internal/page.h"

namespace plotscan::view {

// The colour at a share of the way from one to the other.
Rgb mixed(const Rgb& from, const Rgb& to, double share);

// Heights as colours from light to dark, in an order that colour-blind readers see too: Brewer's
// YlGn of nine (C. A. Brewer, colorbrewer2.org; values as in d3-scale-chromatic's YlGn).
struct HeightColours {
  double top_m = 1;  // this and above have the darkest

  Rgb of(double height_m) const;
};

// An upright bar of the colours with marks in metres at its right, and a title along it.
void draw_colour_bar(Page& page, const HeightColours& colours, const Eigen::AlignedBox2d& bar_px,
                     const std::string& title, double text_px);

}  // namespace plotscan::view
