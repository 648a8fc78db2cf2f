// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/plot_box.h"

namespace plotscan::view {

// A text to be placed in a box on the page.
struct BoxLabel {
  std::string text;
  PlotBox box_px;          // pixels in place of metres
  bool important = false;  // comes before others where there is no room for all
};

struct PlacedLabel {
  std::size_t index = 0;  // of its BoxLabel
  double size_px = 0;
  double turn_rad = 0;
  std::vector<Eigen::Vector2d> corners = {};  // of its background
};

// Labels in the middle of their boxes, all of one size and direction: level if they are large
// enough so, else along the boxes' longer side. Where even the smallest legible text is larger than
// the boxes, it may cross their sides, and labels that would touch another are left out.
std::vector<PlacedLabel> place_labels(const std::vector<BoxLabel>& labels, double largest_px);

}  // namespace plotscan::view
