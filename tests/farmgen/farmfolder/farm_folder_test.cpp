// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <fstream>
#include <ostream>

#include <assimp/Importer.hpp>
#include <assimp/scene.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../example_farm.h"
#include "core/error.h"
#include "description/load_description.h"
#include "farm/farm.h"
#include "farmfolder/read_farm.h"
#include "farmfolder/write_farm.h"
#include "mesh/alpha_mask.h"
#include "planting/generate.h"
#include "temporary_folder.h"
#include "test_images.h"

namespace plotscan::farmfolder {
namespace {

namespace fs = std::filesystem;
using plotscan::testing::message_of;
using plotscan::testing::TemporaryFolder;
using ::testing::HasSubstr;

void expect_equal(const mesh::Mesh& a, const mesh::Mesh& b) {
  EXPECT_EQ(a.triangles, b.triangles);
  ASSERT_EQ(a.vertices.size(), b.vertices.size());
  for (std::size_t i = 0; i < a.vertices.size(); ++i) {
    EXPECT_LE((a.vertices[i] - b.vertices[i]).norm(), 1e-7F * (1 + a.vertices[i].norm()));
  }
}

void expect_equal(const farm::Plot& a, const farm::Plot& b) {
  EXPECT_EQ(a.id, b.id);
  EXPECT_EQ(a.row, b.row);
  EXPECT_EQ(a.column, b.column);
  EXPECT_EQ(a.rep, b.rep);
  EXPECT_EQ(a.block, b.block);
  EXPECT_EQ(a.accession, b.accession);
  EXPECT_EQ(a.plant_count, b.plant_count);
  EXPECT_EQ(a.missing_plants, b.missing_plants);
  EXPECT_EQ(a.weed_count, b.weed_count);
  EXPECT_DOUBLE_EQ(a.lodging_rad, b.lodging_rad);
  EXPECT_EQ(a.box.center, b.box.center);
  EXPECT_EQ(a.box.width_m, b.box.width_m);
  EXPECT_EQ(a.box.length_m, b.box.length_m);
  EXPECT_DOUBLE_EQ(a.box.heading_rad, b.box.heading_rad) << "degrees in the file: to rounding";
  EXPECT_EQ(a.heights.mean, b.heights.mean);
  EXPECT_EQ(a.heights.max, b.heights.max);
  EXPECT_EQ(a.heights.p50, b.heights.p50);
  EXPECT_EQ(a.heights.p90, b.heights.p90);
  EXPECT_EQ(a.heights.p95, b.heights.p95);
  EXPECT_EQ(a.heights.p99, b.heights.p99);
  EXPECT_EQ(a.heights.hand3, b.heights.hand3);
}

void expect_equal(const farm::Plant& a, const farm::Plant& b) {
  EXPECT_EQ(a.id, b.id);
  EXPECT_EQ(a.plot, b.plot);
  EXPECT_EQ(a.kind, b.kind);
  EXPECT_EQ(a.model, b.model);
  EXPECT_EQ(a.position, b.position);
  EXPECT_EQ(a.rotation.coeffs(), b.rotation.coeffs());
  EXPECT_EQ(a.scale, b.scale);
  EXPECT_EQ(a.height_m, b.height_m);
}

void expect_equal(const farm::Farm& a, const farm::Farm& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.seed, b.seed);
  EXPECT_EQ(a.terrain.vertices(), b.terrain.vertices());
  EXPECT_EQ(a.terrain.triangles(), b.terrain.triangles());
  ASSERT_EQ(a.models.size(), b.models.size());
  for (std::size_t i = 0; i < a.models.size(); ++i) {
    EXPECT_EQ(a.models[i].name, b.models[i].name);
    EXPECT_NEAR(a.models[i].height_m, b.models[i].height_m, 1e-7);
    expect_equal(a.models[i].mesh, b.models[i].mesh);
  }
  ASSERT_EQ(a.plots.size(), b.plots.size());
  for (std::size_t i = 0; i < a.plots.size(); ++i) expect_equal(a.plots[i], b.plots[i]);
  ASSERT_EQ(a.plants.size(), b.plants.size());
  for (std::size_t i = 0; i < a.plants.size(); ++i) expect_equal(a.plants[i], b.plants[i]);
}

farm::Farm written_example(const TemporaryFolder& folder) {
  const planting::FarmDescription description =
      description::load_description(write_example(folder));
  farm::Farm farm = planting::generate(description, 42);
  write_farm(farm, folder.path() / "farm",
             {.command = "farmgen generate", .inputs = planting::input_files(description)});
  return farm;
}

std::string text_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

void replace_in(const fs::path& path, const std::string& old_text, const std::string& new_text) {
  std::string text = text_of(path);
  const auto place = text.find(old_text);
  ASSERT_NE(place, std::string::npos) << old_text;
  text.replace(place, old_text.size(), new_text);
  std::ofstream(path, std::ios::binary) << text;
}

TEST(FarmFolder, ReadsBackTheFarmThatWasWritten) {
  const TemporaryFolder folder;
  const farm::Farm farm = written_example(folder);
  expect_equal(farm, read_farm(folder.path() / "farm"));
}

TEST(FarmFolder, ReadsBackPlantsThatLeanAndPlantsOutsidePlots) {
  const TemporaryFolder folder;
  const farm::Farm farm =
      planting::generate(description::load_description(write_leaning_example(folder)), 5);
  ASSERT_EQ(farm.plants.back().plot, 0u);
  write_farm(farm, folder.path() / "farm", {.command = "farmgen generate"});
  expect_equal(farm, read_farm(folder.path() / "farm"));
}

TEST(FarmFolder, ReadsBackAFarmWithoutPlants) {
  const TemporaryFolder folder;
  const farm::Farm farm = planting::generate(
      description::load_description(write_example(folder), {"plants.count=0"}), 5);
  ASSERT_EQ(farm.plots.size(), 5u);
  double last_share = 0;
  write_farm(farm, folder.path() / "farm", {.command = "farmgen generate"}, {}, [&](double share) {
    EXPECT_GE(share, last_share);
    last_share = share;
  });
  EXPECT_EQ(last_share, 1);
  expect_equal(farm, read_farm(folder.path() / "farm"));
}

TEST(FarmFolder, TheSameDescriptionAndSeedWriteTheSameBytes) {
  const TemporaryFolder folder;
  const planting::FarmDescription description =
      description::load_description(write_example(folder));
  for (const char* name : {"a", "b"}) {
    write_farm(planting::generate(description, 42), folder.path() / name,
               {.command = "farmgen generate", .inputs = planting::input_files(description)});
  }
  write_farm(planting::generate(description, 43), folder.path() / "c",
             {.command = "farmgen generate"});
  std::size_t files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder.path() / "a")) {
    if (!entry.is_regular_file()) continue;
    const fs::path relative = fs::relative(entry.path(), folder.path() / "a");
    EXPECT_EQ(text_of(entry.path()), text_of(folder.path() / "b" / relative)) << relative;
    ++files;
  }
  EXPECT_EQ(files, 1u + 1 + 4 + 3 * 4) << "world, manifest, truth, and four files a model";
  EXPECT_NE(text_of(folder.path() / "a/truth/plants.csv"),
            text_of(folder.path() / "c/truth/plants.csv"));
}

// More plants of a plot than are printed at a time.
TEST(FarmFolder, HasTheSameBytesForAnyNumberOfThreads) {
  const TemporaryFolder folder;
  const farm::Farm farm = planting::generate(
      description::load_description(write_example(folder), {"plants.count=1500"}), 42);
  for (const int threads : {1, 3}) {
    write_farm(farm, folder.path() / std::to_string(threads), {.command = "farmgen generate"},
               {.threads = threads});
  }
  for (const char* file : {"world.sdf", "truth/plants.csv"})
    EXPECT_EQ(text_of(folder.path() / "1" / file), text_of(folder.path() / "3" / file)) << file;
  expect_equal(farm, read_farm(folder.path() / "3"));
}

TEST(FarmFolder, TerrainIsAPlyThatAssimpReads) {
  const TemporaryFolder folder;
  const farm::Farm farm = written_example(folder);
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile((folder.path() / "farm/truth/terrain.ply").string(), 0);
  ASSERT_NE(scene, nullptr) << importer.GetErrorString();
  const aiMesh& mesh = *scene->mMeshes[0];
  ASSERT_EQ(mesh.mNumFaces, farm.terrain.triangles().size());
  for (unsigned face = 0; face < mesh.mNumFaces; ++face) {
    for (int corner = 0; corner < 3; ++corner) {
      const aiVector3D& read = mesh.mVertices[mesh.mFaces[face].mIndices[corner]];
      const Eigen::Vector3d& vertex =
          farm.terrain.vertices()[farm.terrain.triangles()[face][corner]];
      EXPECT_LE((Eigen::Vector3d(read.x, read.y, read.z) - vertex).norm(), 1e-5);
    }
  }
}

TEST(FarmFolder, WritingRefusesToReplaceUnlessAsked) {
  const TemporaryFolder folder;
  const farm::Farm farm = written_example(folder);
  EXPECT_THAT(message_of<InputError>([&] {
                write_farm(farm, folder.path() / "farm", {.command = "farmgen generate"});
              }),
              HasSubstr("--force"));
  write_farm(farm, folder.path() / "farm", {.command = "farmgen generate"}, {.replace = true});
}

struct Damage {
  const char* name;
  const char* file;  // below the farm folder
  const char* old_text;
  const char* new_text;
  const char* message;
};

// GoogleTest prints it beside the test's name.
void PrintTo(const Damage& damage, std::ostream* out) { *out << damage.name; }

class DamagedFarm : public ::testing::TestWithParam<Damage> {};

TEST_P(DamagedFarm, IsRefused) {
  const TemporaryFolder folder;
  written_example(folder);
  const fs::path farm = folder.path() / "farm";
  replace_in(farm / GetParam().file, GetParam().old_text, GetParam().new_text);
  EXPECT_THAT(message_of<InputError>([&] { read_farm(farm); }), HasSubstr(GetParam().message));
}

INSTANTIATE_TEST_SUITE_P(
    FarmFolder, DamagedFarm,
    ::testing::Values(Damage{"NanInPlants", "truth/plants.csv", "\n2,1,crop", "\n2,nan,crop",
                             "plants.csv:3: plot \"nan\" is not a whole number"},
                      Damage{"UnknownModel", "truth/plants.csv", "\n2,1,crop,soybean",
                             "\n2,1,crop,wheat", "is not one of the farm's models"},
                      Damage{"UnknownKind", "truth/plants.csv", "\n2,1,crop", "\n2,1,tree",
                             "plants.csv:3: kind \"tree\" is neither crop nor weed"},
                      Damage{"CropTurnedWeed", "truth/plants.csv", "\n2,1,crop", "\n2,1,weed",
                             "has 19 plants of plot 1; the farm has 20"},
                      Damage{"WrongId", "truth/plants.csv", "\n2,1,", "\n3,1,",
                             "id \"3\" is not 2"},
                      Damage{"PlotThatIsNot", "truth/plants.csv", "\n2,1,", "\n2,77,",
                             "plant 2 is in plot 77, which plots.geojson lacks"},
                      Damage{"PlantInAnotherPlot", "truth/plants.csv", "\n2,1,", "\n2,4,",
                             "has 19 plants of plot 1; the farm has 20"},
                      Damage{"PathOutOfTheFolder", "manifest.json", "\"soybean_1\"",
                             "\"../../soybean_1\"", "leaves its folder"},
                      Damage{"AbsolutePath", "manifest.json", "\"soybean_1\"", "\"/tmp/soybean_1\"",
                             "leaves its folder"},
                      Damage{"ModelThatIsNot", "manifest.json", "\"soybean_1\"", "\"soybean_7\"",
                             "soybean_7.obj: no such file"},
                      Damage{"CountThatIsNot", "manifest.json", "\"plants\": 100",
                             "\"plants\": 101", "has 100 plants; the farm has 101"},
                      Damage{"NoFarmManifest", "manifest.json", "\"models\"", "\"moduls\"",
                             "is no farm folder (its manifest.json"},
                      Damage{"BrokenManifest", "manifest.json", "{", "(", "not JSON"},
                      Damage{"HeightThatIsNone", "truth/plots.geojson", "\"height_p99_m\"",
                             "\"height_p98_m\"", "feature 1: height_p99_m is missing"},
                      Damage{"OtherTerrainHeader", "truth/terrain.ply", "property double x",
                             "property float x ", "its PLY header is another"},
                      Damage{"EditedByHand", "truth/plants.csv", "\n2,1,", "\n2, 1,",
                             "plants.csv: was changed after plotscan wrote it"},
                      Damage{"TerrainOfMoreVertices", "truth/terrain.ply", "vertex 44", "vertex 45",
                             "its header, with 45 vertices"}),
    [](const auto& damage) { return std::string(damage.param.name); });

TEST(FarmFolder, MissingAndTruncatedFilesAreRefused) {
  for (const char* file : {"truth/plants.csv", "truth/plots.geojson", "truth/terrain.ply",
                           "manifest.json", "models/soybean_2/meshes/soybean_2.obj"}) {
    const TemporaryFolder folder;
    written_example(folder);
    const fs::path farm = folder.path() / "farm";
    fs::resize_file(farm / file, fs::file_size(farm / file) / 2);
    EXPECT_THROW(read_farm(farm), InputError) << file << " cut in half";
    fs::remove(farm / file);
    EXPECT_THROW(read_farm(farm), InputError) << file << " removed";
  }
  EXPECT_THAT(message_of<InputError>([] { read_farm("/no/such/farm"); }), HasSubstr("no such"));
}

TEST(FarmFolder, KeepsReflectancesAndMasks) {
  const TemporaryFolder folder;
  folder.write("leaf.png", plotscan::testing::png_of_alpha(
                               8, 8, [](int column, int row) { return (column + row) % 2 * 255; }));
  folder.write("m.mtl", "newmtl leaf\nmap_Kd leaf.png\nnewmtl stem\n");
  folder.write("m.obj",
               "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 0 1\nvt 0 0\nvt 1 0\nvt 0 1\n"
               "usemtl leaf\nf 1/1 2/2 3/3\nusemtl stem\nf 1/1 3/3 2/2\n");
  const auto description =
      folder.write("f.yaml",
                   "terrain: {side_m: 20, reflectance: 0.15}\n"
                   "plots: {width_m: 3, length_m: 3, rows: [{plots: 1}]}\n"
                   "plants: {count: 2, models: [{mesh: m.obj, reflectance: {stem: 0.33}},\n"
                   "  {crop: soybean, stage: V2, reflectance: {leaf: 0.51, pod: 0.2}}]}\n");
  const farm::Farm made = planting::generate(description::load_description(description), 1);
  write_farm(made, folder.path() / "farm", {.command = "farmgen generate"});
  const farm::Farm read = read_farm(folder.path() / "farm");
  EXPECT_EQ(read.soil_reflectance, 0.15);
  ASSERT_EQ(read.models.size(), 2u);
  EXPECT_EQ(read.models[0].mesh.materials[0].reflectance, std::nullopt);
  ASSERT_NE(read.models[0].mesh.materials[0].mask, nullptr);
  EXPECT_EQ(read.models[0].mesh.materials[0].mask->opaque_share(), 0.5);
  EXPECT_EQ(read.models[0].mesh.materials[1].reflectance, 0.33F);
  for (const mesh::Mesh* mesh : {&read.models[1].mesh, &*read.models[1].light}) {
    for (const mesh::Material& material : mesh->materials) {
      if (material.name == "leaf") {
        EXPECT_EQ(material.reflectance, 0.51F);
      }
      if (material.name == "stem") {
        EXPECT_EQ(material.reflectance, std::nullopt);
      }
    }
  }
}

TEST(FarmDescription, ReflectancesThatCannotBeAreRefused) {
  const TemporaryFolder folder;
  folder.write("m.mtl", "newmtl leaf\n");
  folder.write("m.obj", "mtllib m.mtl\nusemtl leaf\nv 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 3\n");
  const auto refusal = [&](const std::string& terrain, const std::string& model) {
    const auto file =
        folder.write("f.yaml", "terrain: {side_m: 20" + terrain +
                                   "}\n"
                                   "plots: {width_m: 3, length_m: 3, rows: [{plots: 1}]}\n"
                                   "plants:\n  count: 2\n  models:\n    - {" +
                                   model + "}\n");
    return message_of<InputError>(
        [&] { planting::generate(description::load_description(file), 1); });
  };
  EXPECT_THAT(refusal(", reflectance: 1.5", "mesh: m.obj"),
              ::testing::AllOf(HasSubstr("f.yaml:1"), HasSubstr("terrain.reflectance")));
  EXPECT_THAT(refusal("", "mesh: m.obj, reflectance: {leaf: -0.1}"),
              ::testing::AllOf(HasSubstr("f.yaml:6"), HasSubstr("reflectance.leaf")));
  EXPECT_THAT(refusal("", "mesh: m.obj, reflectance: {stem: 0.4}"),
              HasSubstr("reflectance: stem is not a material of"));
  folder.write("bare.obj", "v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 3\n");
  EXPECT_THAT(refusal("", "mesh: bare.obj, reflectance: {stem: 0.4}"),
              ::testing::EndsWith("bare.obj, which has none"));
  EXPECT_THAT(refusal("", "crop: wheat, reflectance: {pod: 0.4}"),
              ::testing::AllOf(HasSubstr("f.yaml:6"), HasSubstr("pod")));
}

}  // namespace
}  // namespace plotscan::farmfolder
