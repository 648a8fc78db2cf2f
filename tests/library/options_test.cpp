// SPDX-License-Identifier: Apache-2.0
// Every option of the library does what the program's does: the same bytes, the manifest's account
// of the options among them.
#include <memory>

#include "chain/programs.h"
#include "example_scan.h"
#include "plotscan/clouds.h"
#include "plotscan/estimate.h"
#include "plotscan/score.h"
#include <gmock/gmock.h>

namespace plotscan {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

class LibraryOptions : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<fs::path>(fs::temp_directory_path() /
                                         ("plotscan-options-" + std::to_string(getpid())));
    fs::create_directories(*folder_);
    testing::make_example_scan(*folder_);
    convert_cloud(path("scan"), cloud());
  }
  static void TearDownTestSuite() {
    fs::remove_all(*folder_);
    folder_.reset();
  }

  static fs::path path(const std::string& name) { return *folder_ / name; }
  static fs::path cloud() { return path("scan.las"); }
  static void run_program(const std::string& command) {
    const auto finished = testing::run(command, *folder_);
    ASSERT_EQ(finished.exit_code, 0) << command << '\n' << finished.errors;
  }
  static void expect_same(const std::string& ours, const std::string& theirs) {
    const auto finished = testing::run("diff -r " + ours + " " + theirs, *folder_);
    EXPECT_EQ(finished.exit_code, 0) << finished.output << finished.errors;
  }

  static std::unique_ptr<fs::path> folder_;
};
std::unique_ptr<fs::path> LibraryOptions::folder_;

TEST_F(LibraryOptions, OfEstimatesAreTheProgramsHints) {
  run_program("estimator run " + cloud().string() +
              " -o hints_theirs --crop-box=-9,-8,9,8 --heading 91 --plot-width 1.5 --plot-length 4 "
              "--rows 3 --columns 3 --crop soybean --noise 0.02 --no-calibration --units m "
              "--leave-out-class 5,6 --seed 9 --csv theirs.csv");
  EstimateFilesOptions options{.units = "m", .leave_out_classes = {5, 6}, .seed = 9};
  options.csv = path("ours.csv");
  options.field = {.crop_box = {{-9, -8, 9, 8}}, .heading_deg = 91, .plot_width_m = 1.5};
  options.field.plot_length_m = 4;
  options.field.rows = options.field.columns = 3;
  options.field.crop = "soybean";
  options.field.noise_m = 0.02;
  options.field.calibrated = false;
  EXPECT_EQ(estimate_files({cloud()}, path("hints_ours"), options).plots.size(), 9u);
  expect_same("hints_ours", "hints_theirs");
  expect_same("ours.csv", "theirs.csv");
  EXPECT_THROW(estimate_files({cloud()}, path("hints_ours"), options), BadInput);
  options.replace = true;
  estimate_files({cloud()}, path("hints_ours"), options);
  expect_same("hints_ours", "hints_theirs");
  options.units = "yards";
  EXPECT_THROW(estimate_files({cloud()}, path("yards"), options), BadInput);
}

TEST_F(LibraryOptions, OfEstimatesAreTheProgramsMapsAndMethods) {
  const std::string map = path("farm/truth/plots.geojson");
  run_program("estimator run " + cloud().string() + " -o map_theirs --boxes " + map +
              " --id plot_number");
  estimate_files({cloud()}, path("map_ours"), {.boxes = map, .id = "plot_number"});
  expect_same("map_ours", "map_theirs");
  run_program("estimator run " + cloud().string() +
              " -o paper_theirs --method dhami2020 --plots 9");
  const auto paper =
      estimate_files({cloud()}, path("paper_ours"), {.field = {.plots = 9}, .method = "dhami2020"});
  expect_same("paper_ours", "paper_theirs");
  EXPECT_EQ(paper.method, "dhami2020");
}

TEST_F(LibraryOptions, OfFlightsAreTheProgramsSettings) {
  run_program(
      "lidarsim fly farm -o flown_theirs --lever-arm 0.1,0,0.05 --heading 30 --pattern crosshatch "
      "--speed 6 --format las --seed 5");
  fly(path("farm"), path("flown_ours"),
      {.settings = {{"lever_arm_m", std::array{0.1, 0.0, 0.05}},
                    {"heading_deg", 30.0},
                    {"pattern", "crosshatch"},
                    {"speed_m_s", 6.0}},
       .formats = {"las"},
       .seed = 5});
  expect_same("flown_ours", "flown_theirs");
  const std::string flight = path("flown_ours/trajectory.csv");
  run_program("lidarsim fly farm -o again_theirs --flight " + flight);
  fly(path("farm"), path("again_ours"), {.trajectory = flight});
  expect_same("again_ours", "again_theirs");
  EXPECT_THROW(fly(path("farm"), path("again_ours"), {.trajectory = flight}), BadInput);
  fly(path("farm"), path("again_ours"), {.trajectory = flight, .replace = true});
  expect_same("again_ours", "again_theirs");
}

TEST_F(LibraryOptions, OfCloudsAreEncodingsAndReplacement) {
  const Cloud points = read_cloud(cloud());
  EXPECT_THAT(points.fields, ::testing::IsSupersetOf({"intensity", "class"}));
  write_cloud(path("text.pcd"), points.points, {.encoding = "ascii"});
  EXPECT_THAT(testing::run("head -n 12 text.pcd", *folder_).output, HasSubstr("DATA ascii"));
  EXPECT_THROW(convert_cloud(cloud(), path("text.pcd")), BadInput);
  convert_cloud(cloud(), path("text.pcd"), {.encoding = "binary", .replace = true});
  run_program("lidarsim convert scan.las binary.pcd --encoding binary");
  expect_same("text.pcd", "binary.pcd");
}

TEST_F(LibraryOptions, OfScoresAreTheLeastOverlap) {
  const FieldEstimate field = estimate_field(read_cloud(cloud()).positions());
  EXPECT_EQ(score_estimate(field, path("farm")).found, 9u);
  const Scores strict = score_estimate(field, path("farm"), 0.9999);
  EXPECT_EQ(strict.found, 0u);
  EXPECT_EQ(strict.missed, 9u);
  EXPECT_EQ(strict.extra, 9u);
}

}  // namespace
}  // namespace plotscan
