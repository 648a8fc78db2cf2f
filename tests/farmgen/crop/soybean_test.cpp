// SPDX-License-Identifier: Apache-2.0
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "crop/grow.h"
#include "mesh/measure.h"
#include "mesh/mesh_import.h"
#include "temporary_folder.h"

namespace plotscan::crop {
namespace {

namespace fs = std::filesystem;
using mesh::Mesh;
using mesh::mesh_height;
using plotscan::testing::message_of;
using ::testing::HasSubstr;

fs::path models_folder() { return fs::path(PLOTSCAN_SOURCE_DIR) / "models" / "soybean"; }

Mesh soybean(std::uint64_t seed, const std::string& stage = "",
             const std::vector<std::string>& assignments = {}) {
  return grow({.crop = "soybean", .stage = stage, .assignments = assignments}, seed);
}

// The triangles of one material.
std::size_t triangles_of(const Mesh& mesh, const std::string& material) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    count += mesh.materials[mesh.material_of(i)].name == material ? 1 : 0;
  }
  return count;
}

// models_test.cpp remakes them; worlds/ and the suites count on small files and on heights about
// 0.7 m.
TEST(Soybean, TheShippedModelsAreSmallAndOfMiddleHeight) {
  for (int number = 1; number <= 5; ++number) {
    const fs::path file = models_folder() / ("soybean_" + std::to_string(number) + ".obj");
    EXPECT_LT(fs::file_size(file), 200'000u);
    const double height_m = mesh_height(mesh::import_mesh(file));
    EXPECT_GT(height_m, 0.6);
    EXPECT_LT(height_m, 0.85);
  }
}

TEST(Soybean, ParametersDoWhatTheySay) {
  const auto height = [](const std::string& assignment) {
    return mesh_height(soybean(3, "", {assignment, "variation=0", "nodes_variation=0"}));
  };
  // The stem makes most of the height: about 10 internodes of it are not far from the longest.
  EXPECT_GT(height("internode_m=0.1") - height("internode_m=0.05"), 0.05 * 13 * 0.6);
  EXPECT_GT(height("nodes=20"), height("nodes=10"));
  const auto area = [](const std::string& assignment) {
    return mesh::ScaledArea::of_leaves(soybean(3, "", {assignment, "unifoliolate_m=0.01"})).at();
  };
  // Leaves grow with the square of their length.
  EXPECT_NEAR(area("leaflet_length_m=0.2") / area("leaflet_length_m=0.1"), 4, 0.01);
  EXPECT_GT(area("branches=5"), area("branches=0"));
  EXPECT_LT(area("shed_nodes=8"), area("shed_nodes=0"));
}

// Wiersma and Bailey (1975): a trifoliolate leaf has about 2.0 times length times width of its
// terminal leaflet.
TEST(Soybean, LeafletsMaySitOnThePetiole) {
  const Mesh mesh = soybean(3, "R3", {"rachis_share=0"});
  for (const Eigen::Vector3f& vertex : mesh.vertices) ASSERT_TRUE(vertex.allFinite());
}

TEST(Soybean, ATrifoliolateLeafHasThePublishedArea) {
  const std::vector<std::string> one_leaf = {"nodes=2",
                                             "unfolding_leaves=0",
                                             "shed_nodes=1",
                                             "branches=0",
                                             "variation=0",
                                             "plant_variation=0",
                                             "leaflet_length_m=0.1",
                                             "leaflet_low_share=1",
                                             "leaflet_width_ratio=0.6"};
  const double area_m2 = mesh::ScaledArea::of_leaves(soybean(1, "V2", one_leaf)).at();
  EXPECT_NEAR(area_m2 / (0.1 * 0.06), 2.0, 0.2);
}

// The same nodes, counted by their leaflets: each has as many triangles as the others.
TEST(Soybean, AStageHasItsNodesLeavesAndOrgans) {
  const auto leaflets = [](const Mesh& mesh) { return triangles_of(mesh, "leaf") / 16.0; };
  const std::vector<std::string> full_grown = {"unfolding_leaves=0", "branches=0"};
  EXPECT_EQ(leaflets(soybean(1, "V2", full_grown)), 2 + 3) << "unifoliolate pair, one trifoliolate";
  EXPECT_EQ(leaflets(soybean(1, "V6", full_grown)), 2 + 5 * 3);
  EXPECT_EQ(leaflets(soybean(1, "V6", {"branches=0"})), 2 + 7 * 3) << "two are unfolding";
  EXPECT_GT(triangles_of(soybean(1, "V2"), "cotyledon"), 0u);
  EXPECT_EQ(triangles_of(soybean(1, "V4"), "cotyledon"), 0u);
  EXPECT_EQ(triangles_of(soybean(1, "V6"), "flower"), 0u);
  EXPECT_GT(triangles_of(soybean(1, "R2"), "flower"), 0u);
  EXPECT_EQ(triangles_of(soybean(1, "R2"), "pod"), 0u);
  EXPECT_GT(triangles_of(soybean(1, "R4"), "pod"), 0u);
  EXPECT_GT(triangles_of(soybean(1, "R6"), "pod"), triangles_of(soybean(1, "R3"), "pod"));
  EXPECT_GT(triangles_of(soybean(1, "R6"), "old_leaf"), 0u);
}

TEST(Soybean, RefusesWhatItDoesNotKnow) {
  const auto message = [](const GrowOptions& options) {
    return message_of<InputError>([&] { grow(options, 1); });
  };
  EXPECT_THAT(message({.crop = "triffid"}), HasSubstr("crop triffid is not known; known are soyb"));
  EXPECT_THAT(message({.crop = "soybean", .stage = "R9"}), HasSubstr("which are V2, V4, V6, R1"));
  EXPECT_THAT(message({.crop = "soybean", .assignments = {"nodes=99"}}),
              HasSubstr("--set nodes=99: nodes is to be a whole number in [1, 30]"));
  EXPECT_THAT(message({.crop = "soybean", .cultivar_file = "none.yaml"}), HasSubstr("none.yaml"));
}

}  // namespace
}  // namespace plotscan::crop
