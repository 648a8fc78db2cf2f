// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>

#include <gtest/gtest.h>
#include <sdf/Geometry.hh>
#include <sdf/Link.hh>
#include <sdf/Mesh.hh>
#include <sdf/Model.hh>
#include <sdf/Root.hh>
#include <sdf/Visual.hh>
#include <sdf/World.hh>

#include "../example_farm.h"
#include "core/error.h"
#include "description/load_description.h"
#include "farmfolder/write_farm.h"
#include "mesh/mesh_import.h"
#include "planting/generate.h"

namespace plotscan::farmfolder {
namespace {

namespace fs = std::filesystem;
using plotscan::testing::TemporaryFolder;

farm::Farm write_leaning_farm(const TemporaryFolder& folder) {
  farm::Farm farm =
      planting::generate(description::load_description(write_leaning_example(folder)), 5);
  write_farm(farm, folder.path() / "farm", {.command = "test"});
  return farm;
}

// Loads with libsdformat, which finds model:// below models/, and without any error.
void load(const fs::path& folder, const fs::path& file, sdf::Root& root) {
  sdf::ParserConfig config;
  config.AddURIPath("model://", (folder / "models").string());
  for (const sdf::Error& error : root.Load((folder / file).string(), config)) {
    ADD_FAILURE() << error.Message();
  }
}

void expect_placed(const sdf::Visual& visual, const farm::Farm& farm, const farm::Plant& plant,
                   const fs::path& folder) {
  const auto& pose = visual.RawPose();
  const Eigen::Vector3d position(pose.Pos().X(), pose.Pos().Y(), pose.Pos().Z());
  EXPECT_EQ(position, plant.position) << visual.Name();
  const Eigen::Quaterniond rotation(pose.Rot().W(), pose.Rot().X(), pose.Rot().Y(), pose.Rot().Z());
  EXPECT_LT(rotation.angularDistance(plant.rotation), 1e-6) << visual.Name();
  const sdf::Mesh* mesh = visual.Geom()->MeshShape();
  ASSERT_NE(mesh, nullptr);
  EXPECT_EQ(Eigen::Vector3d(mesh->Scale().X(), mesh->Scale().Y(), mesh->Scale().Z()), plant.scale);
  const fs::path file = folder / mesh->Uri();
  ASSERT_TRUE(fs::exists(file)) << file << " is relative to the world";
  EXPECT_EQ(mesh::import_mesh(file).vertices.size(), farm.models[plant.model].mesh.vertices.size());
}

TEST(World, LibsdformatFindsEveryPlantWhereItStands) {
  const TemporaryFolder folder;
  const farm::Farm farm = write_leaning_farm(folder);
  sdf::Root root;
  load(folder.path() / "farm", "world.sdf", root);
  ASSERT_EQ(root.WorldCount(), 1u);
  const sdf::World& world = *root.WorldByIndex(0);
  EXPECT_EQ(world.Name(), "leaning");
  EXPECT_EQ(world.LightCount(), 1u);
  const sdf::Model* terrain = world.ModelByName("terrain");
  ASSERT_NE(terrain, nullptr);
  EXPECT_EQ(terrain->LinkByIndex(0)->CollisionCount(), 1u);
  std::map<std::string, const sdf::Visual*> visuals;
  for (std::uint64_t i = 0; i < world.ModelCount(); ++i) {
    const sdf::Model& model = *world.ModelByIndex(i);
    EXPECT_TRUE(model.Static()) << model.Name();
    EXPECT_EQ(model.RawPose(), ignition::math::Pose3d::Zero) << "visuals are in the world's frame";
    const sdf::Link& link = *model.LinkByIndex(0);
    for (std::uint64_t k = 0; k < link.VisualCount(); ++k) {
      visuals[model.Name() + "/" + link.VisualByIndex(k)->Name()] = link.VisualByIndex(k);
    }
  }
  ASSERT_EQ(visuals.size(), farm.plants.size() + 1) << "the plants and the terrain";
  for (const farm::Plant& plant : farm.plants) {
    const std::string model =
        plant.plot == 0 ? "plants_outside_plots" : "plot_" + std::to_string(plant.plot);
    const auto visual = visuals.find(model + "/plant_" + std::to_string(plant.id));
    ASSERT_NE(visual, visuals.end()) << plant.id;
    expect_placed(*visual->second, farm, plant, folder.path() / "farm");
  }
}

TEST(World, EveryModelLoadsOnItsOwn) {
  const TemporaryFolder folder;
  write_leaning_farm(folder);
  for (const char* name : {"soybean_1", "soybean_2", "terrain"}) {
    const fs::path model = fs::path("models") / name;
    EXPECT_NE(read_text(folder.path() / "farm" / model / "model.config")
                  .find("<sdf version=\"1.6\">model.sdf</sdf>"),
              std::string::npos)
        << name;
    sdf::Root root;
    load(folder.path() / "farm", model / "model.sdf", root);
    ASSERT_NE(root.Model(), nullptr) << name;
    EXPECT_EQ(root.Model()->Name(), name);
    const sdf::Visual& visual = *root.Model()->LinkByIndex(0)->VisualByIndex(0);
    const std::string prefix = "model://";
    const std::string uri = visual.Geom()->MeshShape()->Uri();
    ASSERT_TRUE(uri.starts_with(prefix)) << uri;
    EXPECT_TRUE(fs::exists(folder.path() / "farm/models" / uri.substr(prefix.size()))) << uri;
  }
}

TEST(World, IgnitionFindsNothingToComplainAbout) {
  if (std::system("command -v ign >/dev/null 2>&1") != 0) GTEST_SKIP() << "ign is absent";
  const TemporaryFolder folder;
  write_leaning_farm(folder);
  const std::string output = (folder.path() / "output.txt").string();
  const std::string check = "ign sdf --check " + (folder.path() / "farm/world.sdf").string() +
                            " >" + output + " 2>" + output + ".err";
  EXPECT_EQ(std::system(check.c_str()), 0);
  EXPECT_EQ(read_text(output), "Valid.\n") << read_text(output + ".err");
}

}  // namespace
}  // namespace plotscan::farmfolder
