// SPDX-License-Identifier: Apache-2.0
#include "lidar/canopy_height.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "core/statistics.h"
#include "lidar/scene.h"

namespace plotscan::lidar {
namespace {

// Rays start so far above everything.
constexpr float kAbove_m = 1;

// Rays over a plot's box, line by line; each line runs along its width.
struct RayGrid {
  const PlotBox& box;
  std::size_t lines = 1;
  std::size_t rays_a_line = 1;

  RayGrid(const PlotBox& plot_box, double step_m)
      : box(plot_box),
        lines(cells(plot_box.length_m, step_m)),
        rays_a_line(cells(plot_box.width_m, step_m)),
        length_axis_(plot_box.length_axis()),
        width_axis_(plot_box.width_axis()) {}

  Eigen::Vector2d place(std::size_t line, std::size_t ray) const {
    return box.center + middle(line, lines) * box.length_m * length_axis_ +
           middle(ray, rays_a_line) * box.width_m * width_axis_;
  }

 private:
  static std::size_t cells(double side_m, double step_m) {
    constexpr double kRounding =
        1e-9;  // 1.5 m are 150 steps of 0.01 m, whatever doubles make of it
    return std::max<std::size_t>(
        1, static_cast<std::size_t>(std::ceil(side_m / step_m * (1 - kRounding))));
  }
  // Of a cell, as a share of the side, from its middle.
  static double middle(std::size_t cell, std::size_t count) {
    return (static_cast<double>(cell) + 0.5) / static_cast<double>(count) - 0.5;
  }

  Eigen::Vector2d length_axis_, width_axis_;
};

double step_of(const farm::Farm& farm) {
  double area_m2 = 0;
  for (const farm::Plot& plot : farm.plots) area_m2 += plot.box.area_m2();
  return std::max(kCanopyStep_m, std::sqrt(area_m2 / kMostCanopyRays));
}

// Of a hit over its place; NaN beside the terrain.
double height_of(const Scene& scene, const terrain::Terrain& terrain, const Hit& hit, double top_m,
                 const Eigen::Vector2d& place) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  if (!std::isfinite(hit.range_m)) return kNone;
  if (scene.surface(hit).label == scan::PointClass::ground) return 0;
  const std::optional<double> ground_m = terrain.height(place.x(), place.y());
  return ground_m ? std::max(0.0, top_m - static_cast<double>(hit.range_m) - *ground_m) : kNone;
}

// Heights of what a line's rays hit.
void measure_line(const Scene& scene, const terrain::Terrain& terrain, const RayGrid& grid,
                  std::size_t line, double* heights_m) {
  const float top_m = scene.top_m() + kAbove_m;
  std::vector<Ray> rays;
  rays.reserve(grid.rays_a_line);
  for (std::size_t i = 0; i < grid.rays_a_line; ++i) {
    const Eigen::Vector2f place = grid.place(line, i).cast<float>();
    rays.push_back({.origin_m = {place.x(), place.y(), top_m}, .direction = {0, 0, -1}});
  }
  std::vector<Hit> hits(rays.size());
  scene.cast_bundles(rays, rays.size(), top_m - scene.bottom_m() + kAbove_m, hits);
  for (std::size_t i = 0; i < rays.size(); ++i)
    heights_m[i] =
        height_of(scene, terrain, hits[i], static_cast<double>(top_m), grid.place(line, i));
}

farm::CanopyHeights canopy_of(const Scene& scene, const terrain::Terrain& terrain,
                              const PlotBox& box, double step_m) {
  const RayGrid grid(box, step_m);
  std::vector<double> heights_m(grid.lines * grid.rays_a_line);
  tbb::parallel_for(std::size_t{0}, grid.lines, [&](std::size_t line) {
    measure_line(scene, terrain, grid, line, heights_m.data() + line * grid.rays_a_line);
  });
  std::erase_if(heights_m, [](double height_m) { return std::isnan(height_m); });
  if (heights_m.empty()) return {};
  const double p95 = quantile(heights_m, 0.95);
  return {.p95 = p95, .p99 = quantile(std::move(heights_m), 0.99)};
}

}  // namespace

void measure_canopies(farm::Farm& farm, int threads) {
  if (farm.plots.empty()) return;
  const Scene scene(scene_content(farm));
  const double step_m = step_of(farm);
  tbb::task_arena arena(std::min(threads, tbb::info::default_concurrency()));
  arena.execute([&] {
    for (farm::Plot& plot : farm.plots)
      plot.canopy = canopy_of(scene, farm.terrain, plot.box, step_m);
  });
}

}  // namespace plotscan::lidar
