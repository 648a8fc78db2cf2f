// SPDX-License-Identifier: Apache-2.0
#include "lidar/canopy_height.h"

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
#include "core/list_of.h"
#include "core/stage.h"
#include "core/statistics.h"
#include "lidar/embree.h"
#include "lidar/internal/canopy_ceiling.h"
#include "lidar/internal/mesh_trees.h"
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

// The height above the terrain of what a ray from start_m over `place` hits; NaN beside the
// terrain.
double height_of(const Scene& scene, const terrain::Terrain& terrain, const Hit& hit,
                 double start_m, const Eigen::Vector2d& place) {
  if (!std::isfinite(hit.range_m)) return kNaN;
  if (scene.surface(hit).label == scan::PointClass::ground) return 0;
  const std::optional<double> ground_m = terrain.height(place.x(), place.y());
  return ground_m ? std::max(0.0, start_m - static_cast<double>(hit.range_m) - *ground_m) : kNaN;
}

// Casts rays of a grid straight down, in bundles of one task each.
class Caster {
 public:
  // Rays start at the height start_m.
  Caster(const Scene& scene, float start_m, const terrain::Terrain& terrain, const RayGrid& grid)
      : scene_(scene), start_m_(start_m), terrain_(terrain), grid_(grid) {}

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
    RayArrays rays(which.size());
    for (std::size_t i = 0; i < which.size(); ++i) {
      const Eigen::Vector2f place = grid_.place(which[i]).cast<float>();
      rays.set(i, {.origin_m = {place.x(), place.y(), start_m_}, .direction = {0, 0, -1}});
    }
    std::vector<Hit> hits(rays.size());
    scene_.cast_bundles(rays, rays.size(), start_m_ - scene_.bottom_m() + kAbove_m, hits);
    for (std::size_t i = 0; i < rays.size(); ++i)
      heights_m[which[i]] = height_of(scene_, terrain_, hits[i], static_cast<double>(start_m_),
                                      grid_.place(which[i]));
  }

  const Scene& scene_;
  float start_m_;
  const terrain::Terrain& terrain_;
  const RayGrid& grid_;
};

// A ray that may have to be cast.
struct WaitingRay {
  float ceiling_m;
  std::uint32_t ray;
};

// Moves the `count` rays of `waiting` with the highest ceilings to the end of `cast`.
void take_highest(std::vector<WaitingRay>& waiting, std::size_t count,
                  std::vector<std::uint32_t>& cast) {
  const auto end = waiting.begin() + static_cast<std::ptrdiff_t>(std::min(count, waiting.size()));
  if (end != waiting.end())
    std::nth_element(waiting.begin(), end, waiting.end(),
                     [](const auto& a, const auto& b) { return a.ceiling_m > b.ceiling_m; });
  const std::size_t known = cast.size();
  for (auto each = waiting.begin(); each != end; ++each) cast.push_back(each->ray);
  std::sort(cast.begin() + static_cast<std::ptrdiff_t>(known), cast.end());  // neighbours together
  waiting.erase(waiting.begin(), end);
}

// How many rays to cast after so many. More at a time are cast in fewer steps, but more of them
// for nothing; whole packets.
std::size_t next_step(std::size_t cast) { return (cast / 4 + kPacket) / kPacket * kPacket; }

// The heights of the grid's rays. Only the highest are exact, those that decide the percentiles
// from kLowestShare up; the others may be too low.
std::vector<double> upper_heights(const Caster& caster, const std::vector<float>& ceiling_m) {
  const std::size_t rays = ceiling_m.size();
  const std::size_t wanted =
      rays - static_cast<std::size_t>(std::floor(kLowestShare * static_cast<double>(rays - 1)));
  std::vector<double> heights_m(rays, 0);
  std::vector<WaitingRay> waiting;
  for (std::uint32_t i = 0; i < rays; ++i)
    if (ceiling_m[i] > 0) waiting.push_back({ceiling_m[i], i});
  std::vector<std::uint32_t> cast;
  std::vector<double> found_m;
  for (std::size_t count = wanted; !waiting.empty(); count = next_step(cast.size())) {
    const std::size_t known = cast.size();
    take_highest(waiting, count, cast);
    caster.measure(std::span(cast).subspan(known), heights_m);
    for (const std::uint32_t ray : std::span(cast).subspan(known))
      found_m.push_back(-std::max(0.0, heights_m[ray]));
    if (found_m.size() < wanted) break;
    // The lowest height that still counts: a ray whose ceiling is no higher need not be cast.
    const double least_m = -selected<double>(found_m, wanted - 1);
    std::erase_if(waiting, [&](const WaitingRay& each) {
      return static_cast<double>(each.ceiling_m) <= least_m;
    });
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

Eigen::AlignedBox3d box_of(const mesh::Mesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t vertex : triangle) box.extend(mesh.vertices[vertex].cast<double>());
  return box;
}

// The top of each plant's box, world frame.
std::vector<double> tops_of_plants(const farm::Farm& farm) {
  const std::vector<Eigen::AlignedBox3d> boxes =
      list_of(farm.models, [](const farm::PlantModel& model) { return box_of(model.mesh); });
  return list_of(farm.plants, [&](const farm::Plant& plant) {
    return boxes[plant.model].transformed(farm::world_from_plant(plant)).max().z();
  });
}

// The top of a scene of the whole farm. A scene of the highest plants has the same, to the last
// bit.
float top_of(const farm::Farm& farm, const MeshTrees& meshes, double margin_m) {
  const std::vector<double> tops_m = tops_of_plants(farm);
  std::vector<PlacedMesh> highest = {placed_terrain(farm)};
  if (!tops_m.empty()) {
    const double least_m = *std::ranges::max_element(tops_m) - margin_m;
    for (std::size_t i = 0; i < tops_m.size(); ++i)
      if (tops_m[i] >= least_m) highest.push_back(placed_plant(farm.plants[i]));
  }
  return Scene(meshes, highest).top_m();
}

// What is needed to measure the canopy over any plot of a farm.
struct Canopies {
  const farm::Farm& farm;
  const MeshTrees& meshes;
  const CanopyCeiling& ceiling;
  // Where rays start, above everything. One height for all plots: heights are rounded with it.
  float start_m;
};

// A scene of the terrain and these plants. That of a plot is built and cast into faster than one of
// the whole farm, and holds little memory.
Scene scene_of(const Canopies& canopies, const std::vector<CanopyCeiling::Standing>& plants) {
  std::vector<PlacedMesh> placed = {placed_terrain(canopies.farm)};
  placed.reserve(plants.size() + 1);
  for (const CanopyCeiling::Standing& each : plants)
    placed.push_back(placed_plant(canopies.farm.plants[each.plant]));
  return {canopies.meshes, placed};
}

farm::CanopyHeights canopy_over(const Canopies& canopies, const RayGrid& grid) {
  const std::vector<CanopyCeiling::Standing> plants = canopies.ceiling.plants_near(grid);
  const Scene scene = scene_of(canopies, plants);
  const Caster caster(scene, canopies.start_m, canopies.farm.terrain, grid);
  const std::optional<std::vector<float>> ceiling_m = canopies.ceiling.over(grid, plants);
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
  const std::vector<mesh::Mesh> meshes = scene_meshes(farm);
  const MeshTrees trees(meshes, std::vector<bool>(meshes.size(), true));
  const CanopyCeiling ceiling(farm);
  const float top_m = top_of(farm, trees, ceiling.margin_m());
  const Canopies canopies{
      .farm = farm, .meshes = trees, .ceiling = ceiling, .start_m = top_m + kAbove_m};
  const double step_m = step_of(farm);
  const int most = std::min(threads, tbb::info::default_concurrency());
  for_each_index(farm.plots.size(), most, [&](std::size_t i) {
    farm::Plot& plot = farm.plots[i];
    plot.canopy = canopy_over(canopies, RayGrid(plot.box, step_m));
  });
}

}  // namespace plotscan::lidar
