// SPDX-License-Identifier: Apache-2.0
// What stands in an exported folder, read back without Gazebo's libraries.
#include <algorithm>
#include <fstream>
#include <map>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tinyxml2.h>

#include "core/error.h"
#include "core/manifest.h"
#include "core/text_file.h"
#include "farmgen/gazebo/export_example.h"
#include "gazebo/internal/naming.h"
#include "gazebo/merged_models.h"
#include "mesh/alpha_mask.h"
#include "sdfxml/elements.h"
#include "test_images.h"

namespace plotscan::gazebo {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

// The corners of an OBJ file's triangles, in the file's order; its normals have to fit them.
std::vector<Eigen::Vector3d> corners_in(const fs::path& file) {
  std::ifstream in(file);
  EXPECT_TRUE(in) << file;
  std::vector<Eigen::Vector3d> vertices, normals, corners;
  std::string line;
  while (std::getline(in, line)) {
    std::istringstream words(line);
    std::string key;
    words >> key;
    Eigen::Vector3d v;
    if (key == "v" && words >> v.x() >> v.y() >> v.z()) vertices.push_back(v);
    if (key == "vn" && words >> v.x() >> v.y() >> v.z()) normals.push_back(v);
    if (key != "f") continue;
    std::string corner;
    while (words >> corner) {
      corners.push_back(vertices.at(std::stoul(corner) - 1));
      const auto normal = std::stoul(corner.substr(corner.rfind('/') + 1));
      EXPECT_NEAR(normals.at(normal - 1).norm(), 1, 1e-3);
    }
  }
  return corners;
}

// A plant's triangles of one material as they should stand in a link at `origin`. With
// `both_sides` each is followed by its back.
void add_expected(const farm::Farm& farm, const farm::Plant& plant, const std::string& material,
                  const Eigen::Vector3f& colour, const Eigen::Vector3d& origin, bool both_sides,
                  std::vector<Eigen::Vector3d>& corners) {
  const mesh::Mesh& mesh = farm.models[plant.model].mesh;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const mesh::Material& look = mesh.materials[mesh.material_of(i)];
    if (look.name != material || look.colour != colour) continue;
    std::vector<Eigen::Vector3d> placed;
    for (const std::uint32_t vertex : mesh.triangles[i]) {
      const Eigen::Vector3d v = mesh.vertices[vertex].cast<double>();
      placed.push_back(plant.position + plant.rotation * plant.scale.cwiseProduct(v) - origin);
    }
    corners.insert(corners.end(), placed.begin(), placed.end());
    if (both_sides) corners.insert(corners.end(), placed.rbegin(), placed.rend());
  }
}

void expect_same(const std::vector<Eigen::Vector3d>& found,
                 const std::vector<Eigen::Vector3d>& expected, const std::string& what) {
  ASSERT_EQ(found.size(), expected.size()) << what;
  for (std::size_t i = 0; i < found.size(); ++i)
    ASSERT_LT((found[i] - expected[i]).norm(), 1e-6) << what << " corner " << i;
}

Eigen::Vector3d plot_origin(const farm::Farm& farm, std::uint32_t id) {
  const auto plot = std::find_if(farm.plots.begin(), farm.plots.end(),
                                 [&](const farm::Plot& each) { return each.id == id; });
  const Eigen::Vector2d c = plot->box.center;
  return {c.x(), c.y(), *farm.terrain.height(c.x(), c.y())};
}

struct Look {
  std::string file;  // the mesh file's stem
  std::string material;
  Eigen::Vector3f colour;
  bool closed;
};
const std::vector<Look> kLooks = {{"leaf", "leaf", {0.2F, 0.5F, 0.1F}, false},
                                  {"stem", "stem", {0.4F, 0.4F, 0.2F}, true},
                                  {"leaf_2", "leaf", {0.3F, 0.4F, 0.3F}, false}};

TEST(Export, MergedMeshesAreTheUnionOfThePlacedPlantsByMaterial) {
  const ExportExample example;
  const farm::Farm& farm = example.farm();
  for (const Gazebo gazebo : {Gazebo::classic, Gazebo::sim}) {
    for (const Merge merge : {Merge::plot, Merge::row}) {
      const std::string name = "world" + std::to_string(static_cast<int>(gazebo)) +
                               std::to_string(static_cast<int>(merge));
      example.write(name, {.gazebo = gazebo, .merge = merge, .lod = Detail::scan});
      std::size_t corners = 0;
      for (const farm::Plot& plot : farm.plots) {
        for (const auto kind : {farm::PlantKind::crop, farm::PlantKind::weed}) {
          for (const Look& look : kLooks) {
            std::vector<Eigen::Vector3d> expected;
            for (const farm::Plant& plant : farm.plants) {
              if (plant.plot != plot.id || plant.kind != kind) continue;
              add_expected(farm, plant, look.material, look.colour, plot_origin(farm, plot.id),
                           gazebo == Gazebo::classic && !look.closed, expected);
            }
            const bool weed = kind == farm::PlantKind::weed;
            const std::string part = sdfxml::plot_element_name(plot.id);
            const std::string link = weed ? weeds_name(part) : part;
            const std::string row = row_model_name(plot.trial, plot.row);
            const std::string model = merge == Merge::plot ? link : (weed ? weeds_name(row) : row);
            const std::string stem = merge == Merge::plot ? look.file : link + "_" + look.file;
            const fs::path file =
                example.path() / name / "models" / model / "meshes" / (stem + ".obj");
            if (expected.empty()) {
              EXPECT_FALSE(fs::exists(file)) << file;
            } else {
              expect_same(corners_in(file), expected, file);
            }
            corners += expected.size();
          }
        }
      }
      EXPECT_GT(corners, 200u) << "the comparison compared something";
    }
  }
}

// <material> takes the place of a mesh's own, and would close the holes of a leaf with a mask: its
// mesh has both sides and the MTL's mask.
TEST(Export, LeavesWithAMaskKeepItInGazeboSim) {
  const ExportExample example;
  farm::Farm farm = example.farm();
  mesh::Material& leaf = farm.models[0].mesh.materials[0];
  ASSERT_EQ(leaf.name, "leaf");
  leaf.mask = std::make_shared<const mesh::AlphaMask>(
      std::make_shared<const mesh::Image>(mesh::Image{
          "holes.png",
          plotscan::testing::png_of_alpha(4, 4, [](int x, int) { return x % 2 * 255; })}),
      0.5F, "holes.png");
  export_world(farm, example.farm_folder(), example.path() / "world",
               {.gazebo = Gazebo::sim, .lod = Detail::scan}, {.command = "test"});
  const fs::path model = example.path() / "world/models/plot_1";
  EXPECT_THAT(read_text(model / "meshes/leaf.mtl"), HasSubstr("map_d "));
  const std::string sdf = read_text(model / "model.sdf");
  const auto visual = [&](const std::string& name) {
    const auto begin = sdf.find("<visual name=\"" + name + "\">");
    return sdf.substr(begin, sdf.find("</visual>", begin) - begin);
  };
  EXPECT_THAT(visual("leaf"), Not(HasSubstr("<material>")));
  EXPECT_THAT(visual("stem"), HasSubstr("<double_sided>true"));
  const auto corners = corners_in(model / "meshes/leaf.obj");
  ASSERT_EQ(corners.size() % 6, 0U);
  for (std::size_t i = 0; i < corners.size(); i += 6) EXPECT_EQ(corners[i], corners[i + 5]);
}

TEST(Export, RowsOfDifferentTrialsAreDifferentModels) {
  const ExportExample example;
  farm::Farm farm = example.farm();
  const auto names = [&] {
    std::vector<std::string> all;
    for (const MergedModel& model : merged_models(farm, Merge::row))
      if (model.label == farm::SurfaceClass::crop && !model.name.starts_with("plants"))
        all.push_back(model.name);
    return all;
  };
  EXPECT_EQ(names(), (std::vector<std::string>{"row_1", "row_2"}));
  for (farm::Plot& plot : farm.plots) plot.trial = plot.column;  // row 1 has two columns
  EXPECT_EQ(names(), (std::vector<std::string>{"trial_1_row_1", "trial_1_row_2", "trial_2_row_1"}));
}

TEST(Export, PlantsOutsidePlotsStandInTilesWhereTheyAreMany) {
  const ExportExample example;
  example.write("few", {});
  EXPECT_TRUE(fs::exists(example.path() / "few/models/plants_outside_plots/meshes"));
  farm::Farm farm = example.farm();
  const farm::Plant pattern = farm.plants.front();
  for (std::uint32_t i = 0; i < kTilePlants; ++i) {
    farm::Plant plant = pattern;
    plant.id = 1000 + i;
    plant.plot = 0;
    plant.kind = farm::PlantKind::crop;
    plant.position.x() = i % 2 == 0 ? 5 : -5;
    farm.plants.push_back(plant);
  }
  export_world(farm, example.farm_folder(), example.path() / "many", {}, {.command = "test"});
  EXPECT_FALSE(fs::exists(example.path() / "many/models/plants_outside_plots"));
  EXPECT_TRUE(fs::exists(example.path() / "many/models" / outside_model_name(2) / "meshes"));
}

TEST(Export, LightMeshesAreTheModelsOwnElseSimplified) {
  const ExportExample example;
  farm::Farm farm = example.farm();
  farm.models[0].light = farm.models[1].mesh;
  mesh::Mesh fine;  // many small sheets
  for (int i = 0; i < 2000; ++i) {
    const auto first = static_cast<std::uint32_t>(fine.vertices.size());
    const float x = 0.01F * static_cast<float>(i % 50);
    const float y = 0.01F * static_cast<float>(i / 50);
    fine.vertices.insert(fine.vertices.end(), {{x, y, 0}, {x + 0.01F, y, 0}, {x, y + 0.01F, 0.1F}});
    fine.triangles.push_back({first, first + 1, first + 2});
  }
  farm.models[1].mesh = fine;
  export_world(farm, example.farm_folder(), example.path() / "world", {.merge = Merge::none},
               {.command = "test"});
  const auto triangles = [&](const std::string& model) {
    return corners_in(example.path() / "world/models" / model / "meshes" / (model + ".obj"))
               .size() /
           3;
  };
  EXPECT_EQ(triangles("bush"), 2u) << "the thistle, with its back";
  EXPECT_LE(triangles("thistle"), 2u * kLightTriangles);
  EXPECT_GT(triangles("thistle"), 20u);
}

// Every file by its path, but for the manifest's options nothing tells the threads.
std::map<std::string, std::string> files_in(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file())
      files[fs::relative(entry.path(), folder).string()] = read_text(entry.path());
  }
  return files;
}

TEST(Export, TheBytesDoNotDependOnTheThreads) {
  const ExportExample example;
  for (const Merge merge : {Merge::plot, Merge::row, Merge::none}) {
    const std::string name = "world" + std::to_string(static_cast<int>(merge));
    ExportOptions options{.merge = merge, .collision = Collision::box, .drone = true, .threads = 1};
    example.write(name + "_1", options);
    options.threads = 5;
    example.write(name + "_5", options);
    EXPECT_EQ(files_in(example.path() / (name + "_1")), files_in(example.path() / (name + "_5")));
  }
}

TEST(Export, TheTruthAndAReadmeAreBesideTheWorld) {
  const ExportExample example;
  example.write("world", {.drone = true});
  EXPECT_EQ(files_in(example.path() / "world/truth"), files_in(example.farm_folder() / "truth"));
  const std::string readme = read_text(example.path() / "world/README.md");
  EXPECT_THAT(readme, HasSubstr("GZ_SIM_RESOURCE_PATH=\"$PWD/models\" gz sim world.sdf"));
  EXPECT_THAT(readme, HasSubstr("ign gazebo world_fortress.sdf"));
  EXPECT_THAT(readme, HasSubstr("fly_drone.sh"));
  EXPECT_NO_THROW(require_unchanged(example.path() / "world", "models"));
  example.write("classic", {.gazebo = Gazebo::classic});
  EXPECT_THAT(read_text(example.path() / "classic/README.md"),
              HasSubstr("GAZEBO_MODEL_PATH=\"$PWD/models:$GAZEBO_MODEL_PATH\" gazebo world.sdf"));
}

TEST(Export, TheCountsAreThoseOfTheWorld) {
  const ExportExample example;
  const ExportSummary plot = example.write("plot", {.lod = Detail::scan, .drone = true});
  const ExportSummary row =
      example.write("row", {.merge = Merge::row, .lod = Detail::scan, .drone = true});
  const ExportSummary none =
      example.write("none", {.merge = Merge::none, .lod = Detail::scan, .drone = true});
  EXPECT_EQ(none.counts.models, example.farm().plants.size() + 2) << "with terrain and drone";
  EXPECT_EQ(none.counts.visuals, example.farm().plants.size() + 1 + 8);
  EXPECT_EQ(plot.counts.links, row.counts.links);
  EXPECT_EQ(plot.counts.triangles, row.counts.triangles);
  EXPECT_LT(row.counts.models, plot.counts.models);
  std::uint64_t bytes = 0;
  for (const auto& [file, text] : files_in(example.path() / "plot")) bytes += text.size();
  EXPECT_EQ(plot.bytes, bytes);
}

TEST(Export, APlantModelCalledAsAPlotIsRefused) {
  const ExportExample example;
  for (const std::string& name : {sdfxml::plot_element_name(1), std::string("drone")}) {
    farm::Farm farm = example.farm();
    farm.models[0].name = name;
    const std::string message = testing::message_of<InputError>([&] {
      export_world(farm, example.farm_folder(), example.path() / "world", {.drone = true},
                   {.command = "test"});
    });
    EXPECT_THAT(message, HasSubstr("plant model \"" + name + "\""));
    EXPECT_FALSE(fs::exists(example.path() / "world"));
  }
}

TEST(Export, TheLidarOfTheCpuIsClassicsRay) {
  const ExportExample example;
  const auto sensor = [&](const std::string& name, const Lidar lidar) {
    example.write(
        name,
        {.gazebo = Gazebo::classic, .collision = Collision::mesh, .drone = true, .lidar = lidar});
    return read_text(example.path() / name / "models/drone/model.sdf");
  };
  const std::string gpu = sensor("gpu", Lidar::gpu);
  std::string cpu = sensor("cpu", Lidar::cpu);
  const std::size_t type = cpu.find("type=\"ray\"");
  ASSERT_NE(type, std::string::npos);
  EXPECT_EQ(cpu.replace(type, 10, "type=\"gpu_ray\""), gpu) << "nothing else differs";
  EXPECT_THAT(read_text(example.path() / "gpu/README.md"), HasSubstr("xvfb-run"));
  EXPECT_THAT(read_text(example.path() / "cpu/README.md"), Not(HasSubstr("xvfb-run")));
}

TEST(Export, ALidarThatWouldSeeNothingIsRefused) {
  const ExportExample example;
  const ExportOptions good{
      .gazebo = Gazebo::classic, .collision = Collision::box, .drone = true, .lidar = Lidar::cpu};
  ExportOptions sim = good, bare = good, without = good;
  sim.gazebo = Gazebo::sim;
  bare.collision = Collision::none;
  without.drone = false;
  for (const auto& [options, message] : std::vector<std::pair<ExportOptions, std::string>>{
           {sim, "--lidar cpu needs --gazebo classic"},
           {bare, "--lidar cpu needs --collision mesh"},
           {without, "--lidar cpu needs --drone"}}) {
    const auto write = [&example, &given = options] { example.write("world", given); };
    EXPECT_THAT(testing::message_of<InputError>(write), HasSubstr(message));
    EXPECT_FALSE(fs::exists(example.path() / "world"));
  }
  EXPECT_NO_THROW(example.write("world", good));
}

}  // namespace
}  // namespace plotscan::gazebo
