// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include <Eigen/Geometry>

#include "core/plot_box.h"
#include "farm/farm.h"

class vtkRenderer;

namespace plotscan::view {

// The part of the farm that is shown: the rectangle around its plots (around its terrain, when it
// has none), with the heights of what stands there.
using Field = Eigen::AlignedBox3d;

Field field_of(const farm::Farm& farm, double margin_m);

// The terrain's triangles within the field, shaded.
void add_terrain(vtkRenderer& renderer, const farm::Terrain& terrain, const Field& field);

// Every plant as an instance of its mesh, in its materials' colours and textures; weeds are
// reddish.
void add_plants(vtkRenderer& renderer, const farm::Farm& farm);

// The cloud's points within the field, coloured by height over the terrain, with a colour bar.
void add_cloud(vtkRenderer& renderer, const std::filesystem::path& cloud,
               const farm::Terrain& terrain, const Field& field, std::size_t max_points);

// Outlines of the boxes, floating just over the terrain's highest point in each.
void add_boxes(vtkRenderer& renderer, const std::vector<PlotBox>& boxes,
               const farm::Terrain& terrain);

}  // namespace plotscan::view
