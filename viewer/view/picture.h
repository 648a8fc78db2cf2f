// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "core/plot_box.h"
#include "core/range.h"
#include "farm/farm.h"

namespace plotscan::view {

// What a picture of a farm shows. Every panel is seen from the same camera.
struct PictureOptions {
  static constexpr Range kWidth_px{256, 16384}, kHeight_px{64, 16384};
  static constexpr Range kAzimuth_deg{-360, 360}, kElevation_deg{5, 90}, kMargin_m{0, 1e4};

  int width_px = 1600;  // of the whole picture
  int height_px = 560;  // at most: it is lower where the field leaves room
  double azimuth_deg =
      -60;  // where the camera stands: counter-clockwise from east, seen from the field's centre
  double elevation_deg = 35;           // of the camera over the horizon
  double margin_m = 1.5;               // shown around the plots
  std::size_t max_points = 3'000'000;  // of the cloud; evenly thinned beyond
};

// Draws the farm (terrain and plants) and, beside it, the cloud coloured by height over the terrain
// with the boxes on it, and writes a PNG. `cloud` is a PCD or PLY; without it only the farm is
// drawn. Rendered by VTK into an off-screen window, for which Debian's VTK needs an X display
// (xvfb-run serves). Throws InputError on options out of range, a broken cloud or a missing
// display; WriteError when the file cannot be written.
void draw_picture(const farm::Farm& farm, const std::optional<std::filesystem::path>& cloud,
                  const std::vector<PlotBox>& boxes, const std::filesystem::path& png,
                  const PictureOptions& options);

}  // namespace plotscan::view
