// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace plotscan::crop {

// A picture of shades, before they have colours.
struct Raster {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> shades;  // rows from the upper edge, each from the left
};

// The colour of each shade: red, green, blue in [0, 1].
using Palette = std::array<Eigen::Vector3f, 256>;

// The bytes of a PNG file of 8-bit red, green and blue: Gazebo's image loader takes the indices of
// a palette for greys. Without a time stamp, so that the same picture gives the same bytes.
std::string png_of(const Raster& raster, const Palette& palette);

}  // namespace plotscan::crop
