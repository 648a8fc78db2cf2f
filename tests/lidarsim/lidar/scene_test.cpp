// SPDX-License-Identifier: Apache-2.0
#include "lidar/scene.h"

#include <cmath>
#include <limits>

#include "moeller_trumbore.h"
#include "small_farm.h"
#include <gtest/gtest.h>

#include "core/error.h"

namespace plotscan::lidar {
namespace {

using testing::moeller_trumbore;
using testing::WorldTriangle;

constexpr double kFar_m = 100;

struct BruteHit {
  double range_m = std::numeric_limits<double>::infinity();
  const WorldTriangle* triangle = nullptr;
};

BruteHit brute_force(const Ray& ray, const std::vector<WorldTriangle>& triangles) {
  BruteHit nearest;
  for (const WorldTriangle& triangle : triangles) {
    const double range = moeller_trumbore(ray.origin_m.cast<double>(), ray.direction.cast<double>(),
                                          triangle.corners);
    if (range < nearest.range_m) nearest = {.range_m = range, .triangle = &triangle};
  }
  return nearest;
}

// Every other ray is aimed at a plant, the rest anywhere, the sky included.
std::vector<Ray> random_rays(const farm::Farm& farm, std::uint64_t count) {
  std::vector<Ray> rays;
  for (std::uint64_t i = 0; i < count; ++i) {
    RandomStream stream(3, random_purpose("test/ray"), i);
    const Eigen::Vector3d origin(stream.uniform(-7, 7), stream.uniform(-7, 7),
                                 stream.uniform(2, 4));
    Eigen::Vector3d target(stream.uniform(-4, 4), stream.uniform(-2, 2), stream.uniform(-0.5, 4));
    if (i % 2 == 0) {
      const farm::Plant& plant = farm.plants[stream.below(farm.plants.size())];
      target = plant.position + Eigen::Vector3d(stream.uniform(-0.2, 0.2),
                                                stream.uniform(-0.2, 0.2), stream.uniform(0, 0.6));
    }
    rays.push_back({origin.cast<float>(), (target - origin).normalized().cast<float>()});
  }
  return rays;
}

TEST(Scene, HitsWhatBruteForceHits) {
  const farm::Farm farm = testing::small_farm();
  const std::vector<WorldTriangle> triangles = testing::world_triangles(farm);
  const Scene scene(scene_content(farm));
  const std::vector<Ray> rays = random_rays(farm, 20000);
  std::vector<Hit> hits(rays.size());
  scene.cast(rays, kFar_m, hits);
  int on_plants = 0;
  int missed = 0;
  int at_an_edge = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const BruteHit expected = brute_force(rays[i], triangles);
    if (!std::isfinite(expected.range_m) && !std::isfinite(hits[i].range_m)) {
      ++missed;
      continue;
    }
    // Single precision decides otherwise only where a ray passes within micrometres of an edge.
    if (!(std::abs(hits[i].range_m - expected.range_m) < 1e-5 * (1 + expected.range_m))) {
      ++at_an_edge;
      continue;
    }
    const Surface& surface = scene.surface(hits[i]);
    ASSERT_EQ(surface.plant, expected.triangle->plant);
    ASSERT_EQ(surface.plot, expected.triangle->plot);
    ASSERT_EQ(surface.label,
              surface.plant == 0 ? scan::PointClass::ground : scan::PointClass::crop);
    if (surface.plant != 0) ++on_plants;
    const auto& c = expected.triangle->corners;
    const double cosine = std::abs(
        (c[1] - c[0]).cross(c[2] - c[0]).normalized().dot(rays[i].direction.cast<double>()));
    ASSERT_NEAR(hits[i].cos_incidence, cosine, 1e-4);
  }
  EXPECT_GT(on_plants, 1000);
  EXPECT_GT(missed, 1000);
  EXPECT_LE(at_an_edge, 2);
}

// Rays aimed at the common edges of the terrain's triangles all hit.
TEST(Scene, NoRaySlipsBetweenTrianglesOfTheTerrain) {
  farm::Farm farm = testing::small_farm();
  farm.plants.clear();
  const Scene scene(scene_content(farm));
  const Eigen::Vector3d origin(0.3, -0.2, 8);
  std::vector<Ray> rays;
  for (std::size_t first = 0; first < farm.terrain.triangles().size(); first += 2) {
    // The diagonal of a cell, its two triangles' common edge: never on the terrain's border.
    const auto& t = farm.terrain.triangles()[first];
    const Eigen::Vector3d& a = farm.terrain.vertices()[t[0]];
    const Eigen::Vector3d& b = farm.terrain.vertices()[t[2]];
    for (int i = 1; i < 100; ++i) {
      const Eigen::Vector3d target = a + (b - a) * i / 100;
      rays.push_back({origin.cast<float>(), (target - origin).normalized().cast<float>()});
    }
  }
  std::vector<Hit> hits(rays.size());
  scene.cast(rays, kFar_m, hits);
  for (const Hit& hit : hits) ASSERT_TRUE(std::isfinite(hit.range_m));
}

TEST(Scene, SeesNothingBeyondItsReach) {
  const farm::Farm farm{.name = "flat",
                        .terrain = testing::flat_terrain(10, 0),
                        .models = {},
                        .plots = {},
                        .plants = {}};
  const Scene scene(scene_content(farm));
  const std::vector<Ray> rays = {{{0, 0, 5}, {0, 0, -1}}};
  std::vector<Hit> hits(1);
  scene.cast(rays, 5.01f, hits);
  EXPECT_FLOAT_EQ(hits[0].range_m, 5);
  EXPECT_FLOAT_EQ(hits[0].cos_incidence, 1);
  scene.cast(rays, 4.99f, hits);
  EXPECT_TRUE(std::isinf(hits[0].range_m));
}

TEST(Scene, PlantWithoutModelIsRefused) {
  farm::Farm farm = testing::small_farm();
  farm.plants[3].model = 9;
  EXPECT_THROW(scene_content(farm), InputError);
}

}  // namespace
}  // namespace plotscan::lidar
