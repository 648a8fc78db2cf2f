// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include <Eigen/Geometry>

#include "farm/farm.h"
#include "view/internal/height_colours.h"

class vtkRenderer;

namespace plotscan::view {

// The part of the farm that is shown: the rectangle around its plots (around its terrain, when it
// has none), with the heights of what stands there.
using Field = Eigen::AlignedBox3d;

Field field_of(const farm::Farm& farm, double margin_m);

// The terrain's triangles within the field, shaded.
void add_terrain(vtkRenderer& renderer, const terrain::Terrain& terrain, const Field& field);

// Every plant as an instance of its mesh, in its materials' colours and textures; weeds are
// reddish.
void add_plants(vtkRenderer& renderer, const farm::Farm& farm);

// How a cloud is drawn.
struct CloudLook {
  std::size_t most_points = 0;  // evenly thinned beyond
  float point_px = 1;           // of the window
};

// The cloud's points within the field, coloured by height over the terrain. Returns the colours.
HeightColours add_cloud(vtkRenderer& renderer, const std::filesystem::path& cloud,
                        const terrain::Terrain& terrain, const Field& field, const CloudLook& look);

}  // namespace plotscan::view
