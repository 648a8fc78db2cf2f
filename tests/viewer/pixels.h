// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <filesystem>
#include <functional>

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>

namespace plotscan::view {

using Colour = std::array<int, 3>;  // red, green, blue, 0 to 255

// Calls `see` with each pixel of the PNG: x from the left, y from the lower edge.
inline void for_pixels(const std::filesystem::path& png,
                       const std::function<void(int, int, const Colour&)>& see) {
  vtkNew<vtkPNGReader> reader;
  reader->SetFileName(png.c_str());
  reader->Update();
  vtkImageData& image = *reader->GetOutput();
  const int* size = image.GetDimensions();
  for (int y = 0; y < size[1]; ++y) {
    for (int x = 0; x < size[0]; ++x) {
      Colour colour{};
      for (int c = 0; c < 3; ++c)
        colour[c] = static_cast<int>(image.GetScalarComponentAsDouble(x, y, 0, c));
      see(x, y, colour);
    }
  }
}

// Pixels whose colour `wanted` holds, in the part [from, to) of the picture's width.
inline int count_pixels(const std::filesystem::path& png, double from, double to,
                        const std::function<bool(Colour)>& wanted) {
  int width = 0;
  for_pixels(png, [&](int x, int, const Colour&) { width = std::max(width, x + 1); });
  int count = 0;
  for_pixels(png, [&](int x, int, const Colour& colour) {
    const bool inside = x >= static_cast<int>(from * width) && x < static_cast<int>(to * width);
    count += inside && wanted(colour);
  });
  return count;
}

inline bool red(const Colour& c) { return c[0] > 150 && c[1] < 90 && c[2] < 90; }
inline bool green(const Colour& c) { return c[1] > c[0] + 25 && c[1] > c[2] + 25; }
inline bool blue(const Colour& c) { return c[2] > c[0] + 50 && c[2] > c[1] + 50; }

}  // namespace plotscan::view
