// SPDX-License-Identifier: Apache-2.0
// Every crop at every stage against what was published of it (its file under models/), and the
// promises of crop/grow.h.
#include <cmath>
#include <cstdlib>
#include <ostream>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "core/angle.h"
#include "crop/grow.h"
#include "mesh/measure.h"

namespace plotscan::crop {
namespace {

using mesh::Mesh;

constexpr std::uint64_t kPlants = 20;
constexpr std::size_t kMostScanTriangles = 4000;
constexpr std::size_t kMostLightTriangles = 300;
constexpr double kGround_m = -0.005;  // a leaf's tip may press into loose soil

struct CropStage {
  std::string crop;
  std::string stage;
};

void PrintTo(const CropStage& each, std::ostream* out) { *out << each.crop << " " << each.stage; }

std::vector<CropStage> all_stages() {
  std::vector<CropStage> all;
  for (const std::string& crop : crops()) {
    for (const std::string& stage : stages(crop)) all.push_back({crop, stage});
  }
  return all;
}

class Agronomy : public ::testing::TestWithParam<CropStage> {
 protected:
  static Mesh plant(std::uint64_t seed, Detail detail = Detail::scan) {
    return grow({.crop = GetParam().crop, .stage = GetParam().stage, .detail = detail}, seed);
  }
  static StageFacts facts() { return stage_facts(GetParam().crop, GetParam().stage); }
};

double leaf_area_m2(const Mesh& mesh) { return mesh::ScaledArea::of_leaves(mesh).at(); }

std::string named(const std::string& what, double value) {
  return what + " " + std::to_string(value);
}

struct Inclination {
  double area_m2 = 0;
  double area_times_deg = 0;

  void add(const Mesh& mesh) {
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      if (mesh.materials[mesh.material_of(i)].name.find("leaf") == std::string::npos) continue;
      const auto& [a, b, c] = mesh.triangles[i];
      const Eigen::Vector3d ab = (mesh.vertices[b] - mesh.vertices[a]).cast<double>();
      const Eigen::Vector3d ac = (mesh.vertices[c] - mesh.vertices[a]).cast<double>();
      const Eigen::Vector3d normal = ab.cross(ac);
      const double area = normal.norm() / 2;
      const double level = std::hypot(normal.x(), normal.y());
      area_m2 += area;
      area_times_deg += area * degrees(std::atan2(level, std::abs(normal.z())));
    }
  }
};

TEST_P(Agronomy, TheDefaultPlotLiesInThePublishedRanges) {
  double height_m = 0;
  double area_m2 = 0;
  Inclination inclination;
  for (std::uint64_t seed = 1; seed <= kPlants; ++seed) {
    const Mesh mesh = plant(seed);
    height_m += mesh::mesh_height(mesh) / kPlants;
    area_m2 += leaf_area_m2(mesh) / kPlants;
    inclination.add(mesh);
  }
  const StageFacts published = facts();
  const double index = area_m2 * published.plants_per_m2;
  const double inclination_deg = inclination.area_times_deg / inclination.area_m2;
  RecordProperty("height_m", std::to_string(height_m));
  RecordProperty("leaf_area_index", std::to_string(index));
  RecordProperty("leaf_inclination_deg", std::to_string(inclination_deg));
  EXPECT_TRUE(published.stage.height_m.contains(height_m))
      << named("height", height_m) << " m, " << published.stage.height_m.text();
  EXPECT_TRUE(published.stage.leaf_area_index.contains(index))
      << named("leaf area index", index) << ", " << published.stage.leaf_area_index.text();
  EXPECT_TRUE(published.stage.leaf_inclination_deg.contains(inclination_deg))
      << named("inclination", inclination_deg) << " deg, "
      << published.stage.leaf_inclination_deg.text();
}

TEST_P(Agronomy, BothDetailsShowTheSamePlantWithinTheirBudgets) {
  for (std::uint64_t seed = 1; seed <= kPlants; ++seed) {
    const Mesh scan = plant(seed);
    const Mesh light = plant(seed, Detail::light);
    EXPECT_LE(scan.triangles.size(), kMostScanTriangles) << seed;
    EXPECT_LE(light.triangles.size(), kMostLightTriangles) << seed;
    const double height_m = mesh::mesh_height(scan);
    EXPECT_NEAR(mesh::mesh_height(light), height_m, 0.05 * height_m) << seed;
    const double area_m2 = leaf_area_m2(scan);
    EXPECT_NEAR(leaf_area_m2(light), area_m2, 0.15 * area_m2) << seed;
  }
}

TEST_P(Agronomy, ThePlantStandsOnTheGround) {
  for (const Detail detail : {Detail::scan, Detail::light}) {
    for (std::uint64_t seed = 1; seed <= kPlants; ++seed) {
      double lowest_m = 1;
      for (const Eigen::Vector3f& vertex : plant(seed, detail).vertices) {
        ASSERT_TRUE(vertex.allFinite());
        lowest_m = std::min(lowest_m, static_cast<double>(vertex.z()));
      }
      EXPECT_GE(lowest_m, kGround_m) << seed;
      EXPECT_LE(lowest_m, 0.005) << seed;
    }
  }
}

TEST_P(Agronomy, TheSeedMakesThePlant) {
  for (const Detail detail : {Detail::scan, Detail::light}) {
    const Mesh first = plant(7, detail);
    const Mesh again = plant(7, detail);
    EXPECT_EQ(first.vertices, again.vertices);
    EXPECT_EQ(first.triangles, again.triangles);
    EXPECT_NE(first.vertices, plant(8, detail).vertices);
  }
}

INSTANTIATE_TEST_SUITE_P(Crops, Agronomy, ::testing::ValuesIn(all_stages()),
                         [](const auto& each) { return each.param.crop + each.param.stage; });

}  // namespace
}  // namespace plotscan::crop
