// SPDX-License-Identifier: Apache-2.0
#include "crop/soybean.h"

#include <algorithm>
#include <filesystem>

#include "mesh/measure.h"
#include "mesh/mesh_import.h"
#include "mesh/obj.h"
#include "temporary_folder.h"
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include "core/error.h"

namespace plotscan::crop {
namespace {

namespace fs = std::filesystem;
using mesh::import_mesh;
using mesh::Mesh;
using mesh::mesh_height;
using mesh::write_obj;
using plotscan::testing::message_of;
using plotscan::testing::TemporaryFolder;
using ::testing::HasSubstr;

fs::path models_folder() { return fs::path(PLOTSCAN_SOURCE_DIR) / "models" / "soybean"; }

TEST(Soybean, TheShippedModelsAreMadeAgainByteForByte) {
  const TemporaryFolder folder;
  const YAML::Node description = YAML::LoadFile((models_folder() / "description.yaml").string());
  EXPECT_EQ(description["licence"].as<std::string>(), "Apache-2.0");
  ASSERT_EQ(description["models"].size(), 5u);
  for (const auto& model : description["models"]) {
    const auto file = model["file"].as<std::string>();
    const Mesh mesh = soybean(soybean_options(model["set"].as<std::vector<std::string>>()),
                              model["seed"].as<std::uint64_t>());
    write_obj(folder.path() / file, mesh);
    EXPECT_EQ(read_text(folder.path() / file), read_text(models_folder() / file)) << file;
  }
}

TEST(Soybean, TheShippedModelsAreAsTheirDescriptionSays) {
  const YAML::Node description = YAML::LoadFile((models_folder() / "description.yaml").string());
  for (const auto& model : description["models"]) {
    const fs::path file = models_folder() / model["file"].as<std::string>();
    const Mesh mesh = import_mesh(file);
    const double height_m = mesh_height(mesh);
    EXPECT_NEAR(model["height_m"].as<double>(), height_m, 1e-5) << file;
    EXPECT_NEAR(model["area_m2"].as<double>(), mesh::ScaledArea(mesh).at(Eigen::Vector3d::Ones()),
                1e-4);
    EXPECT_EQ(model["triangles"].as<std::size_t>(), mesh.triangles.size());
    EXPECT_LE(mesh.triangles.size(), 4000u);
    EXPECT_LT(fs::file_size(file), 200'000u);
    EXPECT_GT(height_m, 0.6);
    EXPECT_LT(height_m, 0.85);
    const auto below = [](const auto& a, const auto& b) { return a.z() < b.z(); };
    EXPECT_EQ(std::min_element(mesh.vertices.begin(), mesh.vertices.end(), below)->z(), 0.0F)
        << "the foot is on the ground and no leaf is below it";
  }
}

TEST(Soybean, ParametersDoWhatTheySay) {
  const auto height = [](const std::string& assignment) {
    return mesh_height(soybean(soybean_options({assignment, "variation=0"}), 3));
  };
  // Internodes shrink and grow in proportion, and the stem makes most of the height.
  EXPECT_GT(height("internode_m=0.1") - height("internode_m=0.05"), 0.05 * 13 * 0.6);
  EXPECT_GT(height("nodes=20"), height("nodes=10"));
  const auto area = [](const std::string& assignment) {
    return mesh::ScaledArea(soybean(soybean_options({assignment}), 3)).at(Eigen::Vector3d::Ones());
  };
  // Stems keep their area, leaves grow with the square of their length.
  const double first_step = area("leaflet_length_m=0.2") - area("leaflet_length_m=0.1");
  const double second_step = area("leaflet_length_m=0.3") - area("leaflet_length_m=0.2");
  EXPECT_NEAR(first_step / second_step, (4.0 - 1) / (9 - 4), 1e-3);
  EXPECT_GT(area("branches=5"), area("branches=0"));
  EXPECT_NE(soybean({}, 1).vertices, soybean({}, 2).vertices);
}

TEST(Soybean, RefusesParametersOutOfRange) {
  const auto message = [](const std::string& assignment) {
    return message_of<InputError>([&] { soybean_options({assignment}); });
  };
  EXPECT_THAT(message("nodes=1e9"),
              HasSubstr("--set nodes=1e9: nodes is to be a whole number in [3, 30]"));
  EXPECT_THAT(message("nodes=4.5"), HasSubstr("whole number"));
  EXPECT_THAT(message("petiole_m=nan"), HasSubstr("petiole_m is to be a number in [0.01, 0.5]"));
  EXPECT_THAT(message("petiole_m="), HasSubstr("petiole_m is to be a number"));
  EXPECT_THAT(message("petiole_m"), HasSubstr("petiole_m is to be a number"));
  EXPECT_THAT(message("petal=1"), HasSubstr("petal is not a known key; known are nodes, "));
}

}  // namespace
}  // namespace plotscan::crop
