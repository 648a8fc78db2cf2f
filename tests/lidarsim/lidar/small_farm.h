// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <Eigen/Geometry>

#include "core/random.h"
#include "farm/farm.h"

namespace plotscan::testing {

// A square of flat ground at height z, two triangles.
inline terrain::Terrain flat_terrain(double half_side_m, double z_m) {
  const double s = half_side_m;
  return {{{-s, -s, z_m}, {s, -s, z_m}, {s, s, z_m}, {-s, s, z_m}}, {{0, 1, 2}, {0, 2, 3}}};
}

// A grid of triangles over a wavy surface.
inline terrain::Terrain wavy_terrain(double half_side_m, std::uint32_t cells) {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (std::uint32_t j = 0; j <= cells; ++j) {
    for (std::uint32_t i = 0; i <= cells; ++i) {
      const double x = half_side_m * (2.0 * i / cells - 1);
      const double y = half_side_m * (2.0 * j / cells - 1);
      vertices.emplace_back(x, y, 0.4 * std::sin(0.7 * x) * std::cos(0.5 * y));
      if (i == cells || j == cells) continue;
      const std::uint32_t corner = j * (cells + 1) + i;
      triangles.push_back({corner, corner + 1, corner + cells + 2});
      triangles.push_back({corner, corner + cells + 2, corner + cells + 1});
    }
  }
  return {vertices, triangles};
}

// A mesh of `leaves` random triangles in a cylinder of 0.2 m radius and 0.5 m height.
inline mesh::Mesh random_bush(std::uint64_t seed, int leaves) {
  mesh::Mesh mesh;
  RandomStream stream(seed, random_purpose("test/bush"), 0);
  for (int leaf = 0; leaf < leaves; ++leaf) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    const Eigen::Vector3d center(stream.uniform(-0.15, 0.15), stream.uniform(-0.15, 0.15),
                                 stream.uniform(0.05, 0.45));
    for (int corner = 0; corner < 3; ++corner) {
      const Eigen::Vector3d offset(stream.uniform(-0.05, 0.05), stream.uniform(-0.05, 0.05),
                                   stream.uniform(-0.05, 0.05));
      mesh.vertices.emplace_back((center + offset).cast<float>());
    }
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

// Two plots of bushes, unevenly scaled and turned, and two bushes outside of them, on wavy ground.
inline farm::Farm small_farm() {
  farm::Farm farm{.name = "small",
                  .seed = 7,
                  .terrain = wavy_terrain(8, 6),
                  .models = {{.name = "a", .mesh = random_bush(1, 40), .height_m = 0.5},
                             {.name = "b", .mesh = random_bush(2, 60), .height_m = 0.5}},
                  .plots = {},
                  .plants = {}};
  for (std::uint32_t id = 1; id <= 2; ++id) {
    farm.plots.push_back({.id = id,
                          .row = 1,
                          .column = static_cast<int>(id),
                          .box = {.center = {id == 1 ? -2.0 : 2.0, 0},
                                  .width_m = 1.5,
                                  .length_m = 3,
                                  .heading_rad = 0},
                          .plant_count = 10,
                          .heights = {}});
  }
  for (std::uint32_t i = 0; i < 22; ++i) {
    RandomStream stream(farm.seed, random_purpose("test/plant"), i);
    const std::uint32_t plot = i < 10 ? 1 : i < 20 ? 2 : 0;
    const Eigen::Vector2d center =
        plot == 0 ? Eigen::Vector2d(0, 4) : farm.plots[plot - 1].box.center;
    const double x = center.x() + stream.uniform(-1.4, 1.4);
    const double y = center.y() + stream.uniform(-0.7, 0.7);
    const double yaw = stream.uniform(0, 2 * std::numbers::pi);
    farm.plants.push_back(
        {.id = 100 + i,
         .plot = plot,
         .model = i % 2,
         .position = {x, y, farm.terrain.height(x, y).value()},
         .rotation = Eigen::Quaterniond(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) *
                                        Eigen::AngleAxisd(0.2, Eigen::Vector3d::UnitX())),
         .scale = {stream.uniform(0.7, 1.5), stream.uniform(0.7, 1.5), stream.uniform(0.7, 1.5)},
         .height_m = 0.8});
  }
  return farm;
}

// A triangle in the world frame and what it belongs to.
struct WorldTriangle {
  std::array<Eigen::Vector3d, 3> corners;
  std::uint32_t plot = 0;
  std::uint32_t plant = 0;  // 0: the terrain
};

inline std::vector<WorldTriangle> world_triangles(const farm::Farm& farm) {
  std::vector<WorldTriangle> all;
  for (const auto& t : farm.terrain.triangles()) {
    const auto& v = farm.terrain.vertices();
    all.push_back({.corners = {v[t[0]], v[t[1]], v[t[2]]}});
  }
  for (const farm::Plant& plant : farm.plants) {
    const mesh::Mesh& mesh = farm.models[plant.model].mesh;
    const auto placed = [&](std::uint32_t vertex) -> Eigen::Vector3d {
      const Eigen::Vector3d scaled = mesh.vertices[vertex].cast<double>().cwiseProduct(plant.scale);
      return plant.position + plant.rotation * scaled;
    };
    for (const auto& t : mesh.triangles) {
      all.push_back({.corners = {placed(t[0]), placed(t[1]), placed(t[2])},
                     .plot = plant.plot,
                     .plant = plant.id});
    }
  }
  return all;
}

}  // namespace plotscan::testing
