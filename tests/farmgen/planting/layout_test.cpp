// SPDX-License-Identifier: Apache-2.0
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../example_farm.h"
#include "core/angle.h"
#include "core/csv.h"
#include "core/error.h"
#include "core/plot_features.h"
#include "description/load_description.h"
#include "farm/summary.h"
#include "planting/generate.h"
#include "planting/layout_table.h"

namespace plotscan::planting {
namespace {

namespace fs = std::filesystem;
using plotscan::testing::message_of;
using plotscan::testing::TemporaryFolder;
using ::testing::HasSubstr;

std::vector<LayoutPlant> read(const std::string& table,
                              const std::map<std::string, std::string>& columns = {}) {
  const TemporaryFolder folder;
  return read_layout_table(folder.write("t.csv", table), columns, {"a", "b"});
}

TEST(LayoutTable, ReadsEveryColumnInAnyOrder) {
  const auto plants = read(
      "plot,y_m,x_m,model,id,z_m,scale_x,scale_y,scale_z,yaw_deg,pitch_deg,roll_deg\n"
      "4,2,1,b,1,0.5,1.1,1.2,1.3,90,0,0\n"
      ",-2,-1,a,2,,,,,0,90,0\n");
  ASSERT_EQ(plants.size(), 2u);
  EXPECT_EQ(plants[0].model, 1u);
  EXPECT_EQ(plants[0].position, Eigen::Vector2d(1, 2));
  EXPECT_EQ(plants[0].z_m, 0.5);
  EXPECT_EQ(plants[0].scale, Eigen::Vector3d(1.1, 1.2, 1.3));
  EXPECT_EQ(plants[0].plot, 4u);
  EXPECT_EQ(plants[0].line, 2u);
  EXPECT_TRUE((plants[0].rotation * Eigen::Vector3d::UnitX()).isApprox(Eigen::Vector3d::UnitY()));
  EXPECT_FALSE(plants[1].z_m);
  EXPECT_FALSE(plants[1].plot);
  EXPECT_EQ(plants[1].scale, Eigen::Vector3d::Ones());
  EXPECT_TRUE((plants[1].rotation * Eigen::Vector3d::UnitZ()).isApprox(Eigen::Vector3d::UnitX()))
      << "a pitch of 90 degrees lays the plant along x";
}

TEST(LayoutTable, TurnsRollThenPitchThenYaw) {
  const auto plants = read("model,x_m,y_m,yaw_deg,pitch_deg,roll_deg\na,0,0,90,0,90\n");
  // Roll takes z to -y, yaw takes -y to x.
  EXPECT_TRUE((plants[0].rotation * Eigen::Vector3d::UnitZ()).isApprox(Eigen::Vector3d::UnitX()));
}

TEST(LayoutTable, OtherNamesOfColumnsMayBeGiven) {
  const auto plants =
      read("kind,east,north,size\nb,1,2,3\n",
           {{"model", "kind"}, {"x_m", "east"}, {"y_m", "north"}, {"scale", "size"}});
  EXPECT_EQ(plants.at(0).model, 1u);
  EXPECT_EQ(plants[0].scale, Eigen::Vector3d(3, 3, 3));
}

TEST(LayoutTable, MistakesNameLineAndColumn) {
  const auto message = [](const std::string& table,
                          const std::map<std::string, std::string>& columns = {}) {
    return message_of<InputError>([&] { read(table, columns); });
  };
  EXPECT_THAT(message("model,x_m,y_m\na,1,2\nc,1,2\n"),
              HasSubstr("t.csv:3: model \"c\" is not one of the models a, b"));
  EXPECT_THAT(message("model,x_m,y_m\na,1,nan\n"), HasSubstr("t.csv:2: y_m \"nan\" is not finite"));
  EXPECT_THAT(message("model,x_m,y_m\na,1,north\n"), HasSubstr("y_m \"north\" is not a number"));
  EXPECT_THAT(message("model,x_m,y_m,scale\na,1,2,0\n"),
              HasSubstr("scale \"0\" is not in [0.01, 100]"));
  EXPECT_THAT(message("model,x_m,y_m,scale,scale_z\na,1,2,1,-1\n"),
              HasSubstr("scale_z \"-1\" is given beside scale"));
  EXPECT_THAT(message("model,x_m,y_m,id\na,1,2,1\na,1,2,3\n"),
              HasSubstr("t.csv:3: id \"3\" is not 2"));
  EXPECT_THAT(message("model,x_m,y_m,z_m\na,1,2,2e5\n"),
              HasSubstr("t.csv:2: z_m \"2e5\" is more than 100 km from the world's origin"));
  EXPECT_THAT(message("model,x_m\na,1\n"), HasSubstr("column \"y_m\" is missing"));
  EXPECT_THAT(message("model,x_m,y_m,size\na,1,2,1\n"), HasSubstr("unknown column \"size\""));
  EXPECT_THAT(message("model,x_m,y_m\na,1,2\n", {{"scale", "size"}}),
              HasSubstr("column \"size\" is missing"));
  EXPECT_THAT(message("model,x_m,y_m\na,1\n"), HasSubstr("has 2 fields; the header names 3"));
}

std::string layout_of(const std::string& plots) {
  return "terrain: {side_m: 20}\nlayout:\n  plants: t.csv\n" + plots + "  models: [" +
         (testing::models_folder() / "soybean_1.obj").string() + "]\n";
}

TEST(Layout, PlotsMayComeFromAGeoJson) {
  const TemporaryFolder folder;
  folder.write("t.csv",
               "model,x_m,y_m,plot\nsoybean_1,1,1,\nsoybean_1,5,5,\nsoybean_1,5,5,12\n"
               "soybean_1,1,1,0\n");
  PlotFeature feature{.box = {.center = {1, 1}, .width_m = 2, .length_m = 3, .heading_rad = 0.5}};
  feature.properties["plot_number"] = 12;
  write_plot_features(folder.path() / "p.geojson", {feature});
  const farm::Farm farm = generate(
      description::load_description(folder.write("f.yaml", layout_of("  plots: p.geojson\n"))), 1);
  ASSERT_EQ(farm.plots.size(), 1u);
  EXPECT_EQ(farm.plots[0].id, 12u);
  EXPECT_EQ(farm.plots[0].plant_count, 2u);
  EXPECT_EQ(farm.plants[0].plot, 12u) << "inside the box";
  EXPECT_EQ(farm.plants[1].plot, 0u) << "outside every box";
  EXPECT_EQ(farm.plants[2].plot, 12u) << "as the table says";
  EXPECT_EQ(farm.plants[3].plot, 0u) << "as the table says";
}

TEST(Layout, PlotsOfATableLieApart) {
  const TemporaryFolder folder;
  folder.write("t.csv", "model,x_m,y_m,plot\nsoybean_1,1,1,\n");
  const auto file = folder.write("f.yaml", layout_of("  plots: p.geojson\n"));
  const auto make = [&](double step_m) {
    std::vector<PlotFeature> features(2);
    for (std::size_t i = 0; i < 2; ++i) {
      features[i].box = {
          .center = {step_m * static_cast<double>(i), 1}, .width_m = 2, .length_m = 3};
      features[i].properties["plot_number"] = i + 1;
    }
    write_plot_features(folder.path() / "p.geojson", features);
    generate(description::load_description(file), 1);
  };
  EXPECT_THAT(message_of<InputError>([&] { make(2.5); }),
              HasSubstr("p.geojson: plots 1 and 2 overlap"));
  EXPECT_NO_THROW(make(2.999)) << "plots may touch, but for rounding";
}

TEST(Layout, PlantsHaveToStandOnTheTerrainAndInPlotsThatExist) {
  const TemporaryFolder folder;
  const auto message = [&](const std::string& row) {
    folder.write("t.csv", "model,x_m,y_m,plot\n" + row + "\n");
    const auto file = folder.write("f.yaml", layout_of(""));
    return message_of<InputError>([&] { generate(description::load_description(file), 1); });
  };
  EXPECT_THAT(message("soybean_1,11,0,"), HasSubstr("t.csv:2: the plant stands off the terrain"));
  EXPECT_THAT(message("soybean_1,1,0,3"), HasSubstr("t.csv:2: plot 3 is not one of the farm's 0"));
}

// The third-party scene, from its files as they lie.
TEST(Layout, ReproducesTheFixedBeanScene) {
  const fs::path scene = fs::path(PLOTSCAN_SHARED_DATA_DIR) / "scenes/beans_2700";
  if (!fs::exists(scene)) GTEST_SKIP() << scene << " is absent";
  std::string yaml = read_text(fs::path(PLOTSCAN_SOURCE_DIR) / "benchmarks/speed/beans_2700.yaml");
  const std::string beside = "../../../shared/data";
  for (auto place = yaml.find(beside); place != std::string::npos; place = yaml.find(beside)) {
    yaml.replace(place, beside.size(), PLOTSCAN_SHARED_DATA_DIR);
  }
  const TemporaryFolder folder;
  const farm::Farm farm =
      generate(description::load_description(folder.write("beans.yaml", yaml)), 1);
  ASSERT_EQ(farm.plants.size(), 2700u);
  const farm::FarmSummary summary = farm::summarise(farm);
  EXPECT_EQ(summary.plant_triangles + summary.terrain_triangles, 850'794u)
      << "what the scene's authors count";
  for (const farm::Plot& plot : farm.plots) EXPECT_EQ(plot.plant_count, 90u) << "plot " << plot.id;
  std::size_t line = 0;
  read_csv(scene / "instances.csv", {"id", "mesh", "x", "y", "z", "scale", "rot_deg"}, {},
           [&](const CsvRow& row) {
             const farm::Plant& plant = farm.plants.at(line++);
             EXPECT_EQ(plant.id, row.integer(0, 1, 2700));
             EXPECT_EQ(farm.models[plant.model].name, row.text(1));
             EXPECT_EQ(plant.position,
                       Eigen::Vector3d(row.number(2), row.number(3), row.number(4)));
             EXPECT_EQ(plant.scale, Eigen::Vector3d::Constant(row.number(5)));
             const Eigen::Vector3d x_axis = plant.rotation * Eigen::Vector3d::UnitX();
             const double angle = radians(row.number(6));
             EXPECT_NEAR(x_axis.x(), std::cos(angle), 1e-12);
             EXPECT_NEAR(x_axis.y(), std::sin(angle), 1e-12);
             const auto ground = farm.terrain.height(plant.position.x(), plant.position.y());
             EXPECT_NEAR(plant.position.z() + 0.01, ground.value(), 1e-5)
                 << "the scene's authors sink each foot 1 cm into the ground";
           });
  EXPECT_EQ(line, 2700u);
}

}  // namespace
}  // namespace plotscan::planting
