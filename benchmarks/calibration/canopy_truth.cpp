// SPDX-License-Identifier: Apache-2.0
#include "calibration/canopy_truth.h"

#include <cmath>

#include "core/statistics.h"
#include "lidar/scene.h"

namespace plotscan::calibration {
namespace {

constexpr double kStep_m = 0.01;

struct Place {
  Eigen::Vector2d at;
  bool kept;  // in CanopyTruth::points
};

std::vector<Place> grid_over(const PlotBox& box) {
  const auto along = static_cast<int>(std::round(box.length_m / kStep_m));
  const auto across = static_cast<int>(std::round(box.width_m / kStep_m));
  std::vector<Place> places;
  for (int i = 0; i < along; ++i) {
    for (int j = 0; j < across; ++j) {
      places.push_back({.at = box.center +
                              (kStep_m * (i + 0.5) - 0.5 * box.length_m) * box.length_axis() +
                              (kStep_m * (j + 0.5) - 0.5 * box.width_m) * box.width_axis(),
                        .kept = i % 2 == 0 && j % 2 == 0});
    }
  }
  return places;
}

CanopyTruth canopy_truth(const farm::Farm& farm, const lidar::Scene& scene, const PlotBox& box) {
  const std::vector<Place> places = grid_over(box);
  const float start_m = scene.top_m() + 1;
  std::vector<lidar::Ray> rays;
  rays.reserve(places.size());
  for (const Place& place : places) {
    rays.push_back(
        {.origin_m = {static_cast<float>(place.at.x()), static_cast<float>(place.at.y()), start_m},
         .direction = -Eigen::Vector3f::UnitZ()});
  }
  std::vector<lidar::Hit> hits(rays.size());
  scene.cast(rays, start_m - scene.bottom_m() + 1, hits);
  std::vector<double> heights;
  CanopyTruth truth;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const auto ground_m = farm.terrain.height(places[i].at.x(), places[i].at.y());
    if (!ground_m || !std::isfinite(hits[i].range_m)) continue;
    heights.push_back(start_m - hits[i].range_m - *ground_m);
    if (places[i].kept)
      truth.points.emplace_back(rays[i].origin_m.x(), rays[i].origin_m.y(),
                                static_cast<float>(heights.back()));
  }
  truth.heights_m = {{"canopy_p95", quantile(heights, 0.95)},
                     {"canopy_p99", quantile(heights, 0.99)}};
  return truth;
}

}  // namespace

std::vector<CanopyTruth> canopy_truths(const farm::Farm& farm) {
  const lidar::Scene scene(lidar::scene_content(farm));
  std::vector<CanopyTruth> truths;
  for (const farm::Plot& plot : farm.plots) truths.push_back(canopy_truth(farm, scene, plot.box));
  return truths;
}

}  // namespace plotscan::calibration
