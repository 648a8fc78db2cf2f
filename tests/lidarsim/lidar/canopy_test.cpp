// SPDX-License-Identifier: Apache-2.0
// Canopies of grown crops as a laser sees them: gaps seen from above, hits by height.
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include <gtest/gtest.h>

#include "core/random.h"
#include "crop/grow.h"
#include "mesh/measure.h"
#include "simulated.h"

namespace plotscan::lidar {
namespace {

using Profile = std::array<double, 10>;  // shares of the plants' hits by tenths of their height

// A crop in its default stage, in its usual stand.
struct Stand {
  const char* crop;
  double plants_per_m2;
  double row_m;  // between rows
};

void PrintTo(const Stand& stand, std::ostream* out) { *out << stand.crop; }

constexpr Stand kSoybean{"soybean", 33, 0.45};
constexpr Stand kWheat{"wheat", 250, 0.125};
constexpr Stand kMaize{"maize", 8, 0.75};
constexpr std::uint64_t kVariants = 5;

std::vector<mesh::Mesh> variants(const Stand& stand) {
  std::vector<mesh::Mesh> meshes;
  for (std::uint64_t seed = 1; seed <= kVariants; ++seed)
    meshes.push_back(crop::grow({.crop = stand.crop}, seed));
  return meshes;
}

// Whether a triangle's material has the word in its name; all triangles of a mesh without
// materials.
bool is_of(const mesh::Mesh& mesh, std::size_t triangle, const std::string& word) {
  if (mesh.materials.empty()) return true;
  return mesh.materials[mesh.material_of(triangle)].name.find(word) != std::string::npos;
}

// The triangles that are, or are not, of the material.
mesh::Mesh part(const mesh::Mesh& whole, const std::string& word, bool with) {
  mesh::Mesh kept{.vertices = whole.vertices, .triangles = {}};
  for (std::size_t i = 0; i < whole.triangles.size(); ++i) {
    if (is_of(whole, i, word) == with) kept.triangles.push_back(whole.triangles[i]);
  }
  return kept;
}

PlacedMesh plant_at(std::uint32_t mesh, double x, double y, double yaw_rad) {
  PlacedMesh placed{.mesh = mesh, .surface = {.label = scan::PointClass::crop}};
  placed.world_from_mesh =
      Eigen::Translation3d(x, y, 0) * Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ());
  return placed;
}

// Square metres of leaf turned upward: the area times the mean |cos zenith| of its normals, G(0).
double leaf_area_from_above(const mesh::Mesh& mesh) {
  double area_m2 = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (!is_of(mesh, i, "leaf")) continue;
    const auto& t = mesh.triangles[i];
    const Eigen::Vector3d a = mesh.vertices[t[0]].cast<double>();
    const Eigen::Vector3d b = mesh.vertices[t[1]].cast<double>() - a;
    const Eigen::Vector3d c = mesh.vertices[t[2]].cast<double>() - a;
    area_m2 += std::abs(b.cross(c).z()) / 2;
  }
  return area_m2;
}

// Square metres that a mesh covers seen from above, by marking cells of a grid.
double silhouette(const mesh::Mesh& mesh) {
  constexpr double kCell_m = 0.002;
  constexpr int kHalf = 600;  // cells from the origin to the grid's edge
  std::vector<bool> covered(4 * kHalf * kHalf, false);
  for (const auto& t : mesh.triangles) {
    std::array<Eigen::Vector2d, 3> c;
    for (int i = 0; i < 3; ++i)
      c[i] =
          mesh.vertices[t[i]].head<2>().cast<double>() / kCell_m + Eigen::Vector2d::Constant(kHalf);
    const auto cross = [](const Eigen::Vector2d& p, const Eigen::Vector2d& q) {
      return p.x() * q.y() - p.y() * q.x();
    };
    const double turn = cross(c[1] - c[0], c[2] - c[0]) < 0 ? -1 : 1;
    const Eigen::Vector2d low = c[0].cwiseMin(c[1]).cwiseMin(c[2]);
    const Eigen::Vector2d high = c[0].cwiseMax(c[1]).cwiseMax(c[2]);
    for (int y = std::max(0, static_cast<int>(low.y())); y <= high.y() && y < 2 * kHalf; ++y) {
      for (int x = std::max(0, static_cast<int>(low.x())); x <= high.x() && x < 2 * kHalf; ++x) {
        const Eigen::Vector2d p(x + 0.5, y + 0.5);
        bool inside = true;
        for (int i = 0; i < 3; ++i)
          inside = inside && turn * cross(c[(i + 1) % 3] - c[i], p - c[i]) >= 0;
        if (inside) covered[static_cast<std::size_t>(y) * 2 * kHalf + x] = true;
      }
    }
  }
  return kCell_m * kCell_m * static_cast<double>(std::count(covered.begin(), covered.end(), true));
}

double mean_over(const std::vector<mesh::Mesh>& meshes, double (*measure)(const mesh::Mesh&)) {
  double sum = 0;
  for (const mesh::Mesh& mesh : meshes) sum += measure(mesh);
  return sum / static_cast<double>(meshes.size());
}

// The share of vertical rays that pass plants dropped at random over a square.
double gap_fraction(const std::vector<mesh::Mesh>& meshes, double plants_per_m2) {
  constexpr double kHalf_m = 4;      // of the square with rays
  constexpr double kMargin_m = 1.2;  // plants that reach into it
  constexpr int kRays = 500;         // a side
  SceneContent content{.meshes = meshes, .placed = {}};
  const double side_m = 2 * (kHalf_m + kMargin_m);
  const auto count = static_cast<std::uint64_t>(std::lround(plants_per_m2 * side_m * side_m));
  for (std::uint64_t i = 0; i < count; ++i) {
    RandomStream stream(11, random_purpose("test/stand"), i);
    content.placed.push_back(plant_at(
        static_cast<std::uint32_t>(i % meshes.size()), stream.uniform(-side_m / 2, side_m / 2),
        stream.uniform(-side_m / 2, side_m / 2), stream.uniform(0, 2 * std::numbers::pi)));
  }
  const Scene scene(content);
  int passed = 0;
  for (int i = 0; i < kRays * kRays; ++i) {
    const double x = kHalf_m * (2.0 * (i % kRays) / kRays - 1);
    const double y = kHalf_m * (2.0 * (i / kRays) / kRays - 1);
    const Ray ray{{static_cast<float>(x), static_cast<float>(y), 10}, {0, 0, -1}};
    Hit hit;
    scene.cast({&ray, 1}, 20, {&hit, 1});
    passed += std::isfinite(hit.range_m) ? 0 : 1;
  }
  return static_cast<double>(passed) / (kRays * kRays);
}

class CanopyOf : public ::testing::TestWithParam<Stand> {};

// Plants dropped at random leave the gap exp(-plants a square metre * silhouette of one): the
// Boolean model (Serra, Image Analysis and Mathematical Morphology, 1982, chapter XIII). Leaves
// dropped at random would leave Beer and Lambert's exp(-G(0) LAI) (Monsi and Saeki 1953); those of
// a plant lie over each other, so that the gap is larger. The ratio of the logarithms is the
// clumping index (Nilson 1971): 1 where a plant's leaves avoid each other, the lower the more they
// lie over each other, as those of maize do, which stand in one plane.
TEST_P(CanopyOf, GapsSeenFromAboveFollowBeerAndLambert) {
  const std::vector<mesh::Mesh> meshes = variants(GetParam());
  const double leaves = GetParam().plants_per_m2 * mean_over(meshes, leaf_area_from_above);
  const double plants = GetParam().plants_per_m2 * mean_over(meshes, silhouette);
  // Thinned where the canopy is closed: the logarithm of a small gap is mostly chance.
  const double thinning = std::min(1.0, 1.5 / plants);
  const double gap = gap_fraction(meshes, thinning * GetParam().plants_per_m2);
  EXPECT_NEAR(-std::log(gap), thinning * plants, 0.1 * thinning * plants);
  const double clumping = -std::log(gap) / (thinning * leaves);
  std::printf("%s: G(0) LAI %.2f, silhouettes %.2f, thinned gap %.3f, clumping %.2f\n",
              GetParam().crop, leaves, plants, gap, clumping);
  EXPECT_GT(clumping, 0.3);
  EXPECT_LT(clumping, 1.1);  // stems and ears cover, too
}

// What a VLP-16 meets of a stand in rows.
struct Seen {
  double ground = 0;  // share of all hits
  Profile plants{};   // of all hits on plants
  Profile marked{};   // of the hits on their marked part
};

// A flight over a square of rows; the part of the plants with the material is marked.
Seen scanned(const Stand& stand, const std::string& material) {
  constexpr double kHalf_m = 2;
  SceneContent content;
  double height_m = 0;
  for (const mesh::Mesh& mesh : variants(stand)) {
    height_m += mesh::mesh_height(mesh) / kVariants;
    content.meshes.push_back(part(mesh, material, false));
    content.meshes.push_back(part(mesh, material, true));
  }
  const double step_m = 1 / (stand.plants_per_m2 * stand.row_m);
  std::uint64_t plant = 0;
  for (double y = -kHalf_m; y <= kHalf_m; y += stand.row_m) {
    for (double x = -kHalf_m; x <= kHalf_m; x += step_m) {
      RandomStream stream(12, random_purpose("test/stand"), plant++);
      const double yaw_rad = stream.uniform(0, 2 * std::numbers::pi);
      const auto variant = static_cast<std::uint32_t>(plant % kVariants);
      for (const bool marked : {false, true}) {
        const std::uint32_t mesh = 2 * variant + (marked ? 1 : 0);
        if (content.meshes[mesh].triangles.empty()) continue;
        content.placed.push_back(
            plant_at(mesh, x + stream.uniform(-0.2, 0.2) * step_m, y, yaw_rad));
        if (marked) content.placed.back().surface.label = scan::PointClass::other;
      }
    }
  }
  content.meshes.push_back({.vertices = {{-50, -50, 0}, {50, -50, 0}, {50, 50, 0}, {-50, 50, 0}},
                            .triangles = {{0, 1, 2}, {0, 2, 3}}});
  content.placed.push_back({.mesh = static_cast<std::uint32_t>(content.meshes.size() - 1),
                            .surface = {.label = scan::PointClass::ground}});
  const scan::Trajectory flight(
      {{.time_s = 0, .position_m = {-4, 0, 8}}, {.time_s = 2, .position_m = {4, 0, 8}}});
  const sensor::Sensor sensor = testing::exact_vlp16();
  const sensor::ShotPlan plan(sensor, 10, testing::spin_along_flight(), flight);
  Seen seen;
  double all = 0;
  double plants = 0;
  double marked = 0;
  const auto take = [&](std::span<const scan::LabelledPoint> points) {
    for (const scan::LabelledPoint& point : points) {
      // Within the stand, a metre from its edge.
      if (std::max(std::abs(point.x), std::abs(point.y)) > static_cast<float>(kHalf_m) - 1)
        continue;
      ++all;
      if (point.label == scan::PointClass::ground) {
        ++seen.ground;
        continue;
      }
      const int tenth = std::clamp(static_cast<int>(10 * point.z / height_m), 0, 9);
      ++seen.plants[tenth];
      ++plants;
      if (point.label != scan::PointClass::other) continue;
      ++seen.marked[tenth];
      ++marked;
    }
  };
  simulate(Scene(content), sensor, {.fired = plan, .placed = plan},
           {.range_noise_m = 0, .seed = 1, .threads = 2}, take);
  seen.ground /= all;
  for (int i = 0; i < 10; ++i) {
    seen.plants[i] /= plants;
    seen.marked[i] /= std::max(1.0, marked);
  }
  std::printf("%s: ground %.3f; plants", stand.crop, seen.ground);
  for (const double share : seen.plants) std::printf(" %.3f", share);
  std::printf("; %s", material.c_str());
  for (const double share : seen.marked) std::printf(" %.3f", share);
  std::printf("\n");
  return seen;
}

double sum(const Profile& profile, int begin, int end) {
  return std::accumulate(profile.begin() + begin, profile.begin() + end, 0.0);
}

INSTANTIATE_TEST_SUITE_P(Crops, CanopyOf, ::testing::Values(kSoybean, kWheat, kMaize),
                         [](const auto& tested) { return tested.param.crop; });

// A closed layer of leaves on top, little seen below it.
TEST(Canopy, SoybeanIsALayerOfLeaves) {
  const Seen seen = scanned(kSoybean, "leaf");
  const auto top = std::max_element(seen.plants.begin(), seen.plants.end());
  EXPECT_GE(top - seen.plants.begin(), 5);
  EXPECT_GT(sum(seen.plants, 5, 10), 0.7);
  EXPECT_LT(sum(seen.plants, 0, 2), 0.05);
  EXPECT_GT(sum(seen.marked, 5, 10), 0.7);
}

// Ears stand above the leaves.
TEST(Canopy, WheatBearsItsEarsOnTop) {
  const Seen ears = scanned(kWheat, "ear");
  const Seen leaves = scanned(kWheat, "leaf");
  EXPECT_GT(sum(ears.marked, 8, 10), 0.5);
  EXPECT_LT(sum(leaves.marked, 9, 10), 0.1);
  EXPECT_GT(sum(ears.marked, 7, 10), 2 * sum(leaves.marked, 7, 10));
}

// Open rows: every layer down to the ground is seen.
TEST(Canopy, MaizeIsSeenDownToTheGround) {
  const Seen seen = scanned(kMaize, "leaf");
  EXPECT_GT(seen.ground, 0.05);
  for (int tenth = 1; tenth < 10; ++tenth) EXPECT_GT(seen.plants[tenth], 0.005) << tenth;
}

}  // namespace
}  // namespace plotscan::lidar
