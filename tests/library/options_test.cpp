// SPDX-License-Identifier: Apache-2.0
// Every option of the library does what the program's does: the same bytes, the manifest's account
// of the options among them.
#include <cmath>
#include <fstream>
#include <memory>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "chain/programs.h"
#include "example_scan.h"
#include "plotscan/clouds.h"
#include "plotscan/estimate.h"
#include "plotscan/score.h"

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
              "--rows 3 --columns 3 --crop soybean --noise 0.02 --ground-class 0,1,2 --units m "
              "--leave-out-class 5,6 --seed 9 --csv theirs.csv");
  EstimateFilesOptions options{.units = "m", .leave_out_classes = {5, 6}, .seed = 9};
  options.csv = path("ours.csv");
  options.field = {.crop_box = {{-9, -8, 9, 8}}};
  options.field.settings = {{"heading_deg", 91.0},  {"plot_width_m", 1.5},
                            {"plot_length_m", 4.0}, {"rows", 3.0},
                            {"columns", 3.0},       {"crop", "soybean"},
                            {"noise_m", 0.02},      {"ground_classes", std::vector{0.0, 1.0, 2.0}}};
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

TEST_F(LibraryOptions, OfNumbersAndFramesAreTheProgramsToo) {
  run_program("estimator run " + cloud().string() +
              " -o numbers_theirs --first-number 101 --numbering serpentine --first-corner "
              "ne");
  EstimateFilesOptions options;
  options.first_number = 101;
  options.numbering = "serpentine";
  options.first_corner = "ne";
  estimate_files({cloud()}, path("numbers_ours"), options);
  expect_same("numbers_ours", "numbers_theirs");
  options.crs = "EPSG:32617";
  EXPECT_THAT(
      testing::message_of<BadInput>([&] { estimate_files({cloud()}, path("nothing"), options); }),
      HasSubstr("EPSG:32617"));
}

TEST_F(LibraryOptions, OfRecordingsAreTheProgramsToo) {
  run_program("lidarsim convert scan scan.pcap");
  run_program(
      "estimator run scan.pcap -o packets_theirs --trajectory scan/trajectory.csv --sensor vlp16 "
      "--mount 0,90,0");
  EstimateFilesOptions options{.trajectory = path("scan") / "trajectory.csv", .sensor = "vlp16"};
  options.mount_rpy_deg = {{0, 90, 0}};
  estimate_files({path("scan.pcap")}, path("packets_ours"), options);
  expect_same("packets_ours", "packets_theirs");
}

TEST_F(LibraryOptions, OfEstimatesAreTheProgramsMapsAndMethods) {
  const std::string map = path("farm/truth/plots.geojson");
  run_program("estimator run " + cloud().string() + " -o map_theirs --boxes " + map +
              " --id plot_number --no-calibration");
  EstimateFilesOptions in_boxes{.boxes = map, .id = "plot_number"};
  in_boxes.field.settings = {{"calibrated", false}};
  estimate_files({cloud()}, path("map_ours"), in_boxes);
  expect_same("map_ours", "map_theirs");
  std::ofstream ruler(path("ruler.csv"));
  ruler << "plot_number,height_mean_cm\n";
  for (int plot = 1; plot <= 9; ++plot) ruler << plot << ",50\n";
  ruler.close();
  run_program("estimator run " + cloud().string() + " -o measured_theirs --measured ruler.csv");
  estimate_files({cloud()}, path("measured_ours"), {.measured = path("ruler.csv")});
  expect_same("measured_ours", "measured_theirs");
  run_program("estimator run " + cloud().string() +
              " -o paper_theirs --method dhami2020 --plots 9 --voxel 0.06 --learn-box=-9,-8,9,8");
  const EstimateOptions field{.settings = {{"plots", 9.0},
                                           {"voxel_m", 0.06},
                                           {"learn_box", std::vector{-9.0, -8.0, 9.0, 8.0}}}};
  const auto paper =
      estimate_files({cloud()}, path("paper_ours"), {.field = field, .method = "dhami2020"});
  expect_same("paper_ours", "paper_theirs");
  EXPECT_EQ(paper.method, "dhami2020");
}

TEST_F(LibraryOptions, OfMethodsAreTheProgramsSettings) {
  const std::string help = testing::run("estimator run --help", *folder_).output;
  for (const char* method : {"lattice", "dhami2020"}) {
    const std::vector<Setting> settings = estimate_settings(method);
    EXPECT_GE(settings.size(), 10u);
    EstimateOptions options;
    for (const Setting& setting : settings) {
      if (setting.usual) options.settings[setting.key] = *setting.usual;
    }
    options.settings["plots"] = 9.0;
    const std::string ours = std::string("usual_") + method;
    run_program("estimator run " + cloud().string() + " -o " + ours +
                "_theirs --plots 9 --method " + method);
    estimate_files({cloud()}, path(ours), {.field = options, .method = method});
    expect_same(ours, ours + "_theirs");
  }
  EXPECT_THROW(estimate_settings("other"), BadInput);
}

TEST_F(LibraryOptions, AreRefusedByTheirKeyAndKind) {
  const auto refused = [](const std::string& key, const SettingValue& value) -> std::string {
    try {
      estimate_field(read_cloud(cloud()).positions(), {.settings = {{key, value}}});
    } catch (const BadInput& error) {
      return error.what();
    }
    return "taken";
  };
  EXPECT_THAT(refused("row", 3.0), HasSubstr("lattice has no \"row\"; it has heading_deg"));
  EXPECT_EQ(refused("rows", 2.5), "lattice's rows is a whole number");
  EXPECT_EQ(refused("rows", "two"), "lattice's rows is a whole number");
  EXPECT_EQ(refused("noise_m", true), "lattice's noise_m is a number");
  EXPECT_EQ(refused("calibrated", 1.0), "lattice's calibrated is true or false");
  EXPECT_EQ(refused("crop", 1.0), "lattice's crop is a text");
  EXPECT_EQ(refused("ground_classes", 2.0), "lattice's ground_classes is whole numbers");
  EXPECT_THAT(refused("ground_classes", std::vector{2.0}), HasSubstr("have no classes"));
  EXPECT_EQ(refused("rows", 0.0), "rows 0 must be in [1, 100000]");
}

TEST_F(LibraryOptions, OfFlightsAreTheProgramsSettings) {
  run_program(
      "lidarsim fly farm -o flown_theirs --lever-arm 0.1,0,0.05 --heading 30 --pattern crosshatch "
      "--speed 6 --format las --seed 5");
  fly(path("farm"), path("flown_ours"),
      {.settings = {{"lever_arm_m", std::vector{0.1, 0.0, 0.05}},
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

TEST_F(LibraryOptions, OfFlightsAreTheProgramsWaypoints) {
  const fs::path waypoints = path("waypoints.yaml");
  std::ofstream(waypoints) << "waypoints:\n"
                              "  - {x_m: -6, y_m: -3, altitude_m: 8}\n"
                              "  - {x_m: 6, y_m: 3, altitude_m: 8}\n";
  const auto finished = testing::run(
      "lidarsim fly farm -o pointed_theirs --json --waypoints " + waypoints.string(), *folder_);
  ASSERT_EQ(finished.exit_code, 0) << finished.errors;
  const FlightSummary flown = fly(path("farm"), path("pointed_ours"), {.waypoints = waypoints});
  expect_same("pointed_ours", "pointed_theirs");
  const auto said = nlohmann::json::parse(finished.output);
  EXPECT_EQ(flown.duration_s, said["duration_s"].get<double>());
  EXPECT_EQ(flown.points, said["points"].get<std::uint64_t>());
}

TEST_F(LibraryOptions, OfCloudsAreEncodingsAndReplacement) {
  const Cloud points = read_cloud(cloud());
  EXPECT_THAT(points.fields, ::testing::IsSupersetOf({"intensity", "class"}));
  write_cloud(path("text.pcd"), points.points, {.encoding = "ascii"});
  EXPECT_THAT(testing::run("head -n 12 text.pcd", *folder_).output, HasSubstr("DATA ascii"));
  const std::string utm = R"(PROJCS["x",AUTHORITY["EPSG","32617"]])";
  write_cloud(path("utm.las"), points.points, {.crs_wkt = utm});
  EXPECT_EQ(read_cloud(path("utm.las")).crs_wkt, utm);
  EXPECT_THROW(convert_cloud(cloud(), path("text.pcd")), BadInput);
  convert_cloud(cloud(), path("text.pcd"), {.encoding = "binary", .replace = true});
  run_program("lidarsim convert scan.las binary.pcd --encoding binary");
  expect_same("text.pcd", "binary.pcd");
}

TEST_F(LibraryOptions, OfScoresAreTheLeastOverlap) {
  const FieldEstimate field = estimate_field(read_cloud(cloud()).positions());
  const Scores scores = score_estimate(field, path("farm"));
  EXPECT_EQ(scores.found, 9u);
  const auto said = nlohmann::json::parse(scores.json)["heights"];
  ASSERT_EQ(said.size(), scores.heights.size());
  for (std::size_t i = 0; i < said.size(); ++i) {
    const HeightScore& score = scores.heights[i];
    EXPECT_EQ(said[i]["height"], score.height);
    EXPECT_EQ(said[i]["truth"], score.truth);
    for (const auto& [name, value] :
         {std::pair{"rmse_m", score.rmse_m}, std::pair{"bias_m", score.bias_m},
          std::pair{"mae_m", score.mae_m}, std::pair{"r2", score.r2},
          std::pair{"coverage95", score.coverage95}}) {
      EXPECT_TRUE(said[i][name].is_null() ? std::isnan(value) : said[i][name] == value) << name;
    }
  }
  estimate_files({cloud()}, path("scored"));
  for (const Scores& strict : {score_estimate(field, path("farm"), 0.9999),
                               score_estimate(path("scored"), path("farm"), 0.9999)}) {
    EXPECT_EQ(strict.found, 0u);
    EXPECT_EQ(strict.missed, 9u);
    EXPECT_EQ(strict.extra, 9u);
  }
}

// A table of measured heights names its plots by the column that is told.
TEST_F(LibraryOptions, OfScoresNameATablesPlots) {
  const FieldEstimate field = estimate_field(read_cloud(cloud()).positions());
  std::ofstream(path("hand.csv")) << "barcode,height_mean_m\n1,0.5\n2,0.6\n";
  const Scores scores = score_estimate(field, path("hand.csv"), 0.5, "barcode");
  EXPECT_EQ(scores.found, 2u);
  EXPECT_THROW(score_estimate(field, path("hand.csv")), BadInput);
  std::ofstream(path("apart.geojson"))
      << R"({"type": "FeatureCollection", "features": [{"type": "Feature", "properties": )"
         R"({"plot_number": 1, "height_mean_m": 0.5}, "geometry": {"type": "Polygon", )"
         R"("coordinates": [[[900, 900], [904, 900], [904, 901], [900, 901], [900, 900]]]}}]})";
  EXPECT_THAT(score_estimate(field, path("apart.geojson")).notes,
              ::testing::ElementsAre(HasSubstr("lie apart from the true ones")));
}

}  // namespace
}  // namespace plotscan
