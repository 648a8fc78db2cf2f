// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/range.h"
#include "mesh/mesh.h"

namespace plotscan::view {

// What a picture of plants side by side shows. They are seen in parallel projection, all at one
// scale.
struct PlantPictureOptions {
  static constexpr Range kWidth_px{64, 8192}, kHeight_px = kWidth_px;
  static constexpr Range kAzimuth_deg{-360, 360}, kElevation_deg{0, 90}, kColumns{0, 1000};

  int width_px = 1600;  // of the whole picture
  int height_px = 700;
  double azimuth_deg = -60;   // where the camera stands: counter-clockwise from east
  double elevation_deg = 10;  // of the camera over the horizon
  int columns = 0;            // plants in a row; 0: as many as makes them largest
};

// A plant with its name in the picture.
struct PicturedPlant {
  std::string label;
  mesh::Mesh mesh;  // the stem's foot at the origin
};

// Draws the plants in their order on common ground lines, each row with a scale of heights in
// metres, and writes a PNG. The scale counts heights over the foot of a stem; from above (more than
// 60 degrees) it counts metres of ground instead. Needs a display as draw_picture does. Throws
// InputError on no plants, options out of range, plants that do not fit, a texture that cannot be
// decoded, or a missing display; WriteError when the file cannot be written.
void draw_plants(const std::vector<PicturedPlant>& plants, const std::filesystem::path& png,
                 const PlantPictureOptions& options);

}  // namespace plotscan::view
