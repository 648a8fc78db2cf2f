// SPDX-License-Identifier: Apache-2.0
#include "fieldpage/field_page.h"

#include <string>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/manifest.h"
#include "estimate/estimate.h"
#include "fieldpage/shown.h"
#include "temporary_folder.h"

namespace plotscan::fieldpage {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::message_of;
using testing::TemporaryFolder;

// A plot of 1 x 4 m whose west end lies at x.
std::string feature(const std::string& id, double x, const std::string& properties) {
  const auto corner = [&](double u, double v) {
    return "[" + std::to_string(x + u) + "," + std::to_string(v) + "]";
  };
  return R"({"type":"Feature","id":)" + id + R"(,"properties":{)" + properties +
         R"(},"geometry":{"type":"Polygon","coordinates":[[)" + corner(0, 0) + "," + corner(1, 0) +
         "," + corner(1, 4) + "," + corner(0, 4) + "," + corner(0, 0) + "]]}}";
}

std::string collection(const std::vector<std::string>& features) {
  std::string all;
  for (const std::string& one : features) all += (all.empty() ? "" : ",") + one;
  return R"({"type":"FeatureCollection","coordinate_system":"local metres","features":[)" + all +
         "]}";
}

nlohmann::json field_of(const fs::path& html) {
  const std::string page = read_text(html);
  const std::size_t begin = page.find('>', page.find("id=\"report\"")) + 1;
  return nlohmann::json::parse(
      page.substr(begin, page.find("</script>", begin) - begin))["fields"][0];
}

class FieldPage : public ::testing::Test {
 protected:
  TemporaryFolder folder_;
  fs::path html_ = folder_.path() / "page.html";
  fs::path estimate_ = folder_.write(
      "estimate.geojson",
      collection({feature(R"("<script>alert(1)</script>")", 0.1,
                          R"("height_max_m":0.9,"low95_height_max_m":0.8,"high95_height_max_m":1.0,
                          "se_height_max_m":0.05,"flags":["\"><img src=x onerror=alert(1)>"])"),
                  feature("2", 30, R"("height_max_m":0.5)")}));
  fs::path truth_ =
      folder_.write("truth.geojson", collection({feature("11", 0, R"("height_max_m":0.95)"),
                                                 feature("12", 6, R"("height_max_m":1.0)")}));
};

TEST_F(FieldPage, ShowsMeasuredHeightsBesideTheirPlotsAlone) {
  const fs::path table = folder_.write("ruler.csv", "plot_id,height_max_cm\n2,55\n");
  write_estimate_page({.estimate = estimate_, .html = html_, .truth = table});
  const nlohmann::json field = field_of(html_);
  EXPECT_NEAR(field["plots"][1]["truths"]["height_max_m"].get<double>(), 0.55, 1e-6);
  EXPECT_FALSE(field["plots"][0].contains("truths") && !field["plots"][0]["truths"].empty());
  EXPECT_TRUE(field.value("true_boxes", nlohmann::json::array()).empty());
}

TEST_F(FieldPage, FindsMeasuredPlotsByTheNamedColumn) {
  const fs::path table = folder_.write("ruler.csv", "parcel,height_max_cm\n2,55\n");
  write_estimate_page({.estimate = estimate_, .html = html_, .truth = table, .id = "parcel"});
  EXPECT_NEAR(field_of(html_)["plots"][1]["truths"]["height_max_m"].get<double>(), 0.55, 1e-6);
  EXPECT_THROW(write_estimate_page({.estimate = estimate_,
                                    .html = folder_.path() / "other.html",
                                    .truth = truth_,
                                    .id = "parcel"}),
               InputError);
}

TEST_F(FieldPage, SaysWhichPlotsAreFoundExtraAndMissed) {
  write_estimate_page({.estimate = estimate_, .html = html_, .truth = truth_});
  const nlohmann::json field = field_of(html_);
  const nlohmann::json& found = field["plots"][0];
  EXPECT_EQ(found["id"], "<script>alert(1)</script>");
  EXPECT_EQ(found["state"], "found");
  EXPECT_EQ(found["truths"]["height_max_m"], 0.95);
  EXPECT_EQ(found["heights"]["max"], nlohmann::json({0.9, 0.05, 0.8, 1.0}));
  EXPECT_EQ(field["plots"][1]["state"], "extra");
  EXPECT_EQ(field["true_boxes"][0]["found"], true);
  EXPECT_EQ(field["true_boxes"][1]["found"], false);
  EXPECT_FALSE(field.contains("cloud"));
  const std::string page = read_text(html_);
  EXPECT_EQ(page.find("<script>alert"), std::string::npos);
  EXPECT_EQ(page.find("<img"), std::string::npos);
}

TEST_F(FieldPage, ShowsHowAMethodCameToItsPlots) {
  const fs::path folder = folder_.path() / "estimate";
  fs::create_directories(folder);
  const PlotBox box{.center = {2, 3}, .width_m = 1, .length_m = 4};
  const PlotBox cluster{.center = {2.1, 3.2}, .width_m = 1.5, .length_m = 4.5};
  const estimate::PlotEstimate plot{
      .id = 7,
      .box = box,
      .heights_m = {{"raw-max", 0.8}},
      .ground = estimate::PlotGround{.z_m = 5, .slope = {0.1, 0.2}, .tolerance_m = 0.05}};
  estimate::write_estimate(folder, {.method = "dhami2020", .plots = {plot}, .clusters = {cluster}});
  write_estimate_page({.estimate = folder, .html = html_});
  const nlohmann::json working = field_of(html_)["workings"][0];
  EXPECT_EQ(working["clusters"], nlohmann::json({{2.1, 3.2, 1.5, 4.5, 0.0}}));
  EXPECT_EQ(working["plots"], nlohmann::json({{2.0, 3.0, 1.0, 4.0, 0.0}}));
  EXPECT_EQ(working["planes"][0]["z"], 5.0);
  EXPECT_EQ(working["planes"][0]["slope"], nlohmann::json({0.1, 0.2}));
  write_estimate_page({.estimate = estimate_, .html = folder_.path() / "other.html"});
  EXPECT_FALSE(field_of(folder_.path() / "other.html").contains("workings"));
}

TEST_F(FieldPage, HasTheNameOfItsFolder) {
  const fs::path folder = folder_.path() / "mine";
  fs::create_directories(folder);
  fs::copy_file(estimate_, folder / "plots.geojson");
  for (const char* place : {"mine", "mine/", "mine/.", "mine/../mine"}) {
    write_estimate_page({.estimate = folder_.path() / place, .html = html_, .replace = true});
    EXPECT_EQ(field_of(html_)["name"], "mine") << place;
  }
}

TEST_F(FieldPage, WithoutTruthNothingIsScored) {
  write_estimate_page({.estimate = estimate_, .html = html_});
  const nlohmann::json field = field_of(html_);
  EXPECT_EQ(field["plots"][0]["state"], "");
  EXPECT_TRUE(field["true_boxes"].empty());
}

// Positions far from the origin keep their millimetres.
TEST_F(FieldPage, ShowsTheCloudsPositions) {
  std::string text;
  for (int i = 0; i < 500; ++i)
    text +=
        std::to_string(500'000.001 + 0.01 * i) + " 4100000.002 " + std::to_string(0.001 * i) + "\n";
  const report::ShownCloud cloud = read_shown_positions(folder_.write("a.xyz", text), 1000);
  ASSERT_EQ(cloud.points.size(), 500U);
  EXPECT_EQ(cloud.origin.y(), 4'100'000);
  for (const report::ShownPoint& point : cloud.points) {
    EXPECT_NEAR(point.place.y(), 0.002, 1e-5);
    EXPECT_NEAR(point.place.x(), 0.001 + 10 * point.place.z(), 1e-4);
  }
}

// The file of the cloud does not say that it is in feet.
TEST_F(FieldPage, ShowsTheCloudInTheUnitsOfTheEstimate) {
  const std::string plot = feature("1", 10, R"("height_max_m":0.9)");
  const fs::path feet = folder_.write(
      "feet.geojson",
      R"({"type":"FeatureCollection","coordinate_units_m":{"x_y":0.3048,"z":0.3048},"features":[)" +
          plot + "]}");
  const fs::path cloud = folder_.write("a.xyz", "10.5 2 300\n10.6 2 301\n");
  write_estimate_page({.estimate = feet, .html = html_, .cloud = CloudFiles(cloud)});
  const nlohmann::json field = field_of(html_);
  EXPECT_THAT(field["notes"], IsEmpty());
  EXPECT_NEAR(field["plots"][0]["box"][0].get<double>(), 0.3048 * 10.5, 1e-4);
  const nlohmann::json& shown = field["cloud"];
  EXPECT_NEAR(shown["origin"][0].get<double>() + shown["tiles"][0]["low"][0].get<double>(),
              0.3048 * 10.5, 1e-3);
  CloudFiles in_metres(cloud);
  in_metres.units = CoordinateUnits{1, 1};
  const auto show = [&] {
    write_estimate_page({.estimate = feet, .html = html_, .cloud = in_metres, .replace = true});
  };
  EXPECT_THAT(message_of<InputError>(show), HasSubstr("was made with units of"));
}

// Text in degrees does not say so; where UTM's zone 17 has its middle, the results are known.
TEST_F(FieldPage, ShowsTheCloudInTheSystemThatWasTold) {
  const fs::path folder = folder_.path() / "estimate";
  fs::create_directories(folder);
  const fs::path cloud = folder_.write("a.xyz", "-81 0.00001 5\n-81 0.00002 6\n");
  const PlotBox box{.center = {500'000, 1.5}, .width_m = 1, .length_m = 4};
  estimate::write_estimate(folder, {.method = "lattice",
                                    .plots = {{.id = 1, .box = box, .heights_m = {{"max", 0.9}}}},
                                    .crs = "EPSG:32617"});
  write_manifest(
      folder, {.command = "estimator run", .options = {{"crs", "EPSG:4326"}}, .inputs = {cloud}});
  write_estimate_page({.estimate = folder, .html = html_, .cloud = CloudFiles(cloud)});
  EXPECT_THAT(field_of(html_)["notes"], IsEmpty());
}

// A farm whose centre lies where the equator crosses the middle of UTM's zone 32: at 500 km, 0.
TEST_F(FieldPage, BringsAFarmOnEarthIntoTheEstimatesUtm) {
  const fs::path farm = folder_.path() / "farm";
  const fs::path folder = folder_.path() / "estimate";
  fs::create_directories(farm / "truth");
  fs::create_directories(folder);
  folder_.write("farm/manifest.json",
                R"({"results":{"anchor":{"latitude_deg":0,"longitude_deg":9,"altitude_m":0}}})");
  PlotBox box{.center = {2, 3}, .width_m = 1, .length_m = 4};
  write_plot_features(farm / "truth" / "plots.geojson", {{box, {{"height_max_m", 0.95}}}});
  box.center.x() += 500'000;
  estimate::write_estimate(folder, {.method = "lattice",
                                    .plots = {{.id = 1, .box = box, .heights_m = {{"max", 0.9}}}},
                                    .crs = "EPSG:32632"});
  write_estimate_page({.estimate = folder, .html = html_, .truth = farm});
  const nlohmann::json field = field_of(html_);
  EXPECT_THAT(field["notes"], IsEmpty());
  ASSERT_EQ(field["plots"][0]["state"], "found");
  EXPECT_EQ(field["plots"][0]["truths"]["height_max_m"], 0.95);
}

TEST_F(FieldPage, SaysWhatLiesInOtherCoordinates) {
  const fs::path far =
      folder_.write("far.geojson", collection({feature("1", 500'000, R"("height_max_m":0.95)")}));
  const fs::path cloud = folder_.write("a.xyz", "500000.5 2 300\n500000.6 2 301\n");
  write_estimate_page(
      {.estimate = estimate_, .html = html_, .truth = far, .cloud = CloudFiles(cloud)});
  EXPECT_THAT(field_of(html_)["notes"], ElementsAre(HasSubstr("apart from the true ones"),
                                                    HasSubstr("a.xyz lies among the plots")));
}

// A plane through three points, at nodes around plots that lie 40 km apart.
TEST_F(FieldPage, ShowsTheTrueGroundOfAnyField) {
  report::ShownField field;
  for (const double x : {-20'000.0, 20'000.0})
    field.plots.push_back({.id = "1", .box = {.center = {x, 0}, .width_m = 1, .length_m = 4}});
  show_terrain(field, terrain::Terrain({{-30'000, -100, 0}, {30'000, -100, 600}, {0, 100, 300}},
                                       {{0, 1, 2}}));
  ASSERT_TRUE(field.terrain.has_value());
  const report::ShownGrid& grid = *field.terrain;
  EXPECT_LT(grid.z_m.size(), 2'000'000U);
  EXPECT_EQ(grid.z_m.size(), static_cast<std::size_t>(grid.columns) * grid.rows);
  const int column = grid.columns / 2;
  const double x = grid.first.x() + grid.cell_m * column;
  EXPECT_NEAR(grid.z_m.at(column), 300 + 0.01 * x, 0.01);
}

TEST_F(FieldPage, RefusesItsOwnInputsAndAPageThatExists) {
  EXPECT_THROW(write_estimate_page({.estimate = estimate_, .html = estimate_, .replace = true}),
               InputError);
  const fs::path cloud = folder_.write("a.xyz", "0 0 0\n1 1 1\n");
  EXPECT_THAT(
      message_of<InputError>([&] {
        write_estimate_page(
            {.estimate = estimate_, .html = cloud, .cloud = CloudFiles(cloud), .replace = true});
      }),
      HasSubstr("is the input"));
  EXPECT_EQ(read_text(cloud), "0 0 0\n1 1 1\n");
  write_estimate_page({.estimate = estimate_, .html = html_});
  EXPECT_THAT(
      message_of<InputError>([&] { write_estimate_page({.estimate = estimate_, .html = html_}); }),
      HasSubstr("exists"));
}

}  // namespace
}  // namespace plotscan::fieldpage
