// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <vtkSmartPointer.h>

#include "mesh/mesh.h"

class vtkActor;
class vtkPolyData;
class vtkTexture;

namespace plotscan::view {

// The triangles of a mesh that have one material.
struct Surface {
  vtkSmartPointer<vtkPolyData> triangles;
  mesh::Material material;
  vtkSmartPointer<vtkTexture> texture;  // null: the material has none
};

// One surface for each material that has triangles; triangles without a material, or with one that
// has neither name nor texture, are plain green. Throws InputError when a texture is neither a PNG
// nor a JPEG that can be decoded.
std::vector<Surface> surfaces_of(const mesh::Mesh& mesh);

// Gives the actor the surface's colour and texture, matt, so that both sides of a leaf show it.
void paint(vtkActor& actor, const Surface& surface);

}  // namespace plotscan::view
