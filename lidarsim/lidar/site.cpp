// SPDX-License-Identifier: Apache-2.0
#include "lidar/site.h"

#include <algorithm>
#include <cmath>

#include "core/list_of.h"
#include "core/statistics.h"
#include "lidar/scene.h"

namespace plotscan::lidar {
namespace {

std::optional<double> mean_of_any(const std::vector<double>& values) {
  return values.empty() ? std::nullopt : std::optional(mean(values));
}

std::optional<double> mean_ground(const farm::Farm& farm) {
  std::vector<double> heights_m;
  const auto add = [&](const Eigen::Vector2d& place) {
    if (const auto height = farm.terrain.height(place.x(), place.y())) heights_m.push_back(*height);
  };
  for (const farm::Plot& plot : farm.plots) {
    add(plot.box.center);
    for (const Eigen::Vector2d& corner : plot.box.corners()) add(corner);
  }
  return mean_of_any(heights_m);
}

bool is_plant(const PlacedMesh& placed) {
  const scan::PointClass label = placed.surface.label;
  return label == scan::PointClass::crop || label == scan::PointClass::weed;
}

// Indices of the content's placed meshes, in groups.
struct Groups {
  std::vector<std::size_t> plants;
  std::vector<std::size_t> ground;
  std::vector<std::size_t> others;
};

// World bounds of every placed mesh.
std::vector<Eigen::AlignedBox3d> bounds_of(const SceneContent& content) {
  std::vector<Eigen::AlignedBox3d> mesh_bounds(content.meshes.size());
  for (std::size_t i = 0; i < content.meshes.size(); ++i) {
    for (const Eigen::Vector3f& vertex : content.meshes[i].vertices)
      mesh_bounds[i].extend(vertex.cast<double>());
  }
  return list_of(content.placed, [&](const PlacedMesh& placed) {
    return mesh_bounds[placed.mesh].transformed(placed.world_from_mesh);
  });
}

double horizontal_area(const Eigen::AlignedBox3d& box) { return box.sizes().head<2>().prod(); }

Groups groups_of(const SceneContent& content, const std::vector<Eigen::AlignedBox3d>& bounds) {
  Groups groups;
  for (std::size_t i = 0; i < content.placed.size(); ++i) {
    const bool ground = content.placed[i].surface.label == scan::PointClass::ground;
    (is_plant(content.placed[i]) ? groups.plants
     : ground                    ? groups.ground
                                 : groups.others)
        .push_back(i);
  }
  if (groups.ground.empty() && !groups.others.empty()) {
    const auto largest = std::max_element(
        groups.others.begin(), groups.others.end(), [&](std::size_t a, std::size_t b) {
          return horizontal_area(bounds[a]) < horizontal_area(bounds[b]);
        });
    groups.ground.push_back(*largest);
    groups.others.erase(largest);
  }
  return groups;
}

SceneContent only(const SceneContent& content, const std::vector<std::size_t>& kept) {
  SceneContent part{.meshes = content.meshes, .placed = {}};
  for (const std::size_t i : kept) part.placed.push_back(content.placed[i]);
  return part;
}

// The mean height where a grid of rays, cast down over the area, hits the ground; absent if none
// does.
std::optional<double> mean_height(const SceneContent& ground, const Eigen::AlignedBox3d& area) {
  constexpr int kGrid = 9;
  const Scene scene(ground);
  std::vector<Ray> rays;
  const Eigen::Vector3d step = area.sizes() / (kGrid - 1);
  const float top = scene.top_m() + 1;
  for (int i = 0; i < kGrid * kGrid; ++i) {
    const int row = i / kGrid, column = i % kGrid;
    const double x = area.min().x() + column * step.x();
    const double y = area.min().y() + row * step.y();
    rays.push_back({{static_cast<float>(x), static_cast<float>(y), top}, {0, 0, -1}});
  }
  std::vector<Hit> hits(rays.size());
  scene.cast(rays, top - scene.bottom_m() + 1, hits);
  std::vector<double> heights_m;
  for (const Hit& hit : hits) {
    if (std::isfinite(hit.range_m))
      heights_m.push_back(static_cast<double>(top) - static_cast<double>(hit.range_m));
  }
  return mean_of_any(heights_m);
}

}  // namespace

Site site_of(const farm::Farm& farm) {
  Site site{.kind = "farm",
            .name = farm.name,
            .areas = {},
            .ground_m = mean_ground(farm),
            .anchor = farm.anchor};
  for (const farm::Plot& plot : farm.plots) site.areas.push_back(plot.box);
  return site;
}

Site site_of(const std::string& world_name, const SceneContent& content) {
  Site site{.kind = "world", .name = world_name, .areas = {}, .ground_m = {}};
  const std::vector<Eigen::AlignedBox3d> bounds = bounds_of(content);
  const Groups groups = groups_of(content, bounds);
  const std::vector<std::size_t>& covered = !groups.plants.empty()   ? groups.plants
                                            : !groups.others.empty() ? groups.others
                                                                     : groups.ground;
  if (covered.empty()) return site;
  Eigen::AlignedBox3d area;
  for (const std::size_t i : covered) area.extend(bounds[i]);
  site.areas.push_back({.center = area.center().head<2>(),
                        .width_m = area.sizes().y(),
                        .length_m = area.sizes().x(),
                        .heading_rad = 0});
  site.ground_m = area.min().z();
  if (!groups.ground.empty())
    site.ground_m = mean_height(only(content, groups.ground), area).value_or(area.min().z());
  return site;
}

}  // namespace plotscan::lidar
