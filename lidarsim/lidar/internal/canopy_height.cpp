// SPDX-License-Identifier: Apache-2.0
#include "lidar/internal/canopy_height.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <tbb/info.h>
#include <tbb/parallel_for.h>

#include "core/each_index.h"
#include "core/stage.h"
#include "core/statistics.h"
#include "lidar/internal/canopy_ceiling.h"
#include "lidar/internal/ray_grid.h"
#include "lidar/scene.h"

namespace plotscan::lidar {
namespace {

// How far above the top of the scene rays start.
constexpr float kAbove_m = 1;
// The lower of the two percentiles that are wanted.
constexpr double kLowestShare = 0.95;

double step_of(const farm::Farm& farm) {
  double area_m2 = 0;
  for (const farm::Plot& plot : farm.plots) area_m2 += plot.box.area_m2();
  return std::max(kCanopyStep_m, std::sqrt(area_m2 / kMostCanopyRays));
}

// The height of a hit above the terrain at `place`; NaN beside the terrain.
double height_of(const Scene& scene, const terrain::Terrain& terrain, const Hit& hit, double top_m,
                 const Eigen::Vector2d& place) {
  if (!std::isfinite(hit.range_m)) return kNaN;
  if (scene.surface(hit).label == scan::PointClass::ground) return 0;
  const std::optional<double> ground_m = terrain.height(place.x(), place.y());
  return ground_m ? std::max(0.0, top_m - static_cast<double>(hit.range_m) - *ground_m) : kNaN;
}

// Casts rays of a grid straight down, in bundles of one task each.
class Caster {
 public:
  Caster(const Scene& scene, const terrain::Terrain& terrain, const RayGrid& grid)
      : scene_(scene), terrain_(terrain), grid_(grid) {}

  // Sets the heights of what the rays hit, each at the ray's own place.
  void measure(std::span<const std::uint32_t> rays, std::vector<double>& heights_m) const {
    constexpr std::size_t kTogether = 512;
    tbb::parallel_for(
        std::size_t{0}, (rays.size() + kTogether - 1) / kTogether, [&](std::size_t i) {
          const std::size_t begin = i * kTogether;
          measure_together(rays.subspan(begin, std::min(kTogether, rays.size() - begin)),
                           heights_m);
        });
  }

 private:
  void measure_together(std::span<const std::uint32_t> which,
                        std::vector<double>& heights_m) const {
    const float top_m = scene_.top_m() + kAbove_m;
    RayArrays rays(which.size());
    for (std::size_t i = 0; i < which.size(); ++i) {
      const Eigen::Vector2f place = grid_.place(which[i]).cast<float>();
      rays.set(i, {.origin_m = {place.x(), place.y(), top_m}, .direction = {0, 0, -1}});
    }
    std::vector<Hit> hits(rays.size());
    scene_.cast_bundles(rays, rays.size(), top_m - scene_.bottom_m() + kAbove_m, hits);
    for (std::size_t i = 0; i < rays.size(); ++i)
      heights_m[which[i]] =
          height_of(scene_, terrain_, hits[i], static_cast<double>(top_m), grid_.place(which[i]));
  }

  const Scene& scene_;
  const terrain::Terrain& terrain_;
  const RayGrid& grid_;
};

// Moves the `count` rays of `waiting` with the highest ceilings to the end of `cast`.
void take_highest(std::vector<std::uint32_t>& waiting, const std::vector<float>& ceiling_m,
                  std::size_t count, std::vector<std::uint32_t>& cast) {
  const auto end = waiting.begin() + static_cast<std::ptrdiff_t>(std::min(count, waiting.size()));
  if (end != waiting.end()) {
    std::nth_element(waiting.begin(), end, waiting.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return ceiling_m[a] > ceiling_m[b]; });
  }
  std::sort(waiting.begin(), end);  // neighbours are cast together
  cast.insert(cast.end(), waiting.begin(), end);
  waiting.erase(waiting.begin(), end);
}

// The heights of the grid's rays. Only the highest are exact, those that decide the percentiles
// from kLowestShare up; the others may be too low.
std::vector<double> upper_heights(const Caster& caster, const std::vector<float>& ceiling_m) {
  const std::size_t rays = ceiling_m.size();
  const std::size_t wanted =
      rays - static_cast<std::size_t>(std::floor(kLowestShare * static_cast<double>(rays - 1)));
  std::vector<double> heights_m(rays, 0);
  std::vector<std::uint32_t> waiting, cast;
  for (std::uint32_t i = 0; i < rays; ++i)
    if (ceiling_m[i] > 0) waiting.push_back(i);
  std::vector<double> found_m;
  for (std::size_t count = wanted; !waiting.empty(); count *= 2) {
    const std::size_t known = cast.size();
    take_highest(waiting, ceiling_m, count, cast);
    caster.measure(std::span(cast).subspan(known), heights_m);
    for (const std::uint32_t ray : std::span(cast).subspan(known))
      found_m.push_back(-std::max(0.0, heights_m[ray]));
    if (found_m.size() < wanted) break;
    // The lowest height that still counts: a ray whose ceiling is no higher need not be cast.
    const double least_m = -selected<double>(found_m, wanted - 1);
    std::erase_if(
        waiting, [&](std::uint32_t ray) { return static_cast<double>(ceiling_m[ray]) <= least_m; });
  }
  return heights_m;
}

std::vector<double> all_heights(const Caster& caster, const RayGrid& grid) {
  std::vector<std::uint32_t> rays(grid.rays());
  std::iota(rays.begin(), rays.end(), 0U);
  std::vector<double> heights_m(rays.size());
  caster.measure(rays, heights_m);
  return heights_m;
}

farm::CanopyHeights canopy_of(const Scene& scene, const CanopyCeiling& ceiling,
                              const terrain::Terrain& terrain, const RayGrid& grid) {
  const Caster caster(scene, terrain, grid);
  const std::optional<std::vector<float>> ceiling_m = ceiling.over(grid);
  std::vector<double> heights_m =
      ceiling_m ? upper_heights(caster, *ceiling_m) : all_heights(caster, grid);
  std::erase_if(heights_m, [](double height_m) { return std::isnan(height_m); });
  if (heights_m.empty()) return {};
  const double p95 = quantile(heights_m, kLowestShare);
  return {.p95 = p95, .p99 = quantile(std::move(heights_m), 0.99)};
}

}  // namespace

void measure_canopies(farm::Farm& farm, int threads) {
  if (farm.plots.empty()) return;
  const Stage stage("canopies");
  const Scene scene(scene_content(farm));
  const CanopyCeiling ceiling(farm);
  const double step_m = step_of(farm);
  const int most = std::min(threads, tbb::info::default_concurrency());
  for_each_index(farm.plots.size(), most, [&](std::size_t i) {
    farm::Plot& plot = farm.plots[i];
    plot.canopy = canopy_of(scene, ceiling, farm.terrain, RayGrid(plot.box, step_m));
  });
}

}  // namespace plotscan::lidar
