// SPDX-License-Identifier: Apache-2.0
// `estimator score`: files in, files out.
#include "score/run.h"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/angle.h"
#include "core/error.h"
#include "core/geodesy.h"
#include "core/place_json.h"
#include "core/plot_features.h"
#include "estimator/score/turned_box.h"
#include "score/score_files.h"
#include "temporary_folder.h"

namespace plotscan::score {
namespace {

using plotscan::testing::message_of;
using plotscan::testing::TemporaryFolder;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class ScoreRun : public ::testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directories(folder_.path() / "farm" / "truth");
    write_plot_features(
        folder_.path() / "farm" / "truth" / "plots.geojson",
        {{turned_box(0), {{"plot_number", 4}, {"plants", 90}, {"height_max_m", 0.6}}},
         {turned_box(5), {{"plot_number", 7}, {"plants", 90}, {"height_max_m", 0.8}}}});
    write_plot_features(estimate_, {{turned_box(5), {{"plot_number", 1}, {"height_mine_m", 0.9}}}});
  }

  TemporaryFolder folder_;
  std::filesystem::path estimate_ = folder_.path() / "anyones.geojson";
};

TEST_F(ScoreRun, ReadsAnyonesEstimateAndWritesTheScores) {
  const Scores scores = run({.estimate = estimate_,
                             .truth = folder_.path() / "farm",
                             .output = folder_.path() / "scores"});
  EXPECT_EQ(scores.boxes.found, 1U);
  EXPECT_EQ(scores.boxes.missed, 1U);
  ASSERT_EQ(scores.heights.size(), 1U);  // plants is no height
  EXPECT_EQ(scores.heights[0].height, "mine");
  EXPECT_NEAR(scores.heights[0].bias_m, 0.1, 1e-12);
  EXPECT_EQ(scores.field.plots[1].truth.id, 7U);
  const auto document = nlohmann::json::parse(read_text(folder_.path() / "scores" / "scores.json"));
  EXPECT_EQ(document["boxes"]["missed"], 1);
  EXPECT_NEAR(document["heights"][0]["rmse_m"].get<double>(), 0.1, 1e-12);
  EXPECT_TRUE(document["heights"][0]["r2"].is_null());
  EXPECT_TRUE(std::filesystem::exists(folder_.path() / "scores" / "manifest.json"));
}

TEST_F(ScoreRun, TakesTruthsOfTheCanopy) {
  const std::filesystem::path truth = folder_.path() / "canopy.geojson";
  write_plot_features(truth, {{turned_box(5), {{"canopy_p95_m", 0.7}, {"height_max_m", 0.8}}}});
  const Scores scores = run({.estimate = estimate_, .truth = truth});
  ASSERT_EQ(scores.heights.size(), 2U);
  EXPECT_EQ(scores.heights[0].truth, "canopy_p95_m");
  EXPECT_NEAR(scores.heights[0].bias_m, 0.2, 1e-12);
}

TEST_F(ScoreRun, SaysWhyThereIsNothingToCompare) {
  const auto notes_for = [&](double x, const nlohmann::json& properties) {
    const std::filesystem::path truth = folder_.path() / "truth.geojson";
    write_plot_features(truth, {{turned_box(x), properties}});
    return run({.estimate = estimate_, .truth = truth}).notes;
  };
  EXPECT_THAT(notes_for(5, {{"height_max_m", 0.7}}), IsEmpty());
  EXPECT_THAT(notes_for(20, {{"height_max_m", 0.7}}), ElementsAre(HasSubstr("same coordinates?")));
  EXPECT_THAT(notes_for(5, {{"height_max_m", "0.7"}}), ElementsAre(HasSubstr("no true plot has")));
}

// A farm at 49 degrees north, 2 degrees east of its zone's middle, whose grid there is turned by
// 2 sin 49 degrees (the meridian convergence); its plots, by the functions that bring clouds into
// UTM, as the estimate.
class FarmOnEarth : public ScoreRun {
 protected:
  void SetUp() override {
    ScoreRun::SetUp();
    folder_.write("farm/manifest.json",
                  nlohmann::json{{"results", {{"anchor", anchor_json(kAnchor)}}}}.dump());
  }
  // An estimate of both plots, as corners that `project` makes of the world's.
  template <class Project>
  nlohmann::json estimate_of(const Project& project) const {
    nlohmann::json features = nlohmann::json::array();
    for (const double x : {0.0, 5.0}) {
      nlohmann::json ring = nlohmann::json::array();
      for (const Eigen::Vector2d& corner : turned_box(x).corners()) {
        const Eigen::Vector2d place =
            project(geodetic_from_world(kAnchor, {corner.x(), corner.y(), 0}));
        ring.push_back({place.x(), place.y()});
      }
      ring.push_back(ring.front());
      features.push_back({{"type", "Feature"},
                          {"properties", {{"height_max_m", 0.7}}},
                          {"geometry", {{"type", "Polygon"}, {"coordinates", {ring}}}}});
    }
    return {{"type", "FeatureCollection"}, {"features", features}};
  }
  nlohmann::json in_utm() const {
    nlohmann::json map = estimate_of([](const GeodeticPoint& point) -> Eigen::Vector2d {
      return utm_from_geodetic(kZone, point).head<2>();
    });
    map["crs"] = {{"type", "name"}, {"properties", {{"name", "urn:ogc:def:crs:EPSG::32632"}}}};
    return map;
  }
  nlohmann::json in_degrees() const {
    nlohmann::json map = estimate_of([](const GeodeticPoint& point) -> Eigen::Vector2d {
      return {point.longitude_deg, point.latitude_deg};
    });
    map["coordinate_system"] = "WGS84 longitude, latitude in degrees";
    return map;
  }
  static constexpr Anchor kAnchor = {.latitude_deg = 49, .longitude_deg = 11, .altitude_m = 300};
  static constexpr UtmZone kZone = {.number = 32, .north = true};
};

TEST_F(FarmOnEarth, IsComparedWithEstimatesInUtmAndInDegrees) {
  const std::filesystem::path farm = folder_.path() / "farm";
  for (const nlohmann::json& map : {in_utm(), in_degrees()}) {
    const Scores scores =
        run({.estimate = folder_.write("map.geojson", map.dump()), .truth = farm});
    EXPECT_EQ(scores.boxes.found, 2U);
    EXPECT_THAT(scores.notes, IsEmpty());
    EXPECT_GT(scores.boxes.iou_min, 0.999);
    EXPECT_LT(scores.boxes.center_rmse_m, 1e-3);
    EXPECT_LT(scores.boxes.heading_rmse_rad, 1e-3);
  }
  const std::vector<TruePlot> truth = read_truth(farm, "EPSG:32632");
  const double turned = std::atan(std::tan(2 * kDegrees) * std::sin(49 * kDegrees));
  EXPECT_NEAR(heading_difference(truth[0].box.heading_rad, turned_box(0).heading_rad), turned,
              1e-4);
}

// A map of true plots in degrees, beside an estimate in UTM; and of no place that is known.
TEST_F(FarmOnEarth, MapsInDegreesAreTruthsOrRefused) {
  const std::filesystem::path utm = folder_.write("utm.geojson", in_utm().dump());
  const std::filesystem::path degrees = folder_.write("degrees.geojson", in_degrees().dump());
  EXPECT_EQ(run({.estimate = utm, .truth = degrees}).boxes.found, 2U);
  EXPECT_EQ(run({.estimate = degrees, .truth = utm}).boxes.found, 2U);
  EXPECT_THAT(message_of<InputError>([&] { run({.estimate = estimate_, .truth = degrees}); }),
              HasSubstr("degrees.geojson: is in longitude and latitude"));
  EXPECT_THAT(message_of<InputError>([&] { run({.estimate = degrees, .truth = estimate_}); }),
              HasSubstr("degrees.geojson: is in longitude and latitude"));
}

// Without its place on Earth nothing relates the two.
TEST_F(FarmOnEarth, SaysThatNothingOverlaps) {
  std::filesystem::remove(folder_.path() / "farm" / "manifest.json");
  const Scores scores = run({.estimate = folder_.write("map.geojson", in_utm().dump()),
                             .truth = folder_.path() / "farm"});
  EXPECT_EQ(scores.boxes.found, 0U);
  EXPECT_THAT(scores.notes,
              ElementsAre(::testing::AllOf(
                  HasSubstr("do not overlap at all: estimated plots lie within x 646"),
                  HasSubstr("true ones within x -"))));
  EXPECT_EQ(to_json(scores)["notes"], nlohmann::json(scores.notes));
}

// Centimetres under the name of metres, on either side.
TEST_F(ScoreRun, HintsAtCentimetres) {
  const auto notes_of = [&](double estimated, double true_height) {
    const std::filesystem::path truth = folder_.path() / "truth.geojson";
    write_plot_features(truth, {{turned_box(5), {{"height_max_m", true_height}}}});
    write_plot_features(estimate_, {{turned_box(5), {{"height_max_m", estimated}}}});
    return run({.estimate = estimate_, .truth = truth}).notes;
  };
  EXPECT_THAT(notes_of(72, 0.7), ElementsAre(HasSubstr("Estimated heights are about 100 times")));
  EXPECT_THAT(notes_of(0.72, 70), ElementsAre(HasSubstr("True heights are about 100 times")));
  EXPECT_THAT(notes_of(2, 0.1), IsEmpty());
}

TEST_F(ScoreRun, RefusesAnEstimatesFolderAsTheTruth) {
  const std::filesystem::path folder = folder_.path() / "estimate";
  std::filesystem::create_directory(folder);
  std::filesystem::copy_file(estimate_, folder / "plots.geojson");
  EXPECT_THAT(message_of<InputError>([&] { run({.estimate = estimate_, .truth = folder}); }),
              HasSubstr("estimate: is an estimate, and the truth is a farm's folder"));
  EXPECT_EQ(run({.estimate = estimate_, .truth = folder / "plots.geojson"}).boxes.found, 1U);
}

TEST_F(ScoreRun, SaysWhyAnEstimateHasNoPlots) {
  const std::vector<TruePlot> truth = read_truth(folder_.path() / "farm");
  estimate::Estimate none{.method = "m"};
  EXPECT_THAT(score(truth, none, {}).notes, IsEmpty());
  none.diagnostics.why_no_plots = "no canopy";
  EXPECT_THAT(score(truth, none, {}).notes, ElementsAre("The estimate has no plots: no canopy"));
}

TEST_F(ScoreRun, RefusesATruthThatHasAPlotTwice) {
  const auto truth_with = [&](int id, double x) {
    const std::filesystem::path truth = folder_.path() / "truth.geojson";
    write_plot_features(truth, {{turned_box(0), {{"plot_number", 4}}},
                                {turned_box(5), {{"plot_number", 7}}},
                                {turned_box(x), {{"plot_number", id}}}});
    return truth;
  };
  const auto message_for = [&](int id, double x) {
    return message_of<InputError>([&] { read_truth(truth_with(id, x)); });
  };
  EXPECT_THAT(message_for(4, 10), HasSubstr("truth.geojson: has two plots with the id 4"));
  EXPECT_THAT(message_for(8, 5.1), HasSubstr("has plots 7 and 8 at the same place"));
  EXPECT_EQ(read_truth(truth_with(8, 10)).size(), 3U);
}

TEST_F(ScoreRun, RefusesHeightsThatStandForNone) {
  for (const double height_m : {-9999.0, 1e30}) {
    write_plot_features(estimate_,
                        {{turned_box(5), {{"plot_number", 3}, {"height_p95_m", height_m}}}});
    EXPECT_THAT(message_of<InputError>([&] { read_truth(estimate_); }),
                HasSubstr("anyones.geojson: plot 3: height_p95_m is "));
    EXPECT_THAT(message_of<InputError>(
                    [&] { run({.estimate = estimate_, .truth = folder_.path() / "farm"}); }),
                HasSubstr("it must be metres, -100 to 1000"));
  }
}

TEST_F(ScoreRun, BadInputLeavesNothingBehind) {
  const std::filesystem::path scores = folder_.path() / "scores";
  EXPECT_THAT(message_of<InputError>(
                  [&] { run({.estimate = estimate_, .truth = folder_.path(), .output = scores}); }),
              HasSubstr("plots.geojson: no such file"));
  EXPECT_THAT(message_of<InputError>([&] {
                run({.estimate = estimate_,
                     .truth = folder_.path() / "farm",
                     .output = scores,
                     .score = {.min_iou = 2}});
              }),
              HasSubstr("at most 1"));
  EXPECT_FALSE(std::filesystem::exists(scores));
}

}  // namespace
}  // namespace plotscan::score
