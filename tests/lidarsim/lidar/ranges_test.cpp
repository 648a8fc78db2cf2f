// SPDX-License-Identifier: Apache-2.0
// Ranges against closed forms, for every laser.
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include <gtest/gtest.h>

#include "simulated.h"
#include "small_farm.h"

namespace plotscan::lidar {
namespace {

using testing::WorldShot;

constexpr double kFlown_m = 8;
constexpr SimulateOptions kNoiseless = {.range_noise_m = 0, .seed = 1, .threads = 2};

farm::Farm farm_of(terrain::Terrain terrain) {
  return {.name = "test",
          .seed = 1,
          .terrain = std::move(terrain),
          .models = {},
          .plots = {},
          .plants = {}};
}

// Every shot that meets the plane normal . x = offset within the square of half side 1000 m must
// have come back with the range to it.
void expect_ranges_to_plane(const farm::Farm& farm, const Eigen::Vector3d& normal, double offset) {
  const sensor::Sensor sensor = testing::exact_vlp16();
  const sensor::ShotPlan plan(sensor, 10, testing::spin_along_flight(),
                              testing::hover({0.5, 0.2, kFlown_m}, 0.2));
  std::map<std::uint64_t, scan::LabelledPoint> by_shot;
  for (const auto& point : testing::simulated(farm, sensor, plan, kNoiseless))
    by_shot[testing::shot_of(point)] = point;
  std::array<int, 16> returns{};
  for (std::uint64_t shot = 0; shot < 16 * plan.sequences(); ++shot) {
    const WorldShot ray = testing::world_shot(plan, shot);
    const double range = (offset - normal.dot(ray.origin)) / normal.dot(ray.direction);
    if (range < 0 || range > 900) {
      if (range < 0) {
        ASSERT_EQ(by_shot.count(shot), 0u);
      }
      continue;
    }
    ASSERT_EQ(by_shot.count(shot), 1u) << "shot " << shot << " at " << range << " m";
    const Eigen::Vector3d there = testing::position(by_shot[shot]);
    ASSERT_NEAR((there - ray.origin).norm(), range, 2e-5 * range) << "shot " << shot;
    ASSERT_EQ(by_shot[shot].ring, sensor.lasers[shot % 16].ring);
    ++returns[shot % 16];
  }
  for (const int count : returns) EXPECT_GT(count, 1000);
}

TEST(Ranges, ToAPlane) {
  expect_ranges_to_plane(farm_of(testing::flat_terrain(1000, 0.25)), Eigen::Vector3d::UnitZ(),
                         0.25);
}

TEST(Ranges, ToATiltedPlane) {
  // z = 0.1 x - 0.2 y
  const auto z = [](double x, double y) { return 0.1 * x - 0.2 * y; };
  constexpr double s = 1000;
  const terrain::Terrain tilted(
      {{-s, -s, z(-s, -s)}, {s, -s, z(s, -s)}, {s, s, z(s, s)}, {-s, s, z(-s, s)}},
      {{0, 1, 2}, {0, 2, 3}});
  expect_ranges_to_plane(farm_of(tilted), Eigen::Vector3d(-0.1, 0.2, 1), 0);
}

// A sphere of radius 1 whose triangles come from an octahedron halved `levels` times.
mesh::Mesh sphere(int levels) {
  mesh::Mesh mesh{
      .vertices = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
      .triangles = {
          {0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
  for (int level = 0; level < levels; ++level) {
    std::vector<std::array<std::uint32_t, 3>> finer;
    const auto between = [&](std::uint32_t a, std::uint32_t b) {
      mesh.vertices.push_back((mesh.vertices[a] + mesh.vertices[b]).normalized());
      return static_cast<std::uint32_t>(mesh.vertices.size() - 1);
    };
    for (const auto& t : mesh.triangles) {
      const std::uint32_t ab = between(t[0], t[1]);
      const std::uint32_t bc = between(t[1], t[2]);
      const std::uint32_t ca = between(t[2], t[0]);
      finer.insert(finer.end(), {{t[0], ab, ca}, {ab, t[1], bc}, {ca, bc, t[2]}, {ab, bc, ca}});
    }
    mesh.triangles = std::move(finer);
  }
  return mesh;
}

// The radius of the largest ball within the mesh.
double inner_radius(const mesh::Mesh& mesh) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& t : mesh.triangles) {
    const Eigen::Vector3d a = mesh.vertices[t[0]].cast<double>();
    const Eigen::Vector3d normal = (mesh.vertices[t[1]].cast<double>() - a)
                                       .cross(mesh.vertices[t[2]].cast<double>() - a)
                                       .normalized();
    least = std::min(least, std::abs(normal.dot(a)));
  }
  return least;
}

std::optional<double> range_to_sphere(const WorldShot& ray, const Eigen::Vector3d& center,
                                      double radius) {
  const Eigen::Vector3d to_center = center - ray.origin;
  const double along = to_center.dot(ray.direction);
  const double square = radius * radius - (to_center.squaredNorm() - along * along);
  if (square < 0 || along < 0) return std::nullopt;
  return along - std::sqrt(square);
}

// A sphere as a plant, scaled to 3 m: the mesh lies between two spheres, so the range lies between
// the ranges to them.
TEST(Ranges, ToASphere) {
  constexpr double kRadius_m = 3;
  const Eigen::Vector3d center(0.1, -0.3, 1);
  farm::Farm farm = farm_of(testing::flat_terrain(100, -20));
  farm.models.push_back({.name = "sphere", .mesh = sphere(6), .height_m = 1});
  farm.plants.push_back(
      {.id = 5, .position = center, .scale = Eigen::Vector3d::Constant(kRadius_m)});
  const double inner_m = kRadius_m * inner_radius(farm.models[0].mesh);
  ASSERT_LT(kRadius_m - inner_m, 1e-3);

  const sensor::Sensor sensor = testing::exact_vlp16();
  const sensor::ShotPlan plan(sensor, 10, testing::spin_along_flight(),
                              testing::hover({0, 0, 8}, 0.2));
  std::map<std::uint64_t, scan::LabelledPoint> on_sphere;
  for (const auto& point : testing::simulated(farm, sensor, plan, kNoiseless)) {
    if (point.plant == 5) on_sphere[testing::shot_of(point)] = point;
  }
  std::array<int, 16> returns{};
  for (std::uint64_t shot = 0; shot < 16 * plan.sequences(); ++shot) {
    const WorldShot ray = testing::world_shot(plan, shot);
    const auto nearest = range_to_sphere(ray, center, kRadius_m + 1e-5);
    const auto furthest = range_to_sphere(ray, center, inner_m - 1e-5);
    if (!nearest) {
      ASSERT_EQ(on_sphere.count(shot), 0u);
    }
    if (!furthest) continue;
    ASSERT_EQ(on_sphere.count(shot), 1u);
    const double range = (testing::position(on_sphere[shot]) - ray.origin).norm();
    ASSERT_GE(range, *nearest - 1e-5);
    ASSERT_LE(range, *furthest + 1e-5);
    ++returns[shot % 16];
  }
  for (const int count : returns) EXPECT_GT(count, 100);
}

}  // namespace
}  // namespace plotscan::lidar
