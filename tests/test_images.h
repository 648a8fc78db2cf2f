// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

#include <jpeglib.h>
#include <png.h>

namespace plotscan::testing {

// Of a pixel, in [0, 255]; column from the left, row from the top.
using Shade = std::function<int(int column, int row)>;

inline std::string png_file(int width, int height, png_uint_32 format,
                            const std::vector<png_byte>& pixels) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(width);
  image.height = static_cast<png_uint_32>(height);
  image.format = format;
  png_alloc_size_t size = 0;
  png_image_write_to_memory(&image, nullptr, &size, 0, pixels.data(), 0, nullptr);
  std::string bytes(size, '\0');
  png_image_write_to_memory(&image, bytes.data(), &size, 0, pixels.data(), 0, nullptr);
  bytes.resize(size);
  return bytes;
}

// A green PNG with that alpha.
inline std::string png_of_alpha(int width, int height, const Shade& alpha) {
  std::vector<png_byte> pixels;
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      for (const int part : {40, 120, 30, alpha(column, row)})
        pixels.push_back(static_cast<png_byte>(part));
    }
  }
  return png_file(width, height, PNG_FORMAT_RGBA, pixels);
}

inline std::string png_of_grey(int width, int height, const Shade& grey) {
  std::vector<png_byte> pixels;
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column)
      pixels.push_back(static_cast<png_byte>(grey(column, row)));
  }
  return png_file(width, height, PNG_FORMAT_GRAY, pixels);
}

inline std::string jpeg_of_grey(int width, int height, const Shade& grey) {
  jpeg_compress_struct jpeg{};
  jpeg_error_mgr errors{};
  jpeg.err = jpeg_std_error(&errors);
  jpeg_create_compress(&jpeg);
  unsigned char* memory = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&jpeg, &memory, &size);
  jpeg.image_width = static_cast<JDIMENSION>(width);
  jpeg.image_height = static_cast<JDIMENSION>(height);
  jpeg.input_components = 1;
  jpeg.in_color_space = JCS_GRAYSCALE;
  jpeg_set_defaults(&jpeg);
  jpeg_set_quality(&jpeg, 95, TRUE);
  jpeg_start_compress(&jpeg, TRUE);
  for (int row = 0; row < height; ++row) {
    std::vector<JSAMPLE> line;
    for (int column = 0; column < width; ++column)
      line.push_back(static_cast<JSAMPLE>(grey(column, row)));
    JSAMPROW place = line.data();
    jpeg_write_scanlines(&jpeg, &place, 1);
  }
  jpeg_finish_compress(&jpeg);
  std::string bytes(reinterpret_cast<const char*>(memory), size);
  jpeg_destroy_compress(&jpeg);
  std::free(memory);
  return bytes;
}

}  // namespace plotscan::testing
