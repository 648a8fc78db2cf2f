// SPDX-License-Identifier: Apache-2.0
#include "lidar/scene.h"

#include <cmath>
#include <limits>
#include <memory>

#include <gtest/gtest.h>

#include "core/error.h"
#include "lidar/internal/mesh_trees.h"
#include "mesh/alpha_mask.h"
#include "moeller_trumbore.h"
#include "small_farm.h"
#include "test_images.h"

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

TEST(Scene, OfSharedMeshesHitsTheSame) {
  const farm::Farm farm = testing::small_farm();
  const SceneContent content = scene_content(farm);
  const Scene own(content);
  const MeshTrees meshes(content.meshes, std::vector<bool>(content.meshes.size(), true));
  const Scene sharing(meshes, content.placed);
  const Scene sharing_too(meshes, content.placed);
  const std::vector<Ray> rays = random_rays(farm, 2000);
  std::vector<Hit> expected(rays.size());
  own.cast(rays, kFar_m, expected);
  for (const Scene* scene : {&sharing, &sharing_too}) {
    EXPECT_EQ(scene->top_m(), own.top_m());
    EXPECT_EQ(scene->bottom_m(), own.bottom_m());
    std::vector<Hit> hits(rays.size());
    scene->cast(rays, kFar_m, hits);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      ASSERT_EQ(hits[i].range_m, expected[i].range_m);
      if (!std::isfinite(expected[i].range_m)) continue;
      ASSERT_EQ(hits[i].surface, expected[i].surface);
      ASSERT_EQ(hits[i].cos_incidence, expected[i].cos_incidence);
      ASSERT_EQ(hits[i].reflectance, expected[i].reflectance);
    }
  }
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

// Each ray becomes a bundle of rays that spread by some milliradians.
std::vector<Ray> bundled(const std::vector<Ray>& rays, std::size_t bundle) {
  std::vector<Ray> bundles;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    RandomStream stream(5, random_purpose("test/bundle"), i);
    for (std::size_t k = 0; k < bundle; ++k) {
      const Eigen::Vector3f aside(stream.uniform(-2e-3, 2e-3), stream.uniform(-2e-3, 2e-3),
                                  stream.uniform(-2e-3, 2e-3));
      bundles.push_back({rays[i].origin_m, (rays[i].direction + aside).normalized()});
    }
  }
  return bundles;
}

RayArrays arrays_of(const std::vector<Ray>& rays) {
  RayArrays arrays(rays.size());
  for (std::size_t i = 0; i < rays.size(); ++i) arrays.set(i, rays[i]);
  return arrays;
}

// The same as one by one, but where a ray passes within micrometres of an edge.
TEST(Scene, RaysInBundlesHitWhatTheyHitOneByOne) {
  const farm::Farm farm = testing::small_farm();
  const Scene scene(scene_content(farm));
  for (const std::size_t bundle : {1, 7, 8, 19}) {
    const std::vector<Ray> rays = bundled(random_rays(farm, 2000), bundle);
    std::vector<Hit> alone(rays.size()), together(rays.size());
    scene.cast(rays, kFar_m, alone);
    scene.cast_bundles(arrays_of(rays), bundle, kFar_m, together);
    std::size_t met = 0, otherwise = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      met += std::isfinite(alone[i].range_m);
      const bool same = (std::isinf(alone[i].range_m) && std::isinf(together[i].range_m)) ||
                        std::abs(alone[i].range_m - together[i].range_m) < 1e-5;
      if (!same) {
        ++otherwise;
      } else if (std::isfinite(alone[i].range_m)) {
        ASSERT_EQ(together[i].surface, alone[i].surface);
        ASSERT_NEAR(together[i].cos_incidence, alone[i].cos_incidence, 1e-5);
        ASSERT_EQ(together[i].reflectance, alone[i].reflectance);
      }
    }
    EXPECT_GT(met, rays.size() / 2);
    EXPECT_LT(met, rays.size());
    EXPECT_LE(otherwise, 2) << bundle;
  }
}

// A plate 1 m above flat ground, of which every other quarter is a hole.
TEST(Scene, RaysInBundlesPassHoles) {
  const std::string png =
      testing::png_of_grey(2, 2, [](int column, int row) { return column == row ? 255 : 0; });
  mesh::Mesh plate{
      .vertices = {{-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}},
      .triangles = {{0, 1, 2}, {0, 2, 3}},
      .materials = {{.name = "leaf",
                     .mask = std::make_shared<const mesh::AlphaMask>(
                         std::make_shared<const mesh::Image>(mesh::Image{"mask.png", png}),
                         mesh::kAlphaCutoff, "mask.png")}},
      .triangle_material = {0, 0},
      .texture_coordinates = {{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  SceneContent content;
  content.meshes = {plate, plate};
  content.meshes[1].materials.clear();
  content.meshes[1].triangle_material.clear();
  content.placed = {{.mesh = 0, .surface = {}},
                    {.mesh = 1,
                     .world_from_mesh = Eigen::Affine3d(Eigen::Translation3d(0, 0, -1)),
                     .surface = {}}};
  const Scene scene(content);
  const std::vector<Ray> rays = bundled({{{0, 0, 5}, {0, 0, -1}}}, 8);
  std::vector<Hit> hits(rays.size());
  scene.cast_bundles(arrays_of(rays), rays.size(), kFar_m, hits);
  int in_holes = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Eigen::Vector3f at = rays[i].origin_m + 4 * rays[i].direction;
    const bool hole = at.x() * at.y() > 0;
    EXPECT_NEAR(hits[i].range_m, hole ? 5 : 4, 1e-4) << at.transpose();
    in_holes += hole;
  }
  EXPECT_GT(in_holes, 0);
  EXPECT_LT(in_holes, 8);
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
