// SPDX-License-Identifier: Apache-2.0
#include "core/plot_features.h"

#include "temporary_folder.h"

#include "core/error.h"

namespace plotscan {
namespace {

TEST(PlotFeatures, ComeBackAsWritten) {
  const testing::TemporaryFolder folder;
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
  const testing::TemporaryFolder folder;
  const auto file = folder.path() / "feet.geojson";
  const PlotFeature plot{.box = {.center = {30.48, 60.96}, .width_m = 1.5, .length_m = 4}};
  write_plot_features(file, {plot}, "EPSG:2264", CoordinateUnits{kFoot_m, 1});
  const auto document = nlohmann::json::parse(read_text(file));
  const auto& corners = document["features"][0]["geometry"]["coordinates"][0];
  EXPECT_NEAR((corners[0][0].get<double>() + corners[2][0].get<double>()) / 2, 100, 1e-9);
  EXPECT_NEAR((corners[0][1].get<double>() + corners[2][1].get<double>()) / 2, 200, 1e-9);
  EXPECT_EQ(document["features"][0]["properties"]["center_x_m"], 30.48);
  EXPECT_EQ(read_plot_features(file).at(0).box.center, plot.box.center);
  EXPECT_EQ(read_coordinate_units(file), (CoordinateUnits{kFoot_m, 1}));
  write_plot_features(file, {plot});
  EXPECT_EQ(read_coordinate_units(file), std::nullopt);
}

constexpr const char* kForeign =
    R"({"type": "FeatureCollection", "features": [{"type": "Feature", "properties": null,
  "geometry": {"type": "Polygon", "coordinates": [[%s]]}}]})";

std::string foreign(const std::string& ring) {
  std::string text = kForeign;
  return text.replace(text.find("%s"), 2, ring);
}

TEST(PlotFeatures, ReadsABareRectangle) {
  const testing::TemporaryFolder folder;
  const auto plots =
      read_plot_features(folder.write("q.geojson", foreign("[0,0],[0,3],[-1,3],[-1,0],[0,0]")));
  ASSERT_EQ(plots.size(), 1u);
  EXPECT_NEAR(plots[0].box.length_m, 3, 1e-12);
  EXPECT_NEAR(plots[0].box.width_m, 1, 1e-12);
  EXPECT_NEAR(plots[0].box.heading_rad, std::acos(0.0), 1e-12);
  EXPECT_NEAR(plots[0].box.center.x(), -0.5, 1e-12);
}

TEST(PlotFeatures, ReadsAMultiPolygonOfOnePart) {
  const testing::TemporaryFolder folder;
  std::string text = foreign("[0,0],[0,3],[-1,3],[-1,0],[0,0]");
  text.replace(text.find("\"Polygon\""), 9, "\"MultiPolygon\"");
  text.replace(text.find("[[["), 3, "[[[[").replace(text.find("]]]"), 3, "]]]]");
  EXPECT_NEAR(read_plot_features(folder.write("q.geojson", text)).at(0).box.length_m, 3, 1e-12);
}

TEST(PlotFeatures, RefusesAPolygonThatWasMovedAwayFromItsBox) {
  const testing::TemporaryFolder folder;
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

TEST(PlotFeatures, RefusesWhatIsNoPlot) {
  const testing::TemporaryFolder folder;
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

}  // namespace
}  // namespace plotscan
