// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <Eigen/Core>

#include "mesh/mesh.h"

// SDF's geometric primitives as triangles. Round ones have their vertices on the true surface and
// 360 of them around the axis: their triangles lie at most 8e-5 radii below it.
namespace plotscan::gazebo {

// Centred on the origin, sides of 1 m.
mesh::Mesh unit_box();
// In the plane z = 0, centred on the origin, sides of 1 m.
mesh::Mesh unit_plane();
// Centred on the origin, radius 1 m.
mesh::Mesh unit_sphere();
// Along z, centred on the origin, radius and length 1 m, both ends closed.
mesh::Mesh unit_cylinder();
// Along z, centred on the origin: a cylinder of the length with a half ball on either end.
mesh::Mesh capsule(double radius_m, double length_m);
// The area within the loops (inside an odd number of them; each closes on itself), extruded from
// z = 0 to the height, both ends closed. Throws InputError when no area is inside.
mesh::Mesh extruded(const std::vector<std::vector<Eigen::Vector2d>>& loops, double height_m);
// Moves the centre of the mesh's bounding box to the origin.
void put_centre_at_origin(mesh::Mesh& mesh);

}  // namespace plotscan::gazebo
