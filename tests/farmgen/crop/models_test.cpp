// SPDX-License-Identifier: Apache-2.0
// The meshes that ship in models/CROP, where some do, against their description.yaml.
#include <algorithm>
#include <filesystem>

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include "core/error.h"
#include "crop/grow.h"
#include "mesh/measure.h"
#include "mesh/mesh_import.h"
#include "mesh/obj.h"
#include "temporary_folder.h"

namespace plotscan::crop {
namespace {

namespace fs = std::filesystem;
using plotscan::testing::TemporaryFolder;

constexpr std::size_t kMostBytes = 300'000;

fs::path folder_of(const std::string& crop) {
  return fs::path(PLOTSCAN_SOURCE_DIR) / "models" / crop;
}

std::vector<std::string> crops_with_meshes() {
  std::vector<std::string> with = crops();
  std::erase_if(with,
                [](const auto& crop) { return !fs::exists(folder_of(crop) / "description.yaml"); });
  return with;
}

class ShippedModels : public ::testing::TestWithParam<std::string> {
 protected:
  static fs::path folder() { return folder_of(GetParam()); }
  static YAML::Node description() {
    return YAML::LoadFile((folder() / "description.yaml").string());
  }
};

TEST_P(ShippedModels, AreMadeAgainByteForByte) {
  const TemporaryFolder made;
  EXPECT_EQ(description()["licence"].as<std::string>(), "Apache-2.0");
  ASSERT_EQ(description()["models"].size(), 5u);
  for (const auto& model : description()["models"]) {
    GrowOptions options;
    options.crop = GetParam();
    options.stage = model["stage"].as<std::string>();
    options.assignments = model["set"].as<std::vector<std::string>>();
    for (const auto* key : {"file", "light"}) {
      options.textured = std::string(key) == "light";
      options.detail = options.textured ? Detail::light : Detail::scan;
      const auto file = model[key].as<std::string>();
      mesh::write_obj(made.path() / file, grow(options, model["seed"].as<std::uint64_t>()));
    }
  }
  std::size_t pictures = 0;
  for (const fs::directory_entry& each : fs::directory_iterator(made.path())) {
    const fs::path name = each.path().filename();
    EXPECT_TRUE(read_text(each.path()) == read_text(folder() / name)) << name;
    if (name.extension() == ".png") ++pictures;
  }
  EXPECT_GE(pictures, 3u);
}

TEST_P(ShippedModels, AreAsTheirDescriptionSays) {
  ASSERT_GT(description()["models"].size(), 0u);
  for (const auto& model : description()["models"]) {
    const fs::path file = folder() / model["file"].as<std::string>();
    const mesh::Mesh mesh = mesh::import_mesh(file);
    const mesh::Mesh light = mesh::import_mesh(folder() / model["light"].as<std::string>());
    const double height_m = mesh::mesh_height(mesh);
    const double leaf_area_m2 = mesh::ScaledArea::of_leaves(mesh).at();
    EXPECT_NEAR(model["height_m"].as<double>(), height_m, 1e-5) << file;
    EXPECT_NEAR(model["leaf_area_m2"].as<double>(), leaf_area_m2, 1e-4) << file;
    EXPECT_EQ(model["triangles"].as<std::size_t>(), mesh.triangles.size()) << file;
    EXPECT_EQ(model["light_triangles"].as<std::size_t>(), light.triangles.size()) << file;
    EXPECT_NEAR(mesh::mesh_height(light), height_m, 0.05 * height_m) << file;
    EXPECT_NEAR(mesh::ScaledArea::of_leaves(light).at(), leaf_area_m2, 0.15 * leaf_area_m2) << file;
    EXPECT_LT(fs::file_size(file), kMostBytes) << file;
  }
}

TEST_P(ShippedModels, StandWithinThePublishedHeights) {
  ASSERT_EQ(description()["models"].size(), 5u);
  for (const auto& model : description()["models"]) {
    const Range published =
        stage_facts(GetParam(), model["stage"].as<std::string>()).stage.height_m;
    EXPECT_TRUE(published.contains(model["height_m"].as<double>())) << published.text();
  }
}

INSTANTIATE_TEST_SUITE_P(Crops, ShippedModels, ::testing::ValuesIn(crops_with_meshes()),
                         [](const auto& each) { return each.param; });

}  // namespace
}  // namespace plotscan::crop
