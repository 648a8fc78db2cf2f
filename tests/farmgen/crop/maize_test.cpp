// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <complex>
#include <map>
#include <numbers>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "crop/grow.h"
#include "farmgen/crop/mesh_parts.h"
#include "mesh/measure.h"

namespace plotscan::crop {
namespace {

using Eigen::Vector3f;
using mesh::Mesh;
using plotscan::testing::axial_mean;
using plotscan::testing::highest;
using plotscan::testing::lowest;
using plotscan::testing::vertices_of;

Mesh maize(const std::string& stage, std::uint64_t seed, std::vector<std::string> assignments = {},
           Detail detail = Detail::scan) {
  return grow({.crop = "maize",
               .stage = stage,
               .assignments = std::move(assignments),
               .detail = detail,
               .cultivar_file = {}},
              seed);
}

TEST(Maize, LeavesStandInOnePlane) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    EXPECT_GT(std::abs(axial_mean(vertices_of(maize("R1", seed, {"lean_deg=0"}), "leaf"))), 0.9)
        << seed;
  }
  const Mesh turned = maize("R1", 1, {"azimuth_spread_deg=90", "lean_deg=0"});
  EXPECT_LT(std::abs(axial_mean(vertices_of(turned, "leaf"))), 0.8);
}

TEST(Maize, PlantsStandInAnyPlane) {
  std::complex<double> sum = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const auto mean = axial_mean(vertices_of(maize("V3", seed), "leaf"));
    sum += mean / std::abs(mean);
  }
  // Of 60 random directions the resultant is below 0.3 with a probability of exp(-60 * 0.09).
  EXPECT_LT(std::abs(sum) / 60, 0.3);
}

// With all leaves below the ear's shed, the lowest one is its own: the ear stands on its side, at
// the foot of its sheath.
TEST(Maize, TheEarStandsInTheAxilOfItsNodesLeaf) {
  const Mesh mesh = maize("R3", 4,
                          {"ear_node_share=0.63", "shed_leaves=11", "dry_leaves=1", "lean_deg=0",
                           "variation=0", "plant_variation=0"});
  const std::vector<Vector3f> ear = vertices_of(mesh, "husk");
  const std::vector<Vector3f> leaf = vertices_of(mesh, "dry");  // leaf 12 = 0.63 * 19
  const auto higher = [](const Vector3f& a, const Vector3f& b) { return a.z() < b.z(); };
  const Vector3f tip = *std::max_element(ear.begin(), ear.end(), higher);
  const Vector3f collar = leaf.front();
  Vector3f middle = Vector3f::Zero();
  for (const Vector3f& vertex : leaf) middle += vertex;
  EXPECT_GT(tip.head<2>().normalized().dot(middle.head<2>().normalized()), 0.95);
  EXPECT_GT(collar.z() - lowest(ear), 0.1);
  EXPECT_LT(collar.z() - lowest(ear), 0.2);
  const Mesh upper = maize("R3", 4, {"ear_node_share=0.737", "lean_deg=0", "variation=0"});
  EXPECT_GT(lowest(vertices_of(upper, "husk")), lowest(ear) + 0.2) << "two internodes higher";
}

TEST(Maize, TasselFromTasselingEarAndSilksFromSilking) {
  const std::map<std::string, std::pair<bool, bool>> tassel_and_ear = {
      {"V3", {false, false}}, {"V6", {false, false}}, {"V10", {false, false}},
      {"VT", {true, false}},  {"R1", {true, true}},   {"R3", {true, true}},
      {"R5", {true, true}}};
  ASSERT_EQ(stages("maize").size(), tassel_and_ear.size());
  for (const std::string& stage : stages("maize")) {
    for (const Detail detail : {Detail::scan, Detail::light}) {
      const Mesh mesh = maize(stage, 2, {}, detail);
      const auto [tassel, ear] = tassel_and_ear.at(stage);
      EXPECT_EQ(!vertices_of(mesh, "tassel").empty(), tassel) << stage;
      EXPECT_EQ(!vertices_of(mesh, "husk").empty(), ear) << stage;
      EXPECT_EQ(!vertices_of(mesh, "silk").empty(), ear) << stage;
    }
  }
}

TEST(Maize, TheTasselIsTheTop) {
  const Mesh mesh = maize("VT", 3);
  EXPECT_FLOAT_EQ(highest(vertices_of(mesh, "tassel")),
                  static_cast<float>(mesh::mesh_height(mesh)));
}

TEST(Maize, StaysOnItsFootAndWithinItsTriangles) {
  for (const std::string& stage : stages("maize")) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      const Mesh scan = maize(stage, seed);
      EXPECT_LE(scan.triangles.size(), 4000u) << stage;
      EXPECT_LE(maize(stage, seed, {}, Detail::light).triangles.size(), 300u) << stage;
      EXPECT_GT(lowest(scan.vertices), -0.003F) << stage << ": the foot of a leaning stem";
    }
  }
}

TEST(Maize, ParametersDoWhatTheySay) {
  const auto height = [](const std::string& assignment) {
    return mesh::mesh_height(maize("R1", 1, {assignment, "variation=0", "lean_deg=0"}));
  };
  EXPECT_NEAR(height("peduncle_m=0.3") - height("peduncle_m=0.2"), 0.1, 0.01);
  EXPECT_GT(height("internode_m=0.2") - height("internode_m=0.1"), 0.8);
  const auto area = [](const std::string& assignment) {
    return mesh::ScaledArea::of_leaves(maize("R1", 1, {assignment, "undulation_deg=0"})).at();
  };
  EXPECT_NEAR(area("blade_width_m=0.1") / area("blade_width_m=0.05"), 2, 0.05);
  EXPECT_GT(area("shed_leaves=4"), area("shed_leaves=6"));
}

// Its first internode is then the longest.
TEST(Maize, GrowsInternodesThatOnlyGetShorter) {
  const Mesh mesh = maize("R1", 1, {"leaves=10", "longest_internode_share=0.5"});
  for (const Eigen::Vector3f& vertex : mesh.vertices) ASSERT_TRUE(vertex.allFinite());
  EXPECT_GT(mesh::mesh_height(mesh), 0.5);
}

}  // namespace
}  // namespace plotscan::crop
