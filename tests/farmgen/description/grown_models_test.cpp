// SPDX-License-Identifier: Apache-2.0
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../example_farm.h"
#include "core/csv.h"
#include "core/error.h"
#include "crop/grow.h"
#include "description/load_description.h"
#include "farmfolder/read_farm.h"
#include "farmfolder/write_farm.h"
#include "mesh/measure.h"
#include "mesh/obj.h"
#include "planting/generate.h"

namespace plotscan::description {
namespace {

namespace fs = std::filesystem;
using plotscan::testing::message_of;
using plotscan::testing::TemporaryFolder;
using ::testing::HasSubstr;

farm::Farm example(const TemporaryFolder& folder, const std::string& models) {
  return planting::generate(load_description(write_example(folder), {"plants.models=" + models}),
                            1);
}

void write(const TemporaryFolder& folder, const farm::Farm& farm) {
  farmfolder::write_farm(farm, folder.path() / "farm", {.command = "farmgen generate"});
}

TEST(GrownModels, AreWhatTheCropGrows) {
  const TemporaryFolder folder;
  const farm::Farm farm = example(folder, "[{crop: soybean, seed: 5, set: [internode_m=0.05]}]");
  crop::GrowOptions options{.crop = "soybean", .stage = "", .assignments = {"internode_m=0.05"}};
  ASSERT_EQ(farm.models.size(), 1u);
  EXPECT_EQ(farm.models[0].mesh.vertices, crop::grow(options, 5).vertices);
  EXPECT_EQ(farm.models[0].height_m, mesh::mesh_height(farm.models[0].mesh));
  options.detail = crop::Detail::light;
  ASSERT_TRUE(farm.models[0].light);
  EXPECT_EQ(farm.models[0].light->vertices, crop::grow(options, 5).vertices);
  EXPECT_LT(farm.models[0].light->triangles.size(), farm.models[0].mesh.triangles.size());
}

TEST(GrownModels, MistakesOfTheCropNameTheModel) {
  const TemporaryFolder folder;
  EXPECT_THAT(message_of<InputError>(
                  [&] { example(folder, "[{crop: soybean, name: mine, set: [petals=5]}]"); }),
              HasSubstr("example.yaml: model mine: "));
}

TEST(GrownModels, LightMeshesComeBackFromTheFolder) {
  const TemporaryFolder folder;
  const farm::Farm farm =
      example(folder, "[{crop: soybean, name: grown}, {mesh: " +
                          (testing::models_folder() / "soybean_1.obj").string() + "}]");
  EXPECT_FALSE(farm.models[1].light);
  write(folder, farm);
  EXPECT_TRUE(fs::exists(folder.path() / "farm/models/grown/meshes/grown_light.obj"));
  const farm::Farm read = farmfolder::read_farm(folder.path() / "farm");
  ASSERT_TRUE(read.models[0].light);
  EXPECT_FALSE(read.models[1].light);
  EXPECT_EQ(read.models[0].light->triangles.size(), farm.models[0].light->triangles.size());
  EXPECT_NEAR(mesh::mesh_height(*read.models[0].light), mesh::mesh_height(*farm.models[0].light),
              1e-6);
}

TEST(GrownModels, ALightMeshMayBeGivenBesideAMesh) {
  const TemporaryFolder folder;
  const mesh::Mesh light =
      mesh::simplified(mesh::import_mesh(testing::models_folder() / "soybean_1.obj"), 100);
  mesh::write_obj(folder.path() / "light.obj", light);
  const std::string models =
      "[{mesh: " + (testing::models_folder() / "soybean_1.obj").string() + ", light: light.obj}]";
  const planting::FarmDescription description =
      load_description(write_example(folder), {"plants.models=" + models});
  EXPECT_EQ(planting::input_files(description).back(), folder.path() / "light.obj");
  const farm::Farm farm = planting::generate(description, 1);
  ASSERT_TRUE(farm.models[0].light);
  EXPECT_EQ(farm.models[0].light->triangles.size(), light.triangles.size());
}

// Both lie in one folder of the farm.
TEST(GrownModels, AMeshAndItsLightOneKeepTheirTexturesOfOneName) {
  const TemporaryFolder folder;
  const std::string square =
      "mtllib p.mtl\nv 0 0 0\nv 1 0 0\nv 1 0 1\nv 0 0 1\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
      "usemtl leaf\nf 1/1 2/2 3/3 4/4\n";
  const std::string png = "\x89PNG\r\n\x1a\n";  // nothing decodes it
  for (const std::string detail : {"scan", "light"}) {
    fs::create_directory(folder.path() / detail);
    folder.write(detail + "/p.obj", square);
    folder.write(detail + "/p.mtl", "newmtl leaf\nmap_Kd leaf.jpg\n");
    folder.write(detail + "/leaf.jpg", png + detail);
  }
  write(folder, example(folder, "[{mesh: scan/p.obj, light: light/p.obj}]"));
  const farm::Farm read = farmfolder::read_farm(folder.path() / "farm");
  EXPECT_EQ(read.models[0].mesh.materials.at(0).texture->bytes, png + "scan");
  EXPECT_EQ(read.models[0].light->materials.at(0).texture->bytes, png + "light");
}

TEST(GrownModels, AnEditedLightMeshIsRefused) {
  const TemporaryFolder folder;
  write(folder, example(folder, "[{crop: soybean, name: grown}]"));
  const fs::path file = folder.path() / "farm/models/grown/meshes/grown_light.obj";
  std::ofstream(file, std::ios::app) << "# edited\n";
  EXPECT_THAT(message_of<InputError>([&] { farmfolder::read_farm(folder.path() / "farm"); }),
              HasSubstr("grown_light.obj: was changed"));
  fs::remove(file);
  EXPECT_THAT(message_of<InputError>([&] { farmfolder::read_farm(folder.path() / "farm"); }),
              HasSubstr("grown_light.obj"));
}

TEST(TrialLayout, IsATableOfThePlots) {
  const TemporaryFolder folder;
  const farm::Farm farm = planting::generate(
      load_description(write_example(folder), {"plants.cultivars=[{name: A}, {name: B}]",
                                               "plants.design=random", "plots.first_number=11"}),
      1);
  write(folder, farm);
  std::size_t line = 0;
  read_csv(
      folder.path() / "farm/truth/plots.csv",
      {"plot_name", "accession_name", "plot_number", "block_number", "rep_number", "row_number",
       "col_number", "center_x_m", "center_y_m", "width_m", "length_m", "heading_deg"},
      {}, [&](const CsvRow& row) {
        const farm::Plot& plot = farm.plots.at(line++);
        EXPECT_EQ(row.text(0), "example_" + std::to_string(plot.id));
        EXPECT_EQ(row.text(1), plot.accession);
        EXPECT_EQ(row.integer(2, 11, 15), plot.id);
        EXPECT_EQ(row.integer(4, 1, 3), plot.rep);
        EXPECT_EQ(row.integer(5, 1, 2), plot.row);
        EXPECT_EQ(row.integer(6, 1, 3), plot.column);
        EXPECT_EQ(row.number(7), plot.box.center.x());
      });
  EXPECT_EQ(line, 5u);
  const farm::Farm read = farmfolder::read_farm(folder.path() / "farm");
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(read.plots[i].accession, farm.plots[i].accession);
    EXPECT_EQ(read.plots[i].rep, farm.plots[i].rep);
  }
}

}  // namespace
}  // namespace plotscan::description
