// SPDX-License-Identifier: Apache-2.0
#include <utility>

#include "core/error.h"
#include "terrain/internal/base_terrains.h"
#include "terrain/internal/grey_image.h"
#include "terrain/internal/refine.h"

namespace plotscan::terrain {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

std::vector<Triangle> grid_triangles(std::size_t rows, std::size_t columns) {
  std::vector<Triangle> triangles;
  triangles.reserve(2 * (rows - 1) * (columns - 1));
  for (std::size_t row = 0; row + 1 < rows; ++row) {
    for (std::size_t column = 0; column + 1 < columns; ++column) {
      const auto north_west = static_cast<std::uint32_t>(row * columns + column);
      const auto south_west = static_cast<std::uint32_t>(north_west + columns);
      triangles.push_back({south_west, south_west + 1, north_west + 1});
      triangles.push_back({south_west, north_west + 1, north_west});
    }
  }
  return triangles;
}

}  // namespace

Terrain heightmap_terrain(const HeightmapDescription& description) {
  const GreyImage image = read_grey_png(description.image, kMostTerrainVertices);
  if (image.width < 2 || image.height < 2)
    throw InputError(description.image, "has fewer than 2 x 2 pixels");
  const auto columns = static_cast<double>(image.width - 1);
  const auto rows = static_cast<double>(image.height - 1);
  const double size_x_m = description.size_x_m;
  const double size_y_m = description.size_y_m.value_or(size_x_m * rows / columns);
  const double rise_m = description.white_m - description.black_m;
  std::vector<Eigen::Vector3d> vertices;
  vertices.reserve(image.pixels.size());
  for (std::size_t row = 0; row < image.height; ++row) {
    for (std::size_t column = 0; column < image.width; ++column) {
      vertices.emplace_back((static_cast<double>(column) / columns - 0.5) * size_x_m,
                            (0.5 - static_cast<double>(row) / rows) * size_y_m,
                            description.black_m + rise_m * image.at(row, column) / image.white);
    }
  }
  return {std::move(vertices), grid_triangles(image.height, image.width)};
}

}  // namespace plotscan::terrain
