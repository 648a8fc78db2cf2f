// SPDX-License-Identifier: Apache-2.0
// Plants that sway, through the scene: against closed forms and against triangles bent one by one.

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "core/angle.h"
#include "lidar/internal/bent_stem.h"
#include "lidar/scene.h"
#include "lidar/sway.h"
#include "moeller_trumbore.h"
#include "small_farm.h"

namespace plotscan::lidar {
namespace {

using testing::moeller_trumbore;

constexpr double kBeyond_m = 100;
constexpr SwayOptions kSoft = {.lean_deg_at_5m_s = 25};

flight::WindOptions gusty_wind() {
  return {.mean_m_s = 8, .from_deg = 250, .turbulence = 0.3, .seed = 3};
}

// A thin upright prism of triangles, fine along its height.
mesh::Mesh stick(float height_m, float radius_m, std::uint32_t rings) {
  constexpr std::uint32_t kSides = 12;
  mesh::Mesh mesh;
  for (std::uint32_t ring = 0; ring <= rings; ++ring) {
    for (std::uint32_t side = 0; side < kSides; ++side) {
      const double angle = 2 * kPi * side / kSides;
      mesh.vertices.emplace_back(radius_m * static_cast<float>(std::cos(angle)),
                                 radius_m * static_cast<float>(std::sin(angle)),
                                 height_m * static_cast<float>(ring) / static_cast<float>(rings));
      if (ring == rings) continue;
      const std::uint32_t a = ring * kSides + side;
      const std::uint32_t b = ring * kSides + (side + 1) % kSides;
      mesh.triangles.push_back({a, b, b + kSides});
      mesh.triangles.push_back({a, b + kSides, a + kSides});
    }
  }
  return mesh;
}

farm::Farm stick_farm(float height_m, const Eigen::Vector3d& foot_m) {
  farm::Farm farm{.name = "stick",
                  .terrain = testing::flat_terrain(10, -5),
                  .models = {{.name = "stick", .mesh = stick(height_m, 0.002f, 64)}},
                  .plots = {},
                  .plants = {}};
  farm.plants.push_back({.id = 1, .plot = 0, .model = 0, .position = foot_m});
  return farm;
}

// A steady wind that leans a stick so far, to the east, and no swinging.
Sway steady_sway(const SceneContent& content, double height_m, double lean_deg) {
  return Sway({.lean_deg_at_5m_s = lean_deg, .swing = 0},
              {.mean_m_s = 5, .turbulence = 0, .height_m = height_m}, 60, crop_of(content));
}

// Rays level to the north at a stick's height meet it where its bent chain is.
TEST(SwayingScene, ScannedStickLiesOnTheBentChain) {
  const Eigen::Vector3d foot_m(1, 2, 0.3);
  const SceneContent content = scene_content(stick_farm(1.6f, foot_m));
  const Scene scene(content, steady_sway(content, 1.6, 15));
  const double lean = kMaxLean_rad * std::tanh(radians(15) / kMaxLean_rad);
  // Corners of the chain in closed form: on a circle.
  const double turn = 2 * lean / BentStem::kLinks;
  const double radius_m = 1.6 / BentStem::kLinks / (2 * std::sin(turn / 2));
  const double top_m = radius_m * std::sin(2 * lean);
  EXPECT_LT(top_m, 1.55);
  int met = 0;
  for (int i = 1; i < 200; ++i) {
    const double z_m = top_m * i / 200;
    int link = 0;
    while (radius_m * std::sin((link + 1) * turn) < z_m) ++link;
    const double below_m = radius_m * std::sin(link * turn);
    const double share = (z_m - below_m) / (radius_m * std::sin((link + 1) * turn) - below_m);
    const double x_m =
        radius_m * (1 - (1 - share) * std::cos(link * turn) - share * std::cos((link + 1) * turn));
    // From the south, half a millimetre beside the axis on either side.
    for (const double beside_m : {-0.0005, 0.0005}) {
      const Ray ray{(foot_m + Eigen::Vector3d(x_m + beside_m, -3, z_m)).cast<float>(),
                    Eigen::Vector3f(0, 1, 0), 10.0};
      Hit hit;
      scene.cast({&ray, 1}, kBeyond_m, {&hit, 1});
      ASSERT_TRUE(std::isfinite(hit.range_m)) << z_m;
      // The prism's near side: 2 mm from the axis, its flats at cos 15 degrees of that.
      EXPECT_NEAR(hit.range_m, 3 - 0.00195, 1e-4);
      ++met;
    }
    // 3 mm beside the axis there is nothing.
    for (const double beside_m : {-0.003, 0.003}) {
      const Ray ray{(foot_m + Eigen::Vector3d(x_m + beside_m, -3, z_m)).cast<float>(),
                    Eigen::Vector3f(0, 1, 0), 10.0};
      Hit hit;
      scene.cast({&ray, 1}, kBeyond_m, {&hit, 1});
      EXPECT_TRUE(std::isinf(hit.range_m)) << z_m;
    }
  }
  EXPECT_EQ(met, 2 * 199);
  // From above, the top is as high as the closed form says.
  const double tip_m = radius_m * (1 - std::cos(2 * lean));
  const Ray down{(foot_m + Eigen::Vector3d(tip_m - 0.0005, -0.00195, 5)).cast<float>(),
                 Eigen::Vector3f(0, 0, -1), 10.0};
  Hit hit;
  scene.cast({&down, 1}, kBeyond_m, {&hit, 1});
  ASSERT_TRUE(std::isfinite(hit.range_m));
  EXPECT_LT(5 - hit.range_m, top_m + 1e-5);
}

// The time series of a tip that is scanned again and again has the plant's frequency.
TEST(SwayingScene, ScannedTipSwingsAtTheStatedFrequency) {
  const SceneContent content = scene_content(stick_farm(1.0f, {0, 0, 0}));
  const Scene scene(content,
                    Sway({.lean_deg_at_5m_s = 6, .hz_at_1m = 1.3, .swing = 0.5},
                         {.mean_m_s = 5, .turbulence = 0, .height_m = 1}, 60, crop_of(content)));
  // From the east at the tip's height: the range tells how far it leans.
  const auto lean_m = [&](double time_s) {
    double nearest = std::numeric_limits<double>::infinity();
    for (int i = -40; i <= 40; ++i) {
      const Ray ray{{2, 0.001f * static_cast<float>(i), 0.9f}, {-1, 0, 0}, time_s};
      Hit hit;
      scene.cast({&ray, 1}, kBeyond_m, {&hit, 1});
      nearest = std::min(nearest, static_cast<double>(hit.range_m));
    }
    return 2 - nearest;
  };
  constexpr double kSpan_s = 10;
  constexpr int kSamples = 400;
  std::vector<double> series;
  double mean = 0;
  for (int i = 0; i < kSamples; ++i) {
    series.push_back(lean_m(kSpan_s * i / kSamples));
    ASSERT_TRUE(std::isfinite(series.back()));
    mean += series.back() / kSamples;
  }
  EXPECT_GT(mean, 0.05);
  double strongest = 0;
  double strongest_hz = 0;
  for (double hz = 0.3; hz < 6; hz += 0.1) {
    double re = 0;
    double im = 0;
    for (int i = 0; i < kSamples; ++i) {
      const double phase = 2 * kPi * hz * kSpan_s * i / kSamples;
      re += (series[static_cast<std::size_t>(i)] - mean) * std::cos(phase);
      im += (series[static_cast<std::size_t>(i)] - mean) * std::sin(phase);
    }
    if (std::hypot(re, im) <= strongest) continue;
    strongest = std::hypot(re, im);
    strongest_hz = hz;
  }
  EXPECT_NEAR(strongest_hz, 1.3, 0.06);
}

// A triangle of a plant or the ground where it is at some time.
struct BentTriangle {
  std::array<Eigen::Vector3d, 3> corners;
  std::uint32_t plant = 0;
};

// What of a polygon is above the height (sign 1) or below it (sign -1).
std::vector<Eigen::Vector3d> cut(const std::vector<Eigen::Vector3d>& polygon, double height_m,
                                 double sign) {
  std::vector<Eigen::Vector3d> part;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector3d& a = polygon[i];
    const Eigen::Vector3d& b = polygon[(i + 1) % polygon.size()];
    const double over_a = sign * (a.z() - height_m);
    const double over_b = sign * (b.z() - height_m);
    if (over_a >= 0) part.push_back(a);
    if ((over_a >= 0) != (over_b >= 0)) part.push_back(a + (b - a) * (over_a / (over_a - over_b)));
  }
  return part;
}

// A triangle at rest, seen from its plant's foot, cut where the stem's links meet, so that every
// piece stays flat; its corners bent one by one.
void add_bent(const std::array<Eigen::Vector3d, 3>& rest, const BentStem& stem, double height_m,
              const farm::Plant& plant, std::vector<BentTriangle>& all) {
  for (int link = -1; link < BentStem::kLinks; ++link) {
    std::vector<Eigen::Vector3d> piece(rest.begin(), rest.end());
    if (link >= 0) piece = cut(piece, height_m * link / BentStem::kLinks, 1);
    if (link + 1 < BentStem::kLinks)
      piece = cut(piece, height_m * (link + 1) / BentStem::kLinks, -1);
    for (Eigen::Vector3d& corner : piece)
      corner = plant.position + stem.bent(corner.cast<float>()).cast<double>();
    for (std::size_t i = 2; i < piece.size(); ++i)
      all.push_back({.corners = {piece[0], piece[i - 1], piece[i]}, .plant = plant.id});
  }
}

std::vector<BentTriangle> bent_triangles(const farm::Farm& farm, const Sway& sway, double time_s) {
  std::vector<BentTriangle> all;
  for (const farm::Plant& plant : farm.plants) {
    float height_m = 0;
    std::vector<std::array<Eigen::Vector3d, 3>> rest;  // seen from the foot
    farm::Farm one = farm;
    one.plants = {plant};
    for (const testing::WorldTriangle& triangle : testing::world_triangles(one)) {
      if (triangle.plant == 0) continue;
      rest.push_back(triangle.corners);
      for (Eigen::Vector3d& corner : rest.back()) {
        corner -= plant.position;
        height_m = std::max(height_m, static_cast<float>(corner.z()));
      }
    }
    const Sway::Motion motion =
        sway.motion_of(plant.id, plant.position.head<2>(), static_cast<double>(height_m));
    const BentStem stem(height_m, sway.lean_rad(motion, time_s).cast<float>());
    for (const auto& corners : rest)
      add_bent(corners, stem, static_cast<double>(height_m), plant, all);
  }
  for (const testing::WorldTriangle& triangle : testing::world_triangles(farm)) {
    if (triangle.plant == 0) all.push_back({.corners = triangle.corners, .plant = 0});
  }
  return all;
}

TEST(SwayingScene, HitsWhatBentTrianglesAreHit) {
  const farm::Farm farm = testing::small_farm();
  const SceneContent content = scene_content(farm);
  const Sway sway(kSoft, gusty_wind(), 60, crop_of(content));
  const Scene scene(content, sway);
  constexpr double kTime_s = 23.4;
  const std::vector<BentTriangle> triangles = bent_triangles(farm, sway, kTime_s);
  int on_plants = 0;
  int otherwise = 0;
  constexpr int kRays = 2000;
  for (int i = 0; i < kRays; ++i) {
    RandomStream stream(8, random_purpose("test/ray"), static_cast<std::uint64_t>(i));
    const farm::Plant& plant = farm.plants[stream.below(farm.plants.size())];
    const Eigen::Vector3d origin_m(stream.uniform(-7, 7), stream.uniform(-7, 7),
                                   stream.uniform(0.5, 4));
    const Eigen::Vector3d target_m =
        plant.position + Eigen::Vector3d(stream.uniform(-0.2, 0.4), stream.uniform(-0.2, 0.3),
                                         stream.uniform(0, 0.6));
    const Ray ray{origin_m.cast<float>(), (target_m - origin_m).normalized().cast<float>(),
                  kTime_s};
    Hit hit;
    scene.cast({&ray, 1}, kBeyond_m, {&hit, 1});
    double nearest_m = std::numeric_limits<double>::infinity();
    const BentTriangle* met = nullptr;
    for (const BentTriangle& triangle : triangles) {
      const double range_m = moeller_trumbore(ray.origin_m.cast<double>(),
                                              ray.direction.cast<double>(), triangle.corners);
      if (range_m >= nearest_m) continue;
      nearest_m = range_m;
      met = &triangle;
    }
    if (met == nullptr && std::isinf(hit.range_m)) continue;
    // Single precision decides otherwise only where a ray passes next to an edge.
    if (!(std::abs(hit.range_m - nearest_m) < 2e-5 * (1 + nearest_m))) {
      ++otherwise;
      continue;
    }
    ASSERT_EQ(scene.surface(hit).plant, met->plant);
    if (met->plant == 0) continue;
    ++on_plants;
    const auto& c = met->corners;
    const Eigen::Vector3d normal = (c[1] - c[0]).cross(c[2] - c[0]).normalized();
    EXPECT_NEAR(hit.cos_incidence, std::abs(normal.dot(ray.direction.cast<double>())), 2e-3);
  }
  EXPECT_GT(on_plants, kRays / 6);
  EXPECT_LE(otherwise, kRays / 500);
}

// The bent plants are elsewhere than the plants at rest, each at its own time.
TEST(SwayingScene, MovesFromTimeToTime) {
  const farm::Farm farm = testing::small_farm();
  const SceneContent content = scene_content(farm);
  const Scene scene(content, Sway(kSoft, gusty_wind(), 60, crop_of(content)));
  int changed = 0;
  for (int i = 0; i < 1000; ++i) {
    RandomStream stream(8, random_purpose("test/ray"), static_cast<std::uint64_t>(i));
    const farm::Plant& plant = farm.plants[stream.below(farm.plants.size())];
    std::vector<Ray> rays(2);
    for (Ray& ray : rays)
      ray = {(plant.position + Eigen::Vector3d(stream.uniform(0, 0.1), 0, 3)).cast<float>(),
             {0, 0, -1}};
    rays[1] = rays[0];
    rays[1].time_s = 0.3;
    std::vector<Hit> hits(2);
    scene.cast(rays, kBeyond_m, hits);
    if (hits[0].range_m != hits[1].range_m) ++changed;
  }
  EXPECT_GT(changed, 100);
}

}  // namespace
}  // namespace plotscan::lidar
