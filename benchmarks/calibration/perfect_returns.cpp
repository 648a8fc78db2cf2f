// SPDX-License-Identifier: Apache-2.0
#include "calibration/perfect_returns.h"

#include <cmath>

#include "core/list_of.h"
#include "lidar/scene.h"

namespace plotscan::calibration {
namespace {

constexpr double kStep_m = 0.02;

std::vector<Eigen::Vector2d> grid_over(const PlotBox& box) {
  const auto along = static_cast<int>(std::round(box.length_m / kStep_m));
  const auto across = static_cast<int>(std::round(box.width_m / kStep_m));
  std::vector<Eigen::Vector2d> places;
  for (int i = 0; i < along; ++i) {
    for (int j = 0; j < across; ++j) {
      places.emplace_back(box.center +
                          (kStep_m * (i + 0.5) - 0.5 * box.length_m) * box.length_axis() +
                          (kStep_m * (j + 0.5) - 0.5 * box.width_m) * box.width_axis());
    }
  }
  return places;
}

std::vector<Eigen::Vector3f> returns_over(const farm::Farm& farm, const lidar::Scene& scene,
                                          const PlotBox& box) {
  const std::vector<Eigen::Vector2d> places = grid_over(box);
  const float start_m = scene.top_m() + 1;
  const std::vector<lidar::Ray> rays = list_of(places, [&](const Eigen::Vector2d& place) {
    return lidar::Ray{
        .origin_m = {static_cast<float>(place.x()), static_cast<float>(place.y()), start_m},
        .direction = -Eigen::Vector3f::UnitZ()};
  });
  std::vector<lidar::Hit> hits(rays.size());
  scene.cast(rays, start_m - scene.bottom_m() + 1, hits);
  std::vector<Eigen::Vector3f> returns;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const auto ground_m = farm.terrain.height(places[i].x(), places[i].y());
    if (!ground_m || !std::isfinite(hits[i].range_m)) continue;
    returns.emplace_back(rays[i].origin_m.x(), rays[i].origin_m.y(),
                         static_cast<float>(start_m - hits[i].range_m - *ground_m));
  }
  return returns;
}

}  // namespace

std::vector<std::vector<Eigen::Vector3f>> perfect_returns(const farm::Farm& farm) {
  const lidar::Scene scene(lidar::scene_content(farm));
  return list_of(farm.plots,
                 [&](const farm::Plot& plot) { return returns_over(farm, scene, plot.box); });
}

}  // namespace plotscan::calibration
