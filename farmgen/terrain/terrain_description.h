// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>

#include "mesh/mesh_import.h"

namespace plotscan::terrain {

// The `terrain` section of farm.yaml (docs/farm-format.md): a base, and relief upon it.

// A grey image: its corner pixels' centres lie on the corners of the rectangle, its first row in
// the north.
struct HeightmapDescription {
  std::filesystem::path image;
  double size_x_m = 0;
  std::optional<double> size_y_m;  // else the pixels are square
  double black_m = 0;              // height of black
  double white_m = 0;              // height of white
};

struct XyzDescription {
  std::filesystem::path file;
  bool keep_coordinates = false;  // else the centre of their bounding box becomes the origin
};

struct SlopeDescription {
  double gradient = 0;       // metres up for a metre along the direction
  double direction_rad = 0;  // of the steepest ascent, counter-clockwise from east
};

struct RollingDescription {
  double rms_m = 0;  // standard deviation of the heights
  double shortest_m = 0;
  double longest_m = 0;  // wavelengths
};

enum class FurrowProfile { sine, trapezoid };

struct FurrowsDescription {
  double spacing_m = 0;    // from ridge to ridge
  double depth_m = 0;      // from a ridge's top to the furrow's bottom
  double heading_rad = 0;  // of the ridges, counter-clockwise from east
  double offset_m = 0;     // of a ridge's top from the origin, across the ridges
  FurrowProfile profile = FurrowProfile::sine;
};

struct ClodsDescription {
  double height_m = 0;  // standard deviation of the heights
  double size_m = 0;    // correlation length
};

struct TerrainDescription {
  // The base: one of these three files, else the random square.
  std::optional<std::filesystem::path> mesh;  // its z = 0 and origin are the world's
  mesh::MeshImportOptions mesh_options;
  std::optional<HeightmapDescription> heightmap;
  std::optional<XyzDescription> xyz;
  double side_m = 0;
  std::uint32_t vertices = 150;  // random ones, besides the four corners
  double relief_m = 0;           // z of each vertex is uniform in [-relief_m, relief_m]

  // What is added to the base's heights.
  std::optional<SlopeDescription> slope;
  std::optional<RollingDescription> rolling;
  std::optional<FurrowsDescription> furrows;
  std::optional<ClodsDescription> clods;
  std::optional<double> step_m;  // of the finest vertices; else as the relief needs
  // Extent along x and y, about the origin, of the rectangle with furrows and clods; else that of
  // the plots with a margin.
  std::optional<std::array<double, 2>> detail_m;
  std::optional<double> reflectance;  // diffuse, at 903 nm, in [0, 1]
};

}  // namespace plotscan::terrain
