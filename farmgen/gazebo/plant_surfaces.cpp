// SPDX-License-Identifier: Apache-2.0
#include "gazebo/plant_surfaces.h"

#include <algorithm>
#include <map>
#include <utility>

#include "mesh/obj.h"

namespace plotscan::gazebo {
namespace {

std::size_t index_of(std::vector<mesh::Material>& materials, const mesh::Material& wanted) {
  const auto found = std::find(materials.begin(), materials.end(), wanted);
  const auto index = static_cast<std::size_t>(found - materials.begin());
  if (found == materials.end()) materials.push_back(wanted);
  return index;
}

// The vertex' normals: those of its triangles, weighted by their areas.
void add_normals(Surface& surface) {
  std::vector<Eigen::Vector3d> sums(surface.vertices.size(), Eigen::Vector3d::Zero());
  for (const auto& [a, b, c] : surface.triangles) {
    const Eigen::Vector3d corner = surface.vertices[a].cast<double>();
    const Eigen::Vector3d twice_area = (surface.vertices[b].cast<double>() - corner)
                                           .cross(surface.vertices[c].cast<double>() - corner);
    for (const std::uint32_t vertex : {a, b, c}) sums[vertex] += twice_area;
  }
  for (const Eigen::Vector3d& sum : sums) {
    const double length = sum.norm();
    surface.normals.emplace_back(length > 0 ? Eigen::Vector3f((sum / length).cast<float>())
                                            : Eigen::Vector3f::UnitZ());
  }
}

// Whether every edge is passed once in each direction. Vertices at one place count as one, since
// a texture's seam parts them.
bool is_closed(const Surface& surface) {
  std::map<std::array<float, 3>, std::uint32_t> places;
  std::vector<std::uint32_t> place;
  for (const Eigen::Vector3f& v : surface.vertices) {
    const auto next = static_cast<std::uint32_t>(places.size());
    place.push_back(places.try_emplace({v.x(), v.y(), v.z()}, next).first->second);
  }
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> balance;
  for (const auto& triangle : surface.triangles) {
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t from = place[triangle[i]];
      const std::uint32_t to = place[triangle[(i + 1) % 3]];
      if (from < to) ++balance[{from, to}];
      if (to < from) --balance[{to, from}];
    }
  }
  return std::all_of(balance.begin(), balance.end(),
                     [](const auto& edge) { return edge.second == 0; });
}

Surface surface_of(const mesh::Mesh& mesh, std::uint16_t material, bool textured) {
  mesh::Mesh part{.vertices = mesh.vertices, .triangles = {}};
  if (textured) part.texture_coordinates = mesh.texture_coordinates;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    if (mesh.material_of(i) == material) part.triangles.push_back(mesh.triangles[i]);
  part = mesh::compact(part);
  return {.vertices = std::move(part.vertices),
          .normals = {},
          .texture_coordinates = std::move(part.texture_coordinates),
          .triangles = std::move(part.triangles)};
}

}  // namespace

std::vector<Surface> surfaces_of(const mesh::Mesh& mesh, std::vector<mesh::Material>& materials) {
  std::vector<mesh::Material> own = mesh.materials;
  if (own.empty()) own.emplace_back();
  std::vector<Surface> surfaces;
  for (std::size_t material = 0; material < own.size(); ++material) {
    const bool textured =
        (own[material].texture || own[material].mask) && !mesh.texture_coordinates.empty();
    Surface surface = surface_of(mesh, static_cast<std::uint16_t>(material), textured);
    if (surface.triangles.empty()) continue;
    surface.material = index_of(materials, own[material]);
    surface.closed = is_closed(surface);
    add_normals(surface);
    surfaces.push_back(std::move(surface));
  }
  return surfaces;
}

PlantSurfaces plant_surfaces(const farm::Farm& farm, Detail lod) {
  PlantSurfaces surfaces;
  for (const farm::PlantModel& model : farm.models) {
    const mesh::Mesh shown = lod == Detail::scan ? model.mesh
                             : model.light       ? *model.light
                                                 : mesh::simplified(model.mesh, kLightTriangles);
    surfaces.models.push_back(surfaces_of(shown, surfaces.materials));
  }
  surfaces.names = mesh::distinct_names(surfaces.materials, "plant", "-");
  return surfaces;
}

}  // namespace plotscan::gazebo
