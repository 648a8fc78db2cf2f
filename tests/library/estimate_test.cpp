// SPDX-License-Identifier: Apache-2.0
// Estimates of points in memory against the program's estimate of the same points in a file.
#include "plotscan/estimate.h"

#include <cmath>
#include <limits>
#include <memory>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "chain/programs.h"
#include "example_scan.h"
#include "plotscan/clouds.h"
#include "plotscan/score.h"

namespace plotscan {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

std::string text_of(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

class EstimateField : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<fs::path>(fs::temp_directory_path() /
                                         ("plotscan-library-" + std::to_string(getpid())));
    fs::create_directories(*folder_);
    testing::make_example_scan(*folder_);
    cloud_ = std::make_unique<Cloud>(read_cloud(*folder_ / "scan"));
  }
  static void TearDownTestSuite() {
    fs::remove_all(*folder_);
    folder_.reset();
    cloud_.reset();
  }

  static std::vector<std::array<double, 3>> doubles() {
    std::vector<std::array<double, 3>> points;
    const PointsView view = cloud_->positions();
    for (std::size_t i = 0; i < view.size(); ++i) points.push_back(view[i]);
    return points;
  }

  static std::unique_ptr<fs::path> folder_;
  static std::unique_ptr<Cloud> cloud_;
};
std::unique_ptr<fs::path> EstimateField::folder_;
std::unique_ptr<Cloud> EstimateField::cloud_;

TEST_F(EstimateField, SaysWhatTheProgramSaysOfTheSamePoints) {
  const auto finished = testing::run("estimator run scan -o program", folder_->string());
  ASSERT_EQ(finished.exit_code, 0) << finished.errors;
  const FieldEstimate field = estimate_field(cloud_->positions());
  EXPECT_EQ(field.geojson, text_of(*folder_ / "program/plots.geojson"));
  ASSERT_EQ(field.plots.size(), 9u);
  const auto features = nlohmann::json::parse(field.geojson)["features"];
  for (std::size_t i = 0; i < features.size(); ++i) {
    const auto& said = features[i]["properties"];
    const Plot& plot = field.plots[i];
    EXPECT_EQ(plot.id, std::to_string(said["plot_number"].get<int>()));
    EXPECT_EQ(plot.heights.at("max").value_m, said["height_max_m"].get<double>());
    EXPECT_EQ(plot.heights.at("max").low95_m, said["low95_height_max_m"].get<double>());
    EXPECT_EQ(plot.box_error.value().across_m, said["se_center_across_m"].get<double>());
    EXPECT_EQ(plot.box_error.value().length_m, said["se_length_m"].get<double>());
    EXPECT_NEAR(plot.box.heading_deg, said["heading_deg"].get<double>(), 1e-9);
  }
}

TEST_F(EstimateField, ReadsDoublesFloatsAndRecordsAlike) {
  const std::string records = estimate_field(cloud_->positions()).geojson;
  const auto points = doubles();
  EXPECT_EQ(estimate_field(PointsView(points)).geojson, records);
  std::vector<float> wide(5 * points.size());  // five columns
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      wide[5 * i + axis] = static_cast<float>(points[i][axis]);
  }
  const PointsView columns(wide.data(), points.size(), 5 * sizeof(float));
  EXPECT_EQ(estimate_field(columns, {.threads = 1}).geojson, records);
}

// Where points are many, another sample of them is taken in another place.
TEST_F(EstimateField, CountsFromTheOriginOfFloats) {
  const Point* first = cloud_->points.data();
  const PointsView moved(&first->x, cloud_->points.size(), sizeof(Point),
                         {500'000, 4'100'000, 300});
  const FieldEstimate here = estimate_field(cloud_->positions());
  const FieldEstimate there = estimate_field(moved);
  ASSERT_EQ(there.plots.size(), here.plots.size());
  for (std::size_t i = 0; i < here.plots.size(); ++i) {
    EXPECT_NEAR(there.plots[i].box.center_y_m - 4'100'000, here.plots[i].box.center_y_m, 1e-3);
    EXPECT_NEAR(there.plots[i].heights.at("p95").value_m, here.plots[i].heights.at("p95").value_m,
                3e-3);
  }
  EXPECT_NEAR(there.ground->z_m.at(there.ground->z_m.size() / 2), 300, 1);
}

TEST_F(EstimateField, MeasuresInGivenBoxesAndScoresAgainstTheTruth) {
  EstimateOptions options;
  for (const TruePlot& plot : read_truth(*folder_ / "farm")) options.boxes.push_back(plot.box);
  const FieldEstimate given = estimate_field(cloud_->positions(), options);
  const Scores scores = score_estimate(given, *folder_ / "farm");
  EXPECT_EQ(scores.found, 9u);
  EXPECT_NEAR(scores.iou_mean, 1, 1e-9);
  EXPECT_NEAR(scores.center_rmse_m, 0, 1e-9);
  for (const HeightScore& score : scores.heights) {
    const bool is_named_truth = score.height == "max" && score.truth == "height_max_m";
    EXPECT_TRUE(!is_named_truth || score.rmse_m < 0.06) << score.rmse_m;
  }
}

TEST_F(EstimateField, ScoresMemoryAsItsFiles) {
  const FieldEstimate field = estimate_files({*folder_ / "scan"}, *folder_ / "files");
  EXPECT_EQ(text_of(*folder_ / "files/plots.geojson"), field.geojson);
  const auto in_memory = score_estimate(field, *folder_ / "farm");
  const auto in_files = score_estimate(*folder_ / "files", *folder_ / "farm");
  EXPECT_EQ(in_memory.found, in_files.found);
  EXPECT_EQ(nlohmann::json::parse(in_memory.json)["heights"],
            nlohmann::json::parse(in_files.json)["heights"]);
}

TEST_F(EstimateField, SaysWhyThereAreNoPlots) {
  std::vector<std::array<double, 3>> bare;
  for (int i = 0; i < 90'000; ++i) bare.push_back({0.1 * (i % 300), 0.1 * (i / 300), 0});
  const FieldEstimate field = estimate_field(PointsView(bare));
  EXPECT_TRUE(field.plots.empty());
  EXPECT_FALSE(field.why_no_plots.empty());
  EXPECT_EQ(field.ground->z_m.at(field.ground->z_m.size() / 2), 0);
}

template <class Work>
std::string words_of(const Work& work) {
  try {
    work();
  } catch (const BadInput& error) {
    return error.what();
  }
  return "nothing thrown";
}

TEST_F(EstimateField, RefusesWhatTheProgramRefusesInTheSameWords) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<std::array<double, 3>> none(5, {nan, 0, 0});
  EXPECT_EQ(words_of([&] { estimate_field(PointsView(none)); }),
            "the cloud has no point that is finite");
  EXPECT_THAT(words_of([&] {
                estimate_field(cloud_->positions(), {.settings = {{"plot_width_m", 1000.0}}});
              }),
              HasSubstr("plot_width_m 1000 must be in [0.1, 100]"));
  EXPECT_THAT(words_of([&] {
                estimate_field(cloud_->positions(), {.crop_box = {{900, 900, 901, 901}}});
              }),
              HasSubstr("points lies in the crop box"));
  const auto finished = testing::run("estimator run none.pcd -o e", folder_->string());
  EXPECT_EQ(finished.exit_code, 2);
  EXPECT_EQ("estimator: " + words_of([] { estimate_files({"none.pcd"}, "e"); }) + "\n",
            finished.errors);
}

TEST_F(EstimateField, RefusesBoxesThatAreNone) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Box sound{.center_x_m = 0, .center_y_m = 0, .width_m = 1.5, .length_m = 4};
  const auto said = [&](const Box& box) {
    return words_of([&] { estimate_field(cloud_->positions(), {.boxes = {sound, box}}); });
  };
  for (const Box& box :
       {Box{.width_m = -1, .length_m = 4}, Box{.width_m = 1, .length_m = 0},
        Box{.width_m = nan, .length_m = 4}, Box{.center_x_m = nan, .width_m = 1, .length_m = 4},
        Box{.width_m = 1, .length_m = 4, .heading_deg = HUGE_VAL}})
    EXPECT_THAT(said(box), HasSubstr("box 2 of 2: its centre and heading must be finite"));
  Box far = sound;
  far.center_x_m = 500'000;
  EXPECT_THAT(words_of([&] { estimate_field(cloud_->positions(), {.boxes = {far}}); }),
              HasSubstr("points lies in the given boxes"));
}

TEST_F(EstimateField, RefusesClassesBeyondThoseOfLas) {
  for (const int number : {-1, 256}) {
    EXPECT_EQ(words_of([&] {
                estimate_files({*folder_ / "scan"}, *folder_ / "classes",
                               {.leave_out_classes = {2, number}});
              }),
              "leave_out_classes has " + std::to_string(number) + "; ASPRS classes are 0 to 255");
  }
}

TEST_F(EstimateField, ReportsProgressAndEndsWhereItThrows) {
  std::vector<double> shares;
  estimate_field(cloud_->positions(), {}, [&](double share) { shares.push_back(share); });
  EXPECT_TRUE(std::ranges::is_sorted(shares));
  EXPECT_EQ(shares.back(), 1);
  struct Enough {};
  const fs::path stopped = *folder_ / "stopped";
  EXPECT_THROW(estimate_files({*folder_ / "scan"}, stopped, {}, [](double) { throw Enough(); }),
               Enough);
  EXPECT_FALSE(fs::exists(stopped));
}

// The library that estimates holds nothing that could see the truth, and shows only its functions.
TEST_F(EstimateField, HoldsNoFarm) {
  const auto symbols = [&](const std::string& library) {
    return testing::run("nm -DC --defined-only " PLOTSCAN_LIBRARIES_DIR "/" + library +
                            " | grep -v ' [VW] '",
                        folder_->string())
        .output;
  };
  EXPECT_THAT(symbols("libplotscan_estimate.so"), HasSubstr("plotscan::estimate_field("));
  EXPECT_THAT(symbols("libplotscan_simulate.so"), HasSubstr("plotscan::generate_farm("));
  for (const char* library : {"libplotscan_estimate.so", "libplotscan_simulate.so"}) {
    for (const char* inner : {"plotscan::estimate::", "plotscan::farm::", "plotscan::score::"})
      EXPECT_THAT(symbols(library), ::testing::Not(HasSubstr(inner))) << library;
  }
  const auto all =
      testing::run("strings " PLOTSCAN_LIBRARIES_DIR "/libplotscan_estimate.so | grep truth/plots",
                   folder_->string());
  EXPECT_EQ(all.output, "");
}

}  // namespace
}  // namespace plotscan
