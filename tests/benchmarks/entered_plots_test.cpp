// SPDX-License-Identifier: Apache-2.0
#include "farmbench/entry/entered_plots.h"

#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "temporary_folder.h"

namespace plotscan::farmbench {
namespace {

namespace fs = std::filesystem;
using plotscan::testing::message_of;
using plotscan::testing::TemporaryFolder;
using ::testing::HasSubstr;

// What read_entered_plots makes of a file, and all that is wrong with it.
struct Read {
  EnteredPlots plots;
  std::string problems;
};

Read read_file(const TemporaryFolder& folder, const std::string& name, const std::string& text) {
  Problems problems;
  Read read{.plots = read_entered_plots(folder.write(name, text), problems), .problems = ""};
  try {
    problems.raise(folder.path());
  } catch (const InputError& error) {
    read.problems = error.what();
  }
  return read;
}

TEST(EnteredPlots, ATableMayHaveBoxesHeightsAndIntervals) {
  const TemporaryFolder folder;
  const Read read =
      read_file(folder, "a.csv",
                "plot_number,center_x_m,center_y_m,width_m,length_m,heading_deg,height_p99_m,"
                "low95_height_p99_m,high95_height_p99_m,canopy_p95_m,confidence,flags\n"
                "A-1,1,2,0.5,4,90,0.8,0.7,0.9,NA,0.5,lodged; few points\n"
                "0102,3,2,0.5,4,90,,,,0.6,,\n");
  EXPECT_EQ(read.problems, "");
  ASSERT_EQ(read.plots.plots.size(), 2U);
  EXPECT_TRUE(read.plots.boxes_stated);
  const estimate::PlotEstimate& first = read.plots.plots[0];
  EXPECT_EQ(first.id.text(), "A-1");
  EXPECT_EQ(first.box.center, Eigen::Vector2d(1, 2));
  EXPECT_NEAR(first.box.heading_rad, std::acos(0.0), 1e-15);
  EXPECT_EQ(first.heights_m, (std::map<std::string, double>{{"p99", 0.8}}));
  EXPECT_EQ(first.errors.at("p99").low95_m, 0.7);
  EXPECT_EQ(first.errors.at("p99").high95_m, 0.9);
  EXPECT_TRUE(std::isnan(first.errors.at("p99").standard_error_m));
  EXPECT_EQ(first.confidence, 0.5);
  EXPECT_EQ(first.flags, (std::vector<std::string>{"lodged", "few points"}));
  EXPECT_EQ(read.plots.plots[1].id.text(), "0102");
  EXPECT_EQ(read.plots.plots[1].heights_m, (std::map<std::string, double>{{"canopy_p95", 0.6}}));
}

// pandas makes a column with gaps one of floats.
TEST(EnteredPlots, ANumberMayBeWrittenAsAFloat) {
  const TemporaryFolder folder;
  const Read read =
      read_file(folder, "a.csv", "plot_number,height_p99_m\n7.0,0.5\nV1.0,0.6\n10,0.6\n");
  EXPECT_EQ(read.problems, "");
  ASSERT_EQ(read.plots.plots.size(), 3U);
  EXPECT_EQ(read.plots.plots[0].id, PlotId(7));
  EXPECT_EQ(read.plots.plots[1].id.text(), "V1.0");
  EXPECT_EQ(read.plots.plots[2].id, PlotId(10));
}

TEST(EnteredPlots, AStandardErrorIsNotNegative) {
  const TemporaryFolder folder;
  const Read read =
      read_file(folder, "a.csv", "plot_number,height_p99_m,se_height_p99_m\n7,0.5,-5\n");
  EXPECT_THAT(read.problems, HasSubstr("a standard error is not negative"));
}

TEST(EnteredPlots, BoxesAloneAndHeightsAloneWillDo) {
  const TemporaryFolder folder;
  const Read boxes =
      read_file(folder, "a.csv", "center_x_m,center_y_m,width_m,length_m,heading_deg\n1,2,1,4,0\n");
  EXPECT_EQ(boxes.problems, "");
  EXPECT_TRUE(boxes.plots.boxes_stated);
  EXPECT_TRUE(boxes.plots.plots.at(0).heights_m.empty());
  Read heights = read_file(folder, "b.csv", "plot_number,height_p99_m\n7,0.5\n8,0.6\n");
  EXPECT_EQ(heights.problems, "");
  EXPECT_FALSE(heights.plots.boxes_stated);
  Problems problems;
  take_boxes(heights.plots,
             {{.id = 7, .box = {.center = {3, 4}, .width_m = 1, .length_m = 2}},
              {.id = 8, .box = {.width_m = 1, .length_m = 1}, .scored = false}},
             problems);
  EXPECT_EQ(heights.plots.plots[0].box.center, Eigen::Vector2d(3, 4));
  EXPECT_THAT(message_of<InputError>([&] { problems.raise("there"); }),
              HasSubstr("b.csv:3: no box has the plot_number 8"));
}

TEST(EnteredPlots, GeoJsonIsReadAsAnyMapOfPlots) {
  const TemporaryFolder folder;
  const Read read = read_file(folder, "a.geojson", R"({"type": "FeatureCollection", "features": [
    {"type": "Feature", "id": 4, "properties": {"height_max_m": 1.5, "crop": "oats"},
     "geometry": {"type": "Polygon", "coordinates": [[[0,0],[4,0],[4,1],[0,1],[0,0]]]}}]})");
  EXPECT_EQ(read.problems, "");
  ASSERT_EQ(read.plots.plots.size(), 1U);
  EXPECT_EQ(read.plots.plots[0].id.text(), "4");
  EXPECT_NEAR(read.plots.plots[0].box.length_m, 4, 1e-9);
  EXPECT_NEAR(read.plots.plots[0].box.width_m, 1, 1e-9);
  EXPECT_EQ(read.plots.plots[0].heights_m.at("max"), 1.5);
}

TEST(EnteredPlots, FlagsOfAFeatureAreAListOrATextAsInATable) {
  const TemporaryFolder folder;
  const auto read = [&](const std::string& flags) {
    return read_file(
        folder, "a.geojson",
        R"({"features": [{"id": 1, "geometry": null, "properties": {"flags": )" + flags + "}}]}");
  };
  const std::vector<std::string> two = {"low", "at the edge"};
  EXPECT_EQ(read(R"("low; at the edge")").plots.plots[0].flags, two);
  EXPECT_EQ(read(R"(["low", "at the edge"])").plots.plots[0].flags, two);
  EXPECT_TRUE(read("null").plots.plots[0].flags.empty());
  for (const char* neither : {"3", "[3]", "true"})
    EXPECT_THAT(read(neither).problems, HasSubstr("it must be a list of texts, or a text"));
}

TEST(EnteredPlots, GeoJsonThatSaysNothingIsNoEntry) {
  const TemporaryFolder folder;
  const auto read = [&](const std::string& properties) {
    return read_file(folder, "a.geojson",
                     "\xef\xbb\xbf"
                     R"({"features": [{"geometry": null, "properties": {)" +
                         properties + "}}]}")
        .problems;
  };
  EXPECT_THAT(read(R"("plot_number": 1, "height_mean": 0.5)"),
              HasSubstr("a.geojson: no plot has a box or a height, a property such as"));
  EXPECT_THAT(read(R"("plot_number": 1, "height_mean_m": NaN)"),
              HasSubstr("a.geojson: not JSON: "));
  EXPECT_EQ(read(R"("plot_number": 1, "height_mean_m": null)"), "");
}

TEST(EnteredPlots, ATableThatSaysNothingIsNoEntry) {
  const TemporaryFolder folder;
  EXPECT_THAT(read_file(folder, "a.csv", "plot_number,confidence\n1,0.5\n").problems,
              HasSubstr("a.csv:1: no column is a height, such as height_mean_m, or of a box"));
  EXPECT_EQ(read_file(folder, "b.csv", "plot_number,confidence\n").problems, "");
}

TEST(EnteredPlots, EveryProblemIsToldAtOnce) {
  const TemporaryFolder folder;
  const std::string told =
      read_file(folder, "a.csv",
                "plot_number,center_x_m,center_y_m,width_m,length_m,heading_deg,heigth_p99_m,"
                "height_p95_m,low95_height_p95_m,high95_height_p95_m,confidence\n"
                "1,1,2,0.5,4,90,0.8,tall,,,\n"
                "2,1,2,,4,90,0.8,0.7,,,\n"
                "2,1,2,-1,4,90,0.8,0.7,0.9,0.8,7\n"
                "3,1,2,1,4,90,0.8,,0.9,,\n"
                "4,1,2,1,4,90,0.8,1e9,,,\n"
                "5,,,,,,,1,,,\n")
          .problems;
  for (const char* problem :
       {"10 problems", "a.csv:1: there is no column \"heigth_p99_m\"; height_p99_m may be meant",
        "a.csv:2: height_p95_m is \"tall\"; it must be a number, or empty",
        "a.csv:3: a box is center_x_m", "a.csv:4: plot_number 2 stands in a.csv:3 as well",
        "a.csv:4: its box has no width", "a.csv:4: the interval of height_p95_m has two ends",
        "a.csv:4: confidence is 7", "a.csv:5: low95_height_p95_m belongs to height_p95_m",
        "a.csv:6: height_p95_m is 1000000000.0; it must be metres",
        "a.csv: 5 of its 6 plots have boxes; all do, or none"}) {
    EXPECT_THAT(told, HasSubstr(problem));
  }
  EXPECT_THAT(read_file(folder, "a.geojson", R"({"features": [{"properties": {"height_max_m": "x"},
    "geometry": {"type": "Point", "coordinates": [1, 2]}}, 7]})")
                  .problems,
              ::testing::AllOf(HasSubstr("a.geojson: feature 1: has geometry \"Point\""),
                               HasSubstr("a.geojson: feature 1: height_max_m is \"x\""),
                               HasSubstr("a.geojson: feature 2: is no feature")));
  for (const char* text : {"{", "{\"features\": 3}", "", "\x01\x02"})
    EXPECT_NE(read_file(folder, "b.csv", text).problems, "") << text;
  fs::create_symlink("/etc/passwd", folder.path() / "c.csv");
  Problems problems;
  read_entered_plots(folder.path() / "c.csv", problems);
  EXPECT_THAT(message_of<InputError>([&] { problems.raise("there"); }), HasSubstr("is no file"));
}

}  // namespace
}  // namespace plotscan::farmbench
