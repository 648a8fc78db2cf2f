// SPDX-License-Identifier: Apache-2.0
#include "crop/internal/png.h"

#include <algorithm>
#include <cmath>

#include <png.h>

#include "core/error.h"

namespace plotscan::crop {

std::string png_of(const Raster& raster, const Palette& palette) {
  check(raster.shades.size() ==
            static_cast<std::size_t>(raster.width) * static_cast<std::size_t>(raster.height),
        "a raster's size");
  std::vector<std::uint8_t> pixels;
  for (const std::uint8_t shade : raster.shades)
    for (const float share : palette[shade])
      pixels.push_back(static_cast<std::uint8_t>(std::lround(255 * std::clamp(share, 0.0F, 1.0F))));
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(raster.width);
  image.height = static_cast<png_uint_32>(raster.height);
  image.format = PNG_FORMAT_RGB;
  png_alloc_size_t size = 0;
  const auto write = [&](void* memory) {
    return png_image_write_to_memory(&image, memory, &size, 0, pixels.data(), 0, nullptr) != 0;
  };
  check(write(nullptr), "the size of a PNG");
  std::string bytes(size, '\0');
  check(write(bytes.data()), "a PNG in memory");
  return bytes;
}

}  // namespace plotscan::crop
