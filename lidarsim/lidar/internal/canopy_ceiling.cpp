// SPDX-License-Identifier: Apache-2.0
#include "lidar/internal/canopy_ceiling.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/extent.h"

namespace plotscan::lidar {
namespace {

// Margin for single precision, which displaces rays and triangles by a few of its steps.
constexpr double kLeastMargin_m = 1e-3;
constexpr double kRoundings = 8;

// Looking up this many plants takes about as long as casting a ray.
constexpr double kMostPlantsARay = 64;

// The least width of the squares of the ground, and their greatest number.
constexpr double kLeastSide_m = 0.5;
constexpr double kMostSquares = 1e6;

double margin_of(const farm::Farm& farm) {
  double farthest_m = 0;
  for (const Eigen::Vector3d& vertex : farm.terrain.vertices())
    farthest_m = std::max(farthest_m, vertex.cwiseAbs().maxCoeff());
  for (const farm::Plant& plant : farm.plants)
    farthest_m = std::max(farthest_m, plant.position.cwiseAbs().maxCoeff());
  return kLeastMargin_m +
         kRoundings * static_cast<double>(std::numeric_limits<float>::epsilon()) * farthest_m;
}

bool is_upright(const farm::Plant& plant) {
  return plant.rotation.x() == 0 && plant.rotation.y() == 0;
}

}  // namespace

CanopyCeiling::CanopyCeiling(const farm::Farm& farm)
    : farm_(farm), border_(farm.terrain), margin_m_(margin_of(farm)) {
  std::vector<double> least_scale(farm.models.size(), 1);
  for (const farm::Plant& plant : farm.plants)
    least_scale[plant.model] = std::min(least_scale[plant.model], plant.scale.minCoeff());
  for (std::size_t i = 0; i < farm.models.size(); ++i) {
    const double margin = margin_m_ / least_scale[i];
    maps_.push_back({.upright = {farm.models[i].mesh, margin},
                     .of_any_turn = CeilingMap::of_any_turn(farm.models[i].mesh, margin)});
  }
  for (std::uint32_t i = 0; i < farm.plants.size(); ++i) {
    feet_.extend(Eigen::Vector2d(farm.plants[i].position.head<2>()));
    reach_m_ = std::max(reach_m_, standing(i).reach_m);
  }
  if (!farm.plants.empty()) sort_plants();
}

CanopyCeiling::Standing CanopyCeiling::standing(std::uint32_t number) const {
  const farm::Plant& plant = farm_.plants[number];
  const bool upright = is_upright(plant);
  const CeilingMap& map = upright ? maps_[plant.model].upright : maps_[plant.model].of_any_turn;
  const double widest = plant.scale.maxCoeff();
  Standing standing{.plant = number,
                    .map = &map,
                    .map_from_world = Eigen::Matrix2d::Identity() / widest,
                    .foot_m = plant.position.head<2>(),
                    .foot_z_m = plant.position.z(),
                    .z_scale = upright ? plant.scale.z() : widest,
                    .reach_m = map.reach() * widest};
  if (upright) {
    const Eigen::Matrix3d turn = plant.rotation.toRotationMatrix();
    standing.map_from_world =
        plant.scale.head<2>().cwiseInverse().asDiagonal() * turn.topLeftCorner<2, 2>().transpose();
  }
  return standing;
}

std::array<Eigen::Index, 2> CanopyCeiling::column_and_row(const Eigen::Vector2d& place) const {
  const Eigen::Array2d square = ((place - feet_.min()) / side_m_).array().floor();
  const auto within = [](double at, Eigen::Index count) {
    return static_cast<Eigen::Index>(std::clamp(at, 0.0, static_cast<double>(count - 1)));
  };
  return {within(square.x(), columns_), within(square.y(), rows_)};
}

std::size_t CanopyCeiling::square_of(const Eigen::Vector2d& place) const {
  const auto [column, row] = column_and_row(place);
  return static_cast<std::size_t>(row * columns_ + column);
}

// A counting sort: each square keeps its plants in the farm's order.
void CanopyCeiling::sort_plants() {
  const Eigen::Vector2d size = feet_.sizes();
  side_m_ = std::max({kLeastSide_m, size.maxCoeff() / std::sqrt(kMostSquares)});
  columns_ = static_cast<Eigen::Index>(size.x() / side_m_) + 1;
  rows_ = static_cast<Eigen::Index>(size.y() / side_m_) + 1;
  first_.assign(static_cast<std::size_t>(columns_ * rows_) + 1, 0);
  for (const farm::Plant& plant : farm_.plants) ++first_[square_of(plant.position.head<2>()) + 1];
  for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  plants_.resize(farm_.plants.size());
  for (std::uint32_t i = 0; i < farm_.plants.size(); ++i)
    plants_[next[square_of(farm_.plants[i].position.head<2>())]++] = i;
}

std::vector<CanopyCeiling::Standing> CanopyCeiling::plants_near(const RayGrid& grid) const {
  std::vector<Standing> near;
  if (plants_.empty()) return near;
  const Eigen::AlignedBox2d around = extent_of(std::array{grid.box});
  const Eigen::Vector2d reach = Eigen::Vector2d::Constant(reach_m_);
  const auto low = column_and_row(around.min() - reach);
  const auto high = column_and_row(around.max() + reach);
  for (Eigen::Index row = low[1]; row <= high[1]; ++row) {
    const auto line = static_cast<std::size_t>(row * columns_);
    const std::uint32_t begin = first_[line + static_cast<std::size_t>(low[0])];
    const std::uint32_t end = first_[line + static_cast<std::size_t>(high[0]) + 1];
    for (std::uint32_t i = begin; i < end; ++i) {
      const Standing plant = standing(plants_[i]);
      const Eigen::Vector2d place = grid.box.box_from_world(plant.foot_m).cwiseAbs();
      if (place.x() <= grid.box.length_m / 2 + plant.reach_m &&
          place.y() <= grid.box.width_m / 2 + plant.reach_m)
        near.push_back(plant);
    }
  }
  return near;
}

// Here ceiling_m holds z in the world frame, not yet heights above the ground.
void CanopyCeiling::raise(const Standing& plant, const RayGrid& grid,
                          std::vector<float>& ceiling_m) const {
  const Eigen::Vector2d foot = grid.box.box_from_world(plant.foot_m);
  const auto range = [&](double at_m, double side_m, std::size_t cells) {
    const double step_m = side_m / static_cast<double>(cells);
    const auto cell = [&](double place_m) {
      const double place = std::floor((place_m + side_m / 2) / step_m);
      return static_cast<std::size_t>(std::clamp(place, 0.0, static_cast<double>(cells - 1)));
    };
    return std::pair(cell(at_m - plant.reach_m), cell(at_m + plant.reach_m));
  };
  const auto [first_line, last_line] = range(foot.x(), grid.box.length_m, grid.lines);
  const auto [first_ray, last_ray] = range(foot.y(), grid.box.width_m, grid.rays_a_line);
  const Eigen::Vector2d step = plant.map->cells_per_metre() * plant.map_from_world *
                               grid.width_axis *
                               (grid.box.width_m / static_cast<double>(grid.rays_a_line));
  const auto rays = static_cast<double>(last_ray - first_ray);
  for (std::size_t line = first_line; line <= last_line; ++line) {
    const Eigen::Vector2d start =
        plant.map->cell_of(plant.map_from_world * (grid.place(line, first_ray) - plant.foot_m));
    const CeilingMap::Steps over = plant.map->steps_over(start, step);
    const double first = std::max(0.0, std::ceil(over.first));
    const double last = std::min(rays, over.last);
    if (first > last) continue;
    float* const ceilings = ceiling_m.data() + line * grid.rays_a_line + first_ray;
    for (auto ray = static_cast<std::size_t>(first); ray <= static_cast<std::size_t>(last); ++ray) {
      const double height = plant.map->at_cell(start + static_cast<double>(ray) * step);
      const auto z_m = static_cast<float>(plant.foot_z_m + plant.z_scale * height);
      ceilings[ray] = std::max(ceilings[ray], z_m);
    }
  }
}

std::optional<std::vector<float>> CanopyCeiling::over(const RayGrid& grid,
                                                      const std::vector<Standing>& near) const {
  const Eigen::AlignedBox2d around = extent_of(std::array{grid.box});
  const Eigen::Vector2d margin = Eigen::Vector2d::Constant(margin_m_);
  if (border_.may_meet({around.min() - margin, around.max() + margin})) return std::nullopt;
  if (!farm_.terrain.height(grid.box.center.x(), grid.box.center.y())) return std::nullopt;
  double lookups = 0;
  for (const Standing& plant : near) {
    const double wide_m = 2 * plant.reach_m;
    lookups += std::min(wide_m, grid.box.length_m) * std::min(wide_m, grid.box.width_m) /
               grid.box.area_m2();
  }
  if (lookups > kMostPlantsARay) return std::nullopt;
  std::vector<float> ceiling_m(grid.rays(), CeilingMap::kNothing);
  for (const Standing& plant : near) raise(plant, grid, ceiling_m);
  std::uint32_t triangle = 0;  // of the terrain, under the ray before
  for (std::size_t i = 0; i < ceiling_m.size(); ++i) {
    if (ceiling_m[i] == CeilingMap::kNothing) {
      ceiling_m[i] = 0;
      continue;
    }
    const Eigen::Vector2d place = grid.place(i);
    const double ground_m = farm_.terrain.height_near(place.x(), place.y(), triangle).value();
    const double above_m = static_cast<double>(ceiling_m[i]) - ground_m + 2 * margin_m_;
    ceiling_m[i] = static_cast<float>(std::max(0.0, above_m));
  }
  return ceiling_m;
}

}  // namespace plotscan::lidar
