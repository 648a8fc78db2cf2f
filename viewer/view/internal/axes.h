// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "view/internal/page.h"

namespace plotscan::view {

// A frame on a page, and what part of a plane it shows.
struct Axes {
  Eigen::AlignedBox2d shown;     // metres
  Eigen::AlignedBox2d frame_px;  // on the page

  Eigen::Vector2d px_per_m() const { return frame_px.sizes().cwiseQuotient(shown.sizes()); }
  Eigen::Vector2d at(const Eigen::Vector2d& place_m) const {
    return frame_px.min() + (place_m - shown.min()).cwiseProduct(px_per_m());
  }
};

// The frame with marks and titles left of it and below, in a text of that size. Large coordinates
// are counted from a round one, which the title names: "east (m, from 552000)".
void draw_axes(Page& page, const Axes& axes, const std::string& title_x, const std::string& title_y,
               double text_px);

// What a colour or a kind of line in the picture means.
struct LegendEntry {
  enum class Mark { line, area, dots };
  Mark mark = Mark::line;
  Rgb colour = {};
  double width_px = 2;
  double dash_px = 0;
  std::string meaning = {};
};

// Lines of entries from the top left corner down, broken at a width. Returns their height; without
// a page it only measures.
double draw_legend(Page* page, const Eigen::Vector2d& top_left, double width_px,
                   const std::vector<LegendEntry>& entries, double text_px);

}  // namespace plotscan::view
