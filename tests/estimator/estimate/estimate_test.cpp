// SPDX-License-Identifier: Apache-2.0
#include "estimate/estimate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/angle.h"
#include "core/error.h"
#include "estimate/plot_map.h"
#include "estimate/plot_tables.h"
#include "temporary_folder.h"

namespace plotscan::estimate {
namespace {

using plotscan::testing::message_of;
using plotscan::testing::TemporaryFolder;
using ::testing::HasSubstr;

Estimate two_plots() {
  Estimate estimate{.method = "dhami2020"};
  estimate.plots = {
      {.id = 1,
       .row = 1,
       .column = 2,
       .box = {.center = {500000.125, 1}, .width_m = 1.5, .length_m = 4, .heading_rad = 0.5},
       .points = 1234,
       .heights_m = {{"raw-p99", 0.75}, {"voxel-max", 0.7}}},
      {.id = 2, .box = {.center = {9, 9}, .width_m = 1.5, .length_m = 4, .heading_rad = 0.5}}};
  return estimate;
}

TEST(Estimate, ReadsWhatItWrites) {
  const TemporaryFolder folder;
  const Estimate written = two_plots();
  write_estimate(folder.path(), written);
  const Estimate read = read_estimate(folder.path());
  ASSERT_EQ(read.plots.size(), 2u);
  EXPECT_EQ(read.plots[0].id, 1u);
  EXPECT_EQ(read.plots[0].row, 1);
  EXPECT_EQ(read.plots[0].column, 2);
  EXPECT_EQ(read.plots[0].points, 1234u);
  EXPECT_EQ(read.plots[0].heights_m, written.plots[0].heights_m);
  EXPECT_EQ(read.plots[0].box.center, written.plots[0].box.center);
  EXPECT_NEAR(read.plots[0].box.heading_rad, 0.5, 1e-12);
  EXPECT_TRUE(read.plots[1].heights_m.empty());
}

TEST(Estimate, KeepsClustersAndPlanesOfGround) {
  const TemporaryFolder folder;
  Estimate written = two_plots();
  written.plots[0].ground = {.z_m = 101.25, .slope = {0.1, -0.05}, .tolerance_m = 0.05};
  written.clusters = {{.center = {3, 4}, .width_m = 1, .length_m = 5, .heading_rad = 0.25}};
  write_estimate(folder.path(), written);
  const Estimate read = read_estimate(folder.path());
  ASSERT_TRUE(read.plots[0].ground);
  EXPECT_EQ(read.plots[0].ground->z_m, 101.25);
  EXPECT_EQ(read.plots[0].ground->slope, Eigen::Vector2d(0.1, -0.05));
  EXPECT_EQ(read.plots[0].ground->tolerance_m, 0.05);
  EXPECT_FALSE(read.plots[1].ground);
  ASSERT_EQ(read.clusters.size(), 1U);
  EXPECT_EQ(read.clusters[0].center, Eigen::Vector2d(3, 4));
  EXPECT_EQ(read.clusters[0].length_m, 5);
  // A map that carries such a property keeps it under another name.
  const auto given = given_attributes({.box = {}, .properties = {{"ground_z_m", 7}}});
  EXPECT_EQ(given, nlohmann::json({{"given_ground_z_m", 7}}));
}

// A box in UTM: its corners, its centre and a program that reads the polygon alone keep every
// millimetre, and the file names the system.
TEST(Estimate, KeepsMillimetresInMapGridCoordinates) {
  const TemporaryFolder folder;
  const PlotBox box{
      .center = {512345.678, 4123456.789}, .width_m = 1.234, .length_m = 5.678, .heading_rad = 0.7};
  write_estimate(folder.path(), {.method = "lattice",
                                 .plots = {{.id = 1, .box = box, .heights_m = {{"mean", 0.5}}}},
                                 .crs = "EPSG:32617"});
  auto document = nlohmann::json::parse(read_text(folder.path() / "plots.geojson"));
  EXPECT_EQ(document["crs"]["properties"]["name"], "urn:ogc:def:crs:EPSG::32617");
  const auto& ring = document["features"][0]["geometry"]["coordinates"][0];
  ASSERT_EQ(ring.size(), 5u);
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector2d corner(ring[i][0].get<double>(), ring[i][1].get<double>());
    EXPECT_LT((corner - box.corners()[i]).norm(), 1e-6);
  }
  document["features"][0]["properties"] = {{"height_mean_m", 0.5}};
  folder.write("polygons.geojson", document.dump());
  for (const auto& file : {folder.path() / "plots.geojson", folder.path() / "polygons.geojson"}) {
    const PlotBox read = read_estimate(file).plots.at(0).box;
    EXPECT_LT((read.center - box.center).norm(), 1e-6);
    EXPECT_NEAR(read.width_m, 1.234, 1e-6);
    EXPECT_NEAR(read.length_m, 5.678, 1e-6);
    EXPECT_NEAR(read.heading_rad, 0.7, 1e-6);
  }
  EXPECT_THAT(read_text(folder.path() / "heights.csv"), HasSubstr("512345.678,4123456.789,1.234"));
}

// UTM 32 on its central meridian at the equator, where the ellipsoid's metres a degree are known
// (0.9996 of them on the map); and read back as a map of the same cloud.
TEST(Estimate, IsWrittenInWgs84WhereTheSystemIsUtm) {
  const TemporaryFolder folder;
  const PlotBox box{.center = {500000, 0}, .width_m = 2, .length_m = 6, .heading_rad = 0};
  const auto file = folder.path() / "plots.wgs84.geojson";
  write_estimate(folder.path(), {.method = "lattice", .plots = {{.id = 1, .box = box}}});
  EXPECT_FALSE(std::filesystem::exists(file)) << "of no known system";
  write_estimate(folder.path(), {.method = "lattice",
                                 .plots = {{.id = 1, .box = box}},
                                 .crs = "EPSG:32632",
                                 .units = CoordinateUnits{kFoot_m, kFoot_m}});
  EXPECT_FALSE(std::filesystem::exists(file)) << "UTM's, but in feet";
  write_estimate(folder.path(),
                 {.method = "lattice", .plots = {{.id = 1, .box = box}}, .crs = "EPSG:32632"});
  const auto document = nlohmann::json::parse(read_text(file));
  EXPECT_FALSE(document.contains("crs")) << "RFC 7946 has none";
  const auto& ring = document["features"][0]["geometry"]["coordinates"][0];
  const double east_deg = 3 / 0.9996 / 111319.491;
  const double north_deg = 1 / 0.9996 / 110574.276;
  EXPECT_NEAR(ring[2][0].get<double>(), 9 + east_deg, 1e-10);
  EXPECT_NEAR(ring[2][1].get<double>(), north_deg, 1e-10);
  const PlacedPlots back = read_plot_features(file, "EPSG:32632");
  EXPECT_TRUE(back.from_degrees);
  EXPECT_NEAR(intersection_over_union(back.plots.at(0).box, box), 1, 1e-6);
}

TEST(Estimate, WritesOneLineAPlot) {
  const TemporaryFolder folder;
  write_estimate(folder.path(), two_plots());
  EXPECT_EQ(
      read_text(folder.path() / "heights.csv"),
      "plot_number,row_number,col_number,center_x_m,center_y_m,width_m,length_m,heading_deg,points,"
      "height_raw-p99_m,height_voxel-max_m,flags\n"
      "1,1,2,500000.125,1,1.5,4,28.64788975654116,1234,0.75,0.7,\n"
      "2,,,9,9,1.5,4,28.64788975654116,0,,,\n");
}

Estimate with_intervals() {
  Estimate estimate = two_plots();
  estimate.method = "lattice";
  PlotEstimate& plot = estimate.plots[0];
  plot.heights_m = {{"canopy_p95", 0.7}, {"max", 0.8125}};
  plot.errors = {{"canopy_p95", {0.01, 0.68, 0.72}}, {"max", {0.02, 0.77, 0.86}}};
  plot.box_error = {.along_m = 0.03, .across_m = 0.02, .width_m = 0.05, .length_m = 0.06};
  plot.box_error->heading_rad = 0.1 * kDegrees;
  plot.confidence = 0.75;
  plot.flags = {"few returns", "no ground within reach"};
  estimate.plots[1].confidence = 1;
  return estimate;
}

TEST(Estimate, ReadsErrorsConfidenceAndFlags) {
  const TemporaryFolder folder;
  write_estimate(folder.path(), with_intervals());
  const Estimate read = read_estimate(folder.path());
  ASSERT_EQ(read.plots.size(), 2u);
  const PlotEstimate& plot = read.plots[0];
  EXPECT_EQ(plot.heights_m, (std::map<std::string, double>{{"canopy_p95", 0.7}, {"max", 0.8125}}));
  ASSERT_EQ(plot.errors.size(), 2u);
  EXPECT_EQ(plot.errors.at("max").standard_error_m, 0.02);
  EXPECT_EQ(plot.errors.at("max").low95_m, 0.77);
  EXPECT_EQ(plot.errors.at("canopy_p95").high95_m, 0.72);
  EXPECT_EQ(plot.confidence, 0.75);
  ASSERT_TRUE(plot.box_error.has_value());
  EXPECT_EQ(plot.box_error->along_m, 0.03);
  EXPECT_EQ(plot.box_error->across_m, 0.02);
  EXPECT_EQ(plot.box_error->width_m, 0.05);
  EXPECT_EQ(plot.box_error->length_m, 0.06);
  EXPECT_NEAR(plot.box_error->heading_rad, 0.1 * kDegrees, 1e-12);
  EXPECT_FALSE(read.plots[1].box_error.has_value());
  EXPECT_THAT(plot.flags, ::testing::ElementsAre("few returns", "no ground within reach"));
  EXPECT_TRUE(read.plots[1].errors.empty());
  EXPECT_TRUE(read.plots[1].flags.empty());
}

TEST(Estimate, TabulatesErrorsBesideTheirHeights) {
  const TemporaryFolder folder;
  write_estimate(folder.path(), with_intervals());
  EXPECT_EQ(
      read_text(folder.path() / "heights.csv"),
      "plot_number,row_number,col_number,center_x_m,center_y_m,width_m,length_m,heading_deg,points,"
      "canopy_p95_m,se_canopy_p95_m,low95_canopy_p95_m,high95_canopy_p95_m,"
      "height_max_m,se_height_max_m,low95_height_max_m,high95_height_max_m,"
      "se_center_along_m,se_center_across_m,se_width_m,se_length_m,se_heading_deg,confidence,"
      "flags\n"
      "1,1,2,500000.125,1,1.5,4,28.64788975654116,1234,0.7,0.01,0.68,0.72,0.8125,0.02,0.77,0.86,"
      "0.03,0.02,0.05,0.06,0.1,0.75,\"few returns; no ground within reach\"\n"
      "2,,,9,9,1.5,4,28.64788975654116,0,,,,,,,,,,,,,,1,\n");
}

TEST(Estimate, NumbersTrialsWhereThereAreSeveral) {
  const TemporaryFolder folder;
  Estimate estimate = two_plots();
  estimate.plots[0].trial = 1;
  estimate.plots[1].trial = 2;
  write_estimate(folder.path(), estimate);
  const std::string table = read_text(folder.path() / "heights.csv");
  EXPECT_THAT(table, ::testing::StartsWith("plot_number,trial_number,row_number,col_number,"));
  EXPECT_THAT(table, ::testing::HasSubstr("\n1,1,1,2,"));
  EXPECT_THAT(table, ::testing::HasSubstr("\n2,2,,,"));
  const Estimate read = read_estimate(folder.path());
  EXPECT_EQ(read.plots[0].trial, 1);
  EXPECT_EQ(read.plots[1].trial, 2);
}

// Of given boxes: nothing was searched, so there is no confidence.
TEST(Estimate, TabulatesFlagsOfGivenPlots) {
  const TemporaryFolder folder;
  Estimate estimate = two_plots();
  estimate.plots[1].flags = {"no points"};
  write_estimate(folder.path(), estimate);
  const std::string table = read_text(folder.path() / "heights.csv");
  EXPECT_THAT(table, ::testing::HasSubstr("height_voxel-max_m,flags\n"));
  EXPECT_THAT(table, ::testing::HasSubstr("0.75,0.7,\n"));
  EXPECT_THAT(table, ::testing::EndsWith(",,\"no points\"\n"));
}

// Breedbase's name of a plot, as the id and beside another one.
TEST(Estimate, TabulatesTheNamesOfADatabasesUnits) {
  const TemporaryFolder folder;
  const auto table_of = [&](const std::string& properties) {
    const auto map = folder.write(
        "map.geojson",
        R"({"type":"FeatureCollection","features":[{"type":"Feature","properties":)" + properties +
            R"(,"geometry":{"type":"Polygon","coordinates":[[[0,0],[1,0],[1,4],[0,4],[0,0]]]}}]})");
    Estimate estimate{.method = "",
                      .plots = {{.box = {.center = {0.5, 2}, .width_m = 1, .length_m = 4}}}};
    take_names(read_plot_map(map, "", 1), estimate);
    write_traits(folder.path() / "traits.csv", estimate);
    return read_text(folder.path() / "traits.csv");
  };
  EXPECT_EQ(table_of(R"({"name":"x","observationunit_name":"U-7"})"),
            "observationunit_name,row_number,col_number,name,flags\nU-7,,,x,\n");
  EXPECT_EQ(table_of(R"({"plot_number":7,"observationunit_name":"U-7"})"),
            "observationunit_name,row_number,col_number,plot_number,given_observationunit_name,"
            "flags\n7,,,7,U-7,\n");
}

// Names of ids as people write them; the name comes back as it is spelt.
TEST(PlotMap, TakesIdsWhateverTheSpellingOfTheirName) {
  const TemporaryFolder folder;
  for (const char* name : {"PLOT_ID", "Plot ID", "plotid", "Plot_Id"}) {
    const auto file = folder.path() / "map.geojson";
    write_plot_features(file, {{.box = {.width_m = 1, .length_m = 4},
                                .properties = {{"Entry", "x"}, {name, "A-12"}}}});
    const PlotMap map = read_plot_map(file, "", 1);
    EXPECT_EQ(map.id_property, name);
    EXPECT_EQ(map.ids.at(0), PlotId("A-12"));
    const auto book = folder.write("book.csv", std::string("Row,COL,") + name + "\n1,2,A-12\n");
    EXPECT_EQ(read_named_places(book).plots.at({1, 2}).id, PlotId("A-12")) << name;
  }
}

// Eight plots of 2 x 6 m, 3 m apart, and a border drawn around them.
TEST(PlotMap, NotesBoxesOverOthers) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "map.geojson";
  std::vector<PlotFeature> plots;
  for (int i = 0; i < 8; ++i)
    plots.push_back({.box = {.center = {3.0 * i, 0}, .width_m = 6, .length_m = 2},
                     .properties = {{"plot_id", i + 1}}});
  write_plot_features(file, plots);
  EXPECT_THAT(read_plot_map(file, "", 1).notes, ::testing::IsEmpty());
  plots.insert(plots.begin() + 3, {.box = {.center = {10.5, 0}, .width_m = 8, .length_m = 25},
                                   .properties = {{"plot_id", "BORDER"}}});
  write_plot_features(file, plots);
  const PlotMap map = read_plot_map(file, "", 1);
  EXPECT_THAT(map.notes, ::testing::ElementsAre(HasSubstr(
                             "plot BORDER over 8 others; is a border drawn around plots")));
  Estimate estimate{.method = "lattice", .plots = std::vector<PlotEstimate>(9)};
  take_names(map, estimate);
  EXPECT_THAT(estimate.diagnostics.notes.value(), map.notes);
  plots.erase(plots.begin() + 3);
  plots[1].box.center.x() = 0.9;  // of plot 1, over more than half of it
  write_plot_features(file, plots);
  EXPECT_THAT(read_plot_map(file, "", 1).notes,
              ::testing::ElementsAre(HasSubstr("plot 1 over 1 other;")));
}

TEST(PlotMap, NotesDegreesThatAreRoundedToDecimetres) {
  const TemporaryFolder folder;
  const auto file = folder.write(
      "map.geojson",
      R"({"type":"FeatureCollection","features":[{"type":"Feature","properties":{"plot_id":7},)"
      R"("geometry":{"type":"Polygon","coordinates":[[[9,0],[9.000018,0],[9.000018,0.000054],)"
      R"([9,0.000054],[9,0]]]}}]})");
  EXPECT_THAT(read_plot_map(file, "EPSG:32632", 1).notes,
              ::testing::ElementsAre(HasSubstr("the map's degrees have 6 decimals: corners of "
                                               "boxes are rounded to 0.11 m; save it")));
}

TEST(Estimate, IsReadWithoutPlotsFromAFolderOfOurs) {
  const TemporaryFolder folder;
  write_estimate(folder.path(), {.method = "lattice"});
  folder.write("manifest.json", R"({"command":"estimator run","options":{"method":"lattice"},)"
                                R"("results":{"diagnostics":{"why_no_plots":"a reason"}}})");
  const Estimate read = read_estimate(folder.path());
  EXPECT_TRUE(read.plots.empty());
  EXPECT_EQ(read.method, "lattice");
  EXPECT_EQ(read.diagnostics.why_no_plots, "a reason");
}

std::string geojson(const std::string& properties) {
  return R"({"type":"FeatureCollection","features":[{"type":"Feature","properties":)" + properties +
         R"(,"geometry":{"type":"Polygon","coordinates":[[[0,0],[4,0],[4,2],[0,2],[0,0]]]}}]})";
}

TEST(Estimate, ReadsPlotsOfOtherPrograms) {
  const TemporaryFolder folder;
  folder.write("plots.geojson",
               geojson(R"({"height_mine_m":0.5,"height_x":1,"height__m":2,"height_no_m":null})"));
  const Estimate read = read_estimate(folder.path());
  EXPECT_EQ(read.method, "");
  ASSERT_EQ(read.plots.size(), 1u);
  EXPECT_EQ(read.plots[0].id, 1u);
  EXPECT_EQ(read.plots[0].heights_m, (std::map<std::string, double>{{"mine", 0.5}}));
}

TEST(Estimate, SaysWhatIsMissing) {
  const TemporaryFolder folder;
  const auto message = [&] {
    return message_of<InputError>([&] { read_estimate(folder.path()); });
  };
  EXPECT_THAT(message(), HasSubstr("plots.geojson"));
  folder.write("plots.geojson", geojson(R"({"plot_number":-7,"height":1})"));
  EXPECT_THAT(message(), HasSubstr("no plot has a height"));
  folder.write("plots.geojson", R"({"type":"FeatureCollection","features":[]})");
  EXPECT_THAT(message(), HasSubstr("has no plots"));
}

TEST(Estimate, IdsAreDifferent) {
  const TemporaryFolder folder;
  PlotFeature plot{.box = {.width_m = 1, .length_m = 2},
                   .properties = {{"plot_number", 7}, {"height_mine_m", 0.5}}};
  write_plot_features(folder.path() / "two.geojson", {plot, plot});
  EXPECT_THAT(message_of<InputError>([&] { read_estimate(folder.path() / "two.geojson"); }),
              HasSubstr("two plots with the id 7"));
}

}  // namespace
}  // namespace plotscan::estimate
