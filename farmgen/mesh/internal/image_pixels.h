// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace plotscan::mesh {

// One value a pixel in [0, 255], row by row from the top.
struct Coverage {
  std::size_t width = 0;
  std::size_t height = 0;
  std::vector<std::uint8_t> values;
};

// The alpha of a PNG, or its brightness where it has none; the brightness of a JPEG. Throws
// InputError, naming the image as `file`, when it is neither, is broken or has more than
// `most_pixels`.
Coverage decode_coverage(const std::string& bytes, std::size_t most_pixels,
                         const std::filesystem::path& file);

// Whether a PNG has an alpha channel or a transparent colour; false for what is no PNG.
bool png_has_alpha(const std::string& bytes);

}  // namespace plotscan::mesh
