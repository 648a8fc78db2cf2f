// SPDX-License-Identifier: Apache-2.0
// Worlds written by hand against vertices worked out by hand.
#include "gazebo/read_world.h"

#include <cstdlib>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "mesh/mesh_import.h"
#include "read_world_fixture.h"
#include "world_text.h"

namespace plotscan::gazebo {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::model_text;
using testing::two_objects_obj;
using testing::visual_text;
using testing::world_text;
using testing::world_vertices;

void expect_vertices(const StaticWorld& world, std::size_t surface,
                     const std::vector<Eigen::Vector3d>& expected) {
  const auto found = world_vertices(world, world.surfaces.at(surface));
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_LT((found[i] - expected[i]).norm(), 1e-6)
        << "vertex " << i << " is " << found[i].transpose() << ", not " << expected[i].transpose();
  }
}

// The model is turned a quarter about z, so that its x is the world's y; the nested model is moved
// along that; the link is rolled a quarter, so that its y is up; the visual is moved along its own
// x; the mesh is scaled.
TEST_F(ReadWorld, NestedPosesAndScalesMultiply) {
  folder_.write("mesh.obj", kTriangle);
  const StaticWorld world = read(
      "<model name='outer'><static>true</static><pose>10 0 0 0 0 1.5707963267948966</pose>"
      "<model name='inner'><pose>2 0 0 0 0 0</pose>"
      "<link name='link'><pose>0 0 1 1.5707963267948966 0 0</pose>"
      "<visual name='v'><pose>3 0 0 0 0 0</pose><geometry>"
      "<mesh><uri>mesh.obj</uri><scale>2 3 4</scale></mesh></geometry></visual>"
      "</link></model></model>");
  ASSERT_EQ(world.surfaces.size(), 1u);
  // Scaled: (0,0,0), (2,0,0), (0,6,12). In the link: x + 3. In the inner model: (x, -z, y + 1). In
  // the outer: x + 2. In the world: (10 - y, x).
  expect_vertices(world, 0, {{10, 5, 1}, {10, 7, 1}, {22, 5, 7}});
  EXPECT_EQ(world.name, "by_hand");
}

TEST_F(ReadWorld, PosesRelativeToFramesAreResolved) {
  folder_.write("mesh.obj", kTriangle);
  const StaticWorld world = read(
      "<frame name='corner'><pose>0 0 5 0 0 0</pose></frame>"
      "<model name='first'><static>true</static><pose relative_to='corner'>1 0 0 0 0 0</pose>"
      "<link name='link'/><frame name='mark'><pose>0 7 0 0 0 0</pose></frame></model>"
      "<model name='second'><static>true</static>"
      "<pose relative_to='first::mark'>0 0 1 0 0 0</pose>"
      "<frame name='arm' attached_to='link'><pose>0 0 0 0 0 3.141592653589793</pose></frame>"
      "<link name='link'>"
      "<visual name='v'><pose relative_to='arm'>1 0 0 0 0 0</pose><geometry>" +
      kMesh + "</geometry></visual></link></model>");
  // second's origin: corner (0,0,5), first (1,0,5), mark (1,7,5), up 1. arm turns about it.
  expect_vertices(world, 0, {{0, 7, 6}, {-1, 7, 6}, {0, 5, 9}});
}

TEST_F(ReadWorld, PlacementFrameIsWhatThePosePlaces) {
  folder_.write("mesh.obj", kTriangle);
  const StaticWorld world = read(
      "<model name='m' placement_frame='top'><static>true</static><pose>4 0 0 0 0 0</pose>"
      "<link name='link'>" +
      visual_text(kMesh) + "</link><frame name='top'><pose>0 0 3 0 0 0</pose></frame></model>");
  expect_vertices(world, 0, {{4, 0, -3}, {5, 0, -3}, {4, 2, 0}});
}

TEST_F(ReadWorld, IncludesAreFoundByNameAndByPath) {
  write_model("models/tree", model_text("tree", "0 0 1 0 0 0",
                                        visual_text("<mesh><uri>meshes/mesh.obj</uri></mesh>")));
  folder_.write("models/tree/meshes/mesh.obj", kTriangle);
  write_model("elsewhere/bush",
              "<model name='bush'><static>true</static>"
              "<include><uri>../twig</uri><pose>0 0 2 0 0 0</pose></include>"
              "</model>");
  write_model("elsewhere/twig",
              model_text("twig", "0 0 0 0 0 0",
                         visual_text("<mesh><uri>model://twig/mesh.obj</uri></mesh>")));
  folder_.write("elsewhere/twig/mesh.obj", kTriangle);
  const StaticWorld world = read(
      "<include><uri>model://tree</uri><pose>5 0 0 0 0 0</pose></include>"
      "<include><uri>models/tree/model.sdf</uri><name>second</name></include>"
      "<include><uri>elsewhere/bush</uri><pose>0 9 0 0 0 0</pose></include>"
      "<include><uri>file://" +
      (folder_.path() / "models/tree").string() + "</uri><name>third</name></include>");
  ASSERT_EQ(world.surfaces.size(), 4u);
  expect_vertices(world, 0, {{5, 0, 0}, {6, 0, 0}, {5, 2, 3}});  // the pose replaces the model's
  expect_vertices(world, 1, {{0, 0, 1}, {1, 0, 1}, {0, 2, 4}});
  expect_vertices(world, 2, {{0, 9, 2}, {1, 9, 2}, {0, 11, 5}});
  expect_vertices(world, 3, {{0, 0, 1}, {1, 0, 1}, {0, 2, 4}});
  EXPECT_EQ(world.meshes.size(), 2u) << "each file once";
  EXPECT_EQ(world.files.size(), 6u) << "the world, three models, two meshes";
}

// The same name in two of the folders: the one that comes first in the order counts.
TEST_F(ReadWorld, ResourcePathsComeBeforeTheWorldsFolderAndTheEnvironment) {
  const auto model_at = [&](const std::string& folder, int height) {
    write_model(folder + "/post", model_text("post", "0 0 " + std::to_string(height) + " 0 0 0",
                                             visual_text("<box><size>1 1 1</size></box>")));
  };
  const auto height = [&](const ReadWorldOptions& options) {
    const StaticWorld world = read("<include><uri>model://post</uri></include>", options);
    return world.surfaces.at(0).world_from_mesh.translation().z();
  };
  model_at("environment", 1);
  const std::string environment =
      (folder_.path() / "absent").string() + ":" + (folder_.path() / "environment").string();
  for (const char* variable :
       {"SDF_PATH", "GZ_SIM_RESOURCE_PATH", "IGN_GAZEBO_RESOURCE_PATH", "GAZEBO_MODEL_PATH"}) {
    EXPECT_THROW(height({}), InputError) << variable;
    setenv(variable, environment.c_str(), 1);
    EXPECT_EQ(height({}), 1) << variable;
    unsetenv(variable);
  }
  setenv("GZ_SIM_RESOURCE_PATH", environment.c_str(), 1);
  model_at("models", 2);
  EXPECT_EQ(height({}), 2);
  model_at("given", 3);
  EXPECT_EQ(height({.resource_paths = {folder_.path() / "given"}}), 3);
  unsetenv("GZ_SIM_RESOURCE_PATH");
}

TEST_F(ReadWorld, ModelFilesAreReadOnTheirOwn) {
  write_model("tree", model_text("tree", "1 2 3 0 0 0",
                                 visual_text("<mesh><uri>model://tree/mesh.obj</uri></mesh>")));
  folder_.write("tree/mesh.obj", kTriangle);
  const StaticWorld world = read_world(folder_.path() / "tree/model.sdf");
  EXPECT_EQ(world.name, "tree");
  expect_vertices(world, 0, {{1, 2, 3}, {2, 2, 3}, {1, 4, 6}});
}

TEST_F(ReadWorld, SubmeshesAreOneObjectOfAFile) {
  folder_.write("mesh.obj", two_objects_obj());
  const auto mesh = [](const std::string& more) {
    return "<mesh><uri>mesh.obj</uri>" + more + "</mesh>";
  };
  const StaticWorld world = read(model_text(
      "m", "0 0 0 0 0 0",
      visual_text(mesh(""), "", "all") +
          visual_text(mesh("<submesh><name>far</name></submesh>"), "", "far") +
          visual_text(mesh("<submesh><name>far</name><center>true</center></submesh>"), "", "c")));
  EXPECT_EQ(world.meshes.at(world.surfaces.at(0).mesh).triangles.size(), 2u);
  expect_vertices(world, 1, {{10, 0, 0}, {12, 0, 0}, {10, 4, 6}});
  expect_vertices(world, 2, {{-1, -2, -3}, {1, -2, -3}, {-1, 2, 3}});
  EXPECT_THAT(refusal(model_text("m", "0 0 0 0 0 0",
                                 visual_text(mesh("<submesh><name>none</name></submesh>")))),
              AllOf(HasSubstr("mesh.obj"), HasSubstr("object none")));
}

TEST_F(ReadWorld, ClassesComeFromLaserRetroElseFromNames) {
  const std::string box = "<box><size>1 1 1</size></box>";
  const auto kind = [&](const std::string& model, const std::string& more,
                        const std::string& shape) {
    return read(model_text(model, "0 0 0 0 0 0", visual_text(shape, more))).surfaces.at(0).kind;
  };
  const auto retro = [](const std::string& value) {
    return "<laser_retro>" + value + "</laser_retro>";
  };
  EXPECT_EQ(kind("a", retro("1"), box), farm::SurfaceClass::ground);
  EXPECT_EQ(kind("a", retro("2"), box), farm::SurfaceClass::crop);
  EXPECT_EQ(kind("a", retro("3"), box), farm::SurfaceClass::weed);
  EXPECT_EQ(kind("terrain", retro("4"), box), farm::SurfaceClass::other);
  EXPECT_EQ(kind("a", retro("2000"), box), farm::SurfaceClass::other);
  EXPECT_EQ(kind("a", "", box), farm::SurfaceClass::other);
  EXPECT_EQ(kind("a", "", "<plane><size>2 2</size></plane>"), farm::SurfaceClass::ground);
  EXPECT_EQ(kind("ground_plane", "", box), farm::SurfaceClass::ground);
  EXPECT_EQ(kind("terrain", "", box), farm::SurfaceClass::ground);
  EXPECT_EQ(kind("plot_12", "", box), farm::SurfaceClass::crop);
  EXPECT_EQ(kind("plot_12_weeds", "", box), farm::SurfaceClass::weed);
}

TEST_F(ReadWorld, PlotsAndPlantsComeFromTheNearestName) {
  const std::string box = "<box><size>1 1 1</size></box>";
  const StaticWorld world =
      read(model_text("plot_12", "0 0 0 0 0 0", visual_text(box, "", "plant_345")) +
           "<model name='row_3'><static>true</static><link name='plot_7'>" + visual_text(box) +
           "</link></model>" + model_text("plot_2_plant_9", "0 0 0 0 0 0", visual_text(box)) +
           model_text("post", "0 0 0 0 0 0", visual_text(box)));
  std::vector<std::pair<std::uint32_t, std::uint32_t>> found;
  for (const PlacedSurface& surface : world.surfaces)
    found.emplace_back(surface.plot, surface.plant);
  EXPECT_THAT(found,
              ElementsAre(std::pair(12, 345), std::pair(7, 0), std::pair(2, 9), std::pair(0, 0)));
}

// As Gazebo's gpu_lidar: see-through looks are seen, visibility_flags 0 is not; collisions are not
// looked at.
TEST_F(ReadWorld, TakesWhatALidarOfGazeboSees) {
  const std::string box = "<box><size>1 1 1</size></box>";
  const StaticWorld world =
      read(model_text("m", "0 0 0 0 0 0",
                      visual_text(box, "<transparency>1</transparency>", "glass") +
                          visual_text(box, "<visibility_flags>0</visibility_flags>", "hidden") +
                          "<collision name='c'><geometry>" + box + "</geometry></collision>") +
           "<model name='ball'><link name='link'>" + visual_text(box) +
           "</link></model><light type='point' name='lamp'/>"
           "<actor name='walker'><skin><filename>walk.dae</filename></skin></actor>");
  EXPECT_EQ(world.surfaces.size(), 2u);
  EXPECT_THAT(world.notes, ElementsAre("1 actor(s) left out", "1 light(s) left out",
                                       "1 model(s) that may move taken as they stand at the start",
                                       "1 visual(s) with visibility_flags 0 left out"));
}

// The drone of an exported world, or a robot, would scan itself and stand in the flight's way.
TEST_F(ReadWorld, LeavesOutWhatCarriesALidar) {
  const std::string box = visual_text("<box><size>1 1 1</size></box>");
  for (const std::string type : {"gpu_lidar", "lidar", "ray", "gpu_ray"}) {
    const std::string element = type.ends_with("ray") ? "ray" : "lidar";
    const StaticWorld world =
        read(model_text("post", "0 0 0 0 0 0", box) +
             "<model name='drone'><static>true</static><link name='body'>" + box +
             "</link><model name='head'><link name='link'>" + box + "<sensor name='s' type='" +
             type + "'><" + element +
             "><scan><horizontal><samples>8</samples><min_angle>0</min_angle>"
             "<max_angle>1</max_angle></horizontal></scan><range><min>0.1</min><max>9</max></range>"
             "</" +
             element + "></sensor></link></model></model>");
    EXPECT_EQ(world.surfaces.size(), 1u) << type;
    EXPECT_THAT(world.notes, ElementsAre("1 model(s) with a lidar left out")) << type;
  }
}

// The bean, a quarter of its size, twice; the maize lying down.
TEST_F(ReadWorld, ThirdPartyModelsStandAtTheirScale) {
  const fs::path plants = fs::path(PLOTSCAN_SHARED_DATA_DIR) / "plants/cropcraft";
  if (!fs::exists(plants)) GTEST_SKIP() << plants << " is absent";
  const auto mesh = [&](const std::string& file, const std::string& scale) {
    return visual_text("<mesh><uri>" + file + "</uri><scale>" + scale + "</scale></mesh>");
  };
  const StaticWorld world =
      read(model_text("bean", "1 2 3 0 0 0", mesh("model://bean/bean_big.obj", "0.25 0.25 0.25")) +
               model_text("bean_2", "0 0 0 0 0 0", mesh("model://bean/bean_big.obj", "1 1 2")) +
               model_text("maize", "0 0 0 1.5707963267948966 0 0",
                          mesh("model://maize/maize_big_1.obj", "1 1 1")),
           {.resource_paths = {plants}});
  ASSERT_EQ(world.surfaces.size(), 3u);
  EXPECT_EQ(world.meshes.size(), 2u);
  const mesh::Mesh bean = mesh::import_mesh(plants / "bean/bean_big.obj");
  const mesh::Mesh maize = mesh::import_mesh(plants / "maize/maize_big_1.obj");
  std::vector<Eigen::Vector3d> small;
  std::vector<Eigen::Vector3d> tall;
  std::vector<Eigen::Vector3d> lying;
  for (const Eigen::Vector3f& v : bean.vertices) {
    small.emplace_back(1 + 0.25 * v.x(), 2 + 0.25 * v.y(), 3 + 0.25 * v.z());
    tall.emplace_back(v.x(), v.y(), 2.0 * v.z());
  }
  for (const Eigen::Vector3f& v : maize.vertices) lying.emplace_back(v.x(), -v.z(), v.y());
  expect_vertices(world, 0, small);
  expect_vertices(world, 1, tall);
  expect_vertices(world, 2, lying);
}

}  // namespace
}  // namespace plotscan::gazebo
