// SPDX-License-Identifier: Apache-2.0
#include "core/plot_features.h"

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "temporary_folder.h"

namespace plotscan {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using testing::message_of;
using testing::TemporaryFolder;

TEST(PlotFeatures, ComeBackAsWritten) {
  const TemporaryFolder folder;
  const PlotFeature plot{
      .box = {.center = {1.5, -2.25}, .width_m = 1.5, .length_m = 4, .heading_rad = 0.7},
      .properties = {{"plot_number", 7}, {"height_max_m", 0.61}}};
  write_plot_features(folder.path() / "plots.geojson", {plot});
  const auto read = read_plot_features(folder.path() / "plots.geojson");
  ASSERT_EQ(read.size(), 1u);
  EXPECT_EQ(read[0].box.center, plot.box.center);
  EXPECT_NEAR(intersection_over_union(read[0].box, plot.box), 1, 1e-12);
  EXPECT_EQ(read[0].properties["plot_number"], 7);
  EXPECT_EQ(read[0].properties["height_max_m"], 0.61);
}

// Polygons in the cloud's feet, attributes in metres.
TEST(PlotFeatures, AreInTheUnitsOfTheCloud) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "feet.geojson";
  const PlotFeature plot{.box = {.center = {30.48, 60.96}, .width_m = 1.5, .length_m = 4}};
  write_plot_features(file, {plot}, "EPSG:2264", CoordinateUnits{kFoot_m, 1});
  const auto document = nlohmann::json::parse(read_text(file));
  const auto& corners = document["features"][0]["geometry"]["coordinates"][0];
  EXPECT_NEAR((corners[0][0].get<double>() + corners[2][0].get<double>()) / 2, 100, 1e-9);
  EXPECT_NEAR((corners[0][1].get<double>() + corners[2][1].get<double>()) / 2, 200, 1e-9);
  EXPECT_EQ(document["features"][0]["properties"]["center_x_m"], 30.48);
  EXPECT_EQ(read_plot_features(file).at(0).box.center, plot.box.center);
  EXPECT_EQ(read_plot_features(file, "").units, (CoordinateUnits{kFoot_m, 1}));
  write_plot_features(file, {plot});
  EXPECT_EQ(read_plot_features(file, "").units, std::nullopt);
}

constexpr const char* kForeign =
    R"({"type": "FeatureCollection", "features": [{"type": "Feature", "properties": null,
  "geometry": {"type": "Polygon", "coordinates": [[%s]]}}]})";

std::string foreign(const std::string& ring) {
  std::string text = kForeign;
  return text.replace(text.find("%s"), 2, ring);
}

// A text is its own first entry to who walks through lists; deep lists end the stack.
TEST(PlotFeatures, RefusesTextForCoordinatesAndDeepNesting) {
  const TemporaryFolder folder;
  const auto refusal = [&](const std::string& ring) {
    const auto file = folder.write("q.geojson", foreign(ring));
    return testing::message_of<InputError>([&] { read_plot_features(file, "EPSG:32616"); });
  };
  EXPECT_THAT(refusal("\"1e300\""), ::testing::HasSubstr("is no map of plots"));
  EXPECT_THAT(refusal(std::string(100000, '[') + std::string(100000, ']')),
              ::testing::HasSubstr("is nested deeper than 100"));
  // Brackets in texts do not count.
  EXPECT_THAT(refusal("\"" + std::string(200, '[') + "\\\"\""),
              ::testing::HasSubstr("is no map of plots"));
}

TEST(PlotFeatures, ReadsABareRectangle) {
  const TemporaryFolder folder;
  const auto plots =
      read_plot_features(folder.write("q.geojson", foreign("[0,0],[0,3],[-1,3],[-1,0],[0,0]")));
  ASSERT_EQ(plots.size(), 1u);
  EXPECT_NEAR(plots[0].box.length_m, 3, 1e-12);
  EXPECT_NEAR(plots[0].box.width_m, 1, 1e-12);
  EXPECT_NEAR(plots[0].box.heading_rad, std::acos(0.0), 1e-12);
  EXPECT_NEAR(plots[0].box.center.x(), -0.5, 1e-12);
}

TEST(PlotFeatures, ReadsAMultiPolygonOfOnePart) {
  const TemporaryFolder folder;
  std::string text = foreign("[0,0],[0,3],[-1,3],[-1,0],[0,0]");
  text.replace(text.find("\"Polygon\""), 9, "\"MultiPolygon\"");
  text.replace(text.find("[[["), 3, "[[[[").replace(text.find("]]]"), 3, "]]]]");
  EXPECT_NEAR(read_plot_features(folder.write("q.geojson", text)).at(0).box.length_m, 3, 1e-12);
}

TEST(PlotFeatures, RefusesAPolygonThatWasMovedAwayFromItsBox) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "plots.geojson";
  write_plot_features(file, {{.box = {.center = {100, 50}, .width_m = 1.5, .length_m = 4},
                              .properties = {{"plot_number", 1}}}});
  auto document = nlohmann::json::parse(read_text(file));
  for (auto& corner : document["features"][0]["geometry"]["coordinates"][0]) {
    corner[0] = corner[0].get<double>() + 1.2;
  }
  EXPECT_THROW(read_plot_features(folder.write("moved.geojson", document.dump())), InputError);
  for (auto& corner : document["features"][0]["geometry"]["coordinates"][0]) {
    corner[0] = std::round((corner[0].get<double>() - 1.2) * 1000) / 1000;
  }
  EXPECT_NO_THROW(read_plot_features(folder.write("rounded.geojson", document.dump())));
}

// A turned plot as a GIS rounds it to decimetres, one corner given twice, a vertex on an edge, the
// ring left open and running clockwise.
TEST(PlotFeatures, FitsTheNearestRectangle) {
  const TemporaryFolder folder;
  const PlotBox box{
      .center = {512345.67, 4123456.78}, .width_m = 1.5, .length_m = 4, .heading_rad = 0.4};
  auto corners = box.corners();
  std::ranges::reverse(corners);
  const auto rounded = [](double value) { return std::round(value * 10) / 10; };
  std::string ring;
  const auto add = [&](const Eigen::Vector2d& at) {
    ring += (ring.empty() ? "[" : ",[") + std::to_string(rounded(at.x())) + "," +
            std::to_string(rounded(at.y())) + "]";
  };
  add(corners[0]);
  add(corners[0]);
  add((corners[0] + corners[1]) / 2);
  for (std::size_t i = 1; i < 4; ++i) add(corners[i]);
  const auto plots = read_plot_features(folder.write("gis.geojson", foreign(ring)));
  EXPECT_LT((plots.at(0).box.center - box.center).norm(), 0.07);
  EXPECT_NEAR(plots[0].box.length_m, 4, 0.1);
  EXPECT_NEAR(plots[0].box.width_m, 1.5, 0.1);
  EXPECT_LT(heading_difference(plots[0].box.heading_rad, 0.4), 0.03);
}

TEST(PlotFeatures, NamesThePlotThatIsNoRectangle) {
  const TemporaryFolder folder;
  std::string text = foreign("[0,0],[4,0],[4.6,1.5],[0.6,1.5],[0,0]");
  text.replace(text.find("null"), 4, R"({"plot_id": "A-12"})");
  EXPECT_THAT(testing::message_of<InputError>(
                  [&] { read_plot_features(folder.write("bad.geojson", text)); }),
              ::testing::HasSubstr("feature 1 (plot_id \"A-12\") is not a rectangle: it is up to"));
}

// On the central meridian at the equator a degree's metres are known: 0.9996 of the ellipsoid's.
constexpr const char* kFourMetresNorth =
    "[9,0],[9.00001348,0],[9.00001348,3.61896e-5],"
    "[9,3.61896e-5],[9,0]";

TEST(PlotFeatures, TellDegreesOfFewDecimals) {
  const TemporaryFolder folder;
  const auto decimals = [&](const std::string& ring, const std::string& crs = "EPSG:32632") {
    return read_plot_features(folder.write("lonlat.geojson", foreign(ring)), crs).few_decimals;
  };
  EXPECT_EQ(decimals("[9,0],[9.000013,0],[9.000013,3.6e-5],[9,3.6e-5],[9,0]"), 6);
  EXPECT_EQ(decimals("[179.99991,60],[179.99999,60],[179.99999,60.0001],[179.99991,60.0001]",
                     "EPSG:32660"),
            5);
  EXPECT_EQ(decimals("[9,0],[9.000013,0],[9.000013,3.61e-5],[9,3.61e-5],[9,0]"), std::nullopt);
  EXPECT_EQ(decimals("[500000,0],[500002,0],[500002,4],[500000,4]"), std::nullopt);  // metres
}

TEST(PlotFeatures, ConvertsLongitudeAndLatitude) {
  const TemporaryFolder folder;
  for (const std::string crs :
       {"", R"("crs":{"properties":{"name":"urn:ogc:def:crs:OGC:1.3:CRS84"}},)"}) {
    std::string text = foreign(kFourMetresNorth);
    text.insert(1, crs);
    const PlacedPlots placed =
        read_plot_features(folder.write("lonlat.geojson", text), "EPSG:32632");
    EXPECT_TRUE(placed.from_degrees);
    EXPECT_EQ(placed.few_decimals, std::nullopt);
    const PlotBox box = placed.plots.at(0).box;
    EXPECT_NEAR(box.length_m, 0.9996 * 3.61896e-5 * 110574.276, 1e-4);
    EXPECT_NEAR(box.width_m, 0.9996 * 1.348e-5 * 111319.491, 1e-4);
    EXPECT_NEAR(box.center.x(), 5e5 + box.width_m / 2, 1e-4);
    EXPECT_NEAR(box.center.y(), box.length_m / 2, 1e-4);
  }
}

// Germany and south-eastern Australia with the latitude first; what lies as near both ways is taken
// as it stands.
TEST(PlotFeatures, SuspectsLatitudesThatStandFirst) {
  const TemporaryFolder folder;
  const auto refusal = [&](const std::string& ring, const std::string& crs) {
    std::string text = foreign(ring);
    text.insert(1, R"("crs":{"properties":{"name":"urn:ogc:def:crs:OGC:1.3:CRS84"}},)");
    return testing::message_of<InputError>(
        [&] { read_plot_features(folder.write("lonlat.geojson", text), crs); });
  };
  const std::string german =
      "[48.7,9.2],[48.7,9.20002],[48.70004,9.20002],[48.70004,9.2],[48.7,9.2]";
  EXPECT_THAT(
      refusal(german, "EPSG:32632"),
      ::testing::HasSubstr("has longitude 48.7 and latitude 9.2, far from UTM zone 32 of the "
                           "cloud: they are probably swapped"));
  const std::string australian =
      "[-33.8,151.2],[-33.8,151.20002],[-33.80004,151.20002],[-33.80004,151.2],[-33.8,151.2]";
  EXPECT_THAT(refusal(australian, "EPSG:32756"), ::testing::HasSubstr("probably swapped"));
  const std::string nigerian = "[9,10],[9.00002,10],[9.00002,10.00004],[9,10.00004],[9,10]";
  std::string text = foreign(nigerian);
  EXPECT_EQ(read_plot_features(folder.write("lonlat.geojson", text), "EPSG:32632").plots.size(),
            1U);
}

TEST(PlotFeatures, TakesDegreesForMetresNowhere) {
  const TemporaryFolder folder;
  const auto file = [&](const std::string& members) {
    std::string text = foreign(kFourMetresNorth);
    return folder.write("plots.geojson", text.insert(1, members));
  };
  const auto message = [](const std::filesystem::path& path, const std::string& crs) {
    return testing::message_of<InputError>([&] { read_plot_features(path, crs); });
  };
  const std::string wgs84 = R"("crs":{"properties":{"name":"urn:ogc:def:crs:EPSG::4326"}},)";
  EXPECT_THAT(message(file(wgs84), ""), ::testing::HasSubstr("known here (estimator run: --crs)"));
  EXPECT_THAT(message(file(wgs84), "EPSG:2193"), ::testing::HasSubstr("EPSG:2193"));
  const std::string other = R"("crs":{"properties":{"name":"urn:ogc:def:crs:EPSG::32633"}},)";
  EXPECT_THAT(message(file(other), "EPSG:32632"), ::testing::HasSubstr("EPSG:32633"));
}

// A GIS's map over a cloud in feet; UTM's code over one in feet makes no degrees.
TEST(PlotFeatures, TakesTheUnitsOfTheCloud) {
  const TemporaryFolder folder;
  const auto file = folder.write("feet.geojson", foreign("[0,0],[0,10],[-5,10],[-5,0],[0,0]"));
  for (const std::string crs : {"", "EPSG:2264", "EPSG:32632"}) {
    const PlacedPlots placed = read_plot_features(file, crs, kFoot_m);
    EXPECT_FALSE(placed.from_degrees);
    EXPECT_NEAR(placed.plots.at(0).box.length_m, 3.048, 1e-12);
    EXPECT_NEAR(placed.plots.at(0).box.width_m, 1.524, 1e-12);
  }
  write_plot_features(file, read_plot_features(file), "EPSG:2264", CoordinateUnits{0.5, 1});
  EXPECT_NEAR(read_plot_features(file, "EPSG:2264", kFoot_m).plots.at(0).box.length_m, 10, 1e-12)
      << "the file's own units";
}

// Metres of the cloud's own zone under its other name, and local ones that the file calls local.
TEST(PlotFeatures, LeavesMetresAsTheyAre) {
  const TemporaryFolder folder;
  for (const std::string members :
       {R"("crs":{"properties":{"name":"urn:ogc:def:crs:EPSG::25832"}},)",
        R"("coordinate_system":"local metres",)"}) {
    std::string text = foreign("[0,0],[0,3],[-1,3],[-1,0],[0,0]");
    const PlacedPlots placed =
        read_plot_features(folder.write("metres.geojson", text.insert(1, members)), "EPSG:32632");
    EXPECT_FALSE(placed.from_degrees);
    EXPECT_NEAR(placed.plots.at(0).box.length_m, 3, 1e-12);
  }
}

TEST(PlotFeatures, RefusesWhatIsNoPlot) {
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& text) {
    EXPECT_THROW(read_plot_features(folder.write("bad.geojson", text)), InputError) << text;
  };
  refused("not json");
  refused("{}");
  refused(foreign("[0,0],[0,3],[-1,3],[0,0]"));
  refused(foreign("[0,0],[1,3],[-1,3],[-1,0],[0,0]"));
  refused(foreign("[0,0],[0,\"3\"],[-1,3],[-1,0],[0,0]"));
  EXPECT_THROW(read_plot_features(folder.path() / "absent.geojson"), InputError);
}

TEST(PlotFeatures, AMapOfAMillionPlotsIsRefusedBeforeItIsParsed) {
  const TemporaryFolder folder;
  const auto file = folder.write("plots.geojson", "{}");
  std::filesystem::resize_file(file, 64'000'001);
  EXPECT_THAT(testing::message_of<InputError>([&] { read_plot_features(file); }),
              ::testing::HasSubstr("has 64000001 bytes; plots are read from up to 64000000"));
}

TEST(PlotFeatures, AFolderStandsForItsMap) {
  const TemporaryFolder folder;
  const auto map = folder.write("estimate/plots.geojson", "{}");
  const auto truth = folder.write("farm/truth/plots.geojson", "{}");
  EXPECT_EQ(plot_map_of(folder.path() / "estimate"), map);
  EXPECT_EQ(plot_map_of(folder.path() / "farm"), truth);
  EXPECT_EQ(plot_map_of(map), map);
  EXPECT_EQ(estimated_map_of(folder.path() / "estimate"), map);
  EXPECT_EQ(estimated_map_of(truth), truth);
}

TEST(PlotFeatures, AFolderWithoutAMapIsRefused) {
  const TemporaryFolder folder;
  for (const auto map_of : {plot_map_of, estimated_map_of}) {
    EXPECT_THAT(message_of<InputError>([&] { map_of(folder.path()); }),
                HasSubstr("is a folder without a map of plots (plots.geojson)"));
  }
}

// Even one with a plots.geojson of its own.
TEST(PlotFeatures, AFarmsFolderIsNoEstimatedMap) {
  const TemporaryFolder folder;
  const auto truth = folder.write("farm/truth/plots.geojson", "{}");
  folder.write("farm/plots.geojson", "{}");
  EXPECT_THAT(message_of<InputError>([&] { estimated_map_of(folder.path() / "farm"); }),
              AllOf(HasSubstr("farm: is a farm's folder, and its map is the truth"),
                    HasSubstr("name the file: " + truth.string())));
}

}  // namespace
}  // namespace plotscan
