// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace plotscan::terrain {

struct GreyImage {
  std::size_t width = 0;
  std::size_t height = 0;
  std::uint32_t white = 0;            // the greatest value a pixel can have
  std::vector<std::uint16_t> pixels;  // row by row from the top

  std::uint16_t at(std::size_t row, std::size_t column) const {
    return pixels[row * width + column];
  }
};

// Reads a grey PNG of 1 to 16 bits a pixel, its values as they are stored: no gamma, no alpha.
// Throws InputError on another file, a broken one, an image in colour, or one of more than
// `most_pixels`.
GreyImage read_grey_png(const std::filesystem::path& path, std::size_t most_pixels);

}  // namespace plotscan::terrain
