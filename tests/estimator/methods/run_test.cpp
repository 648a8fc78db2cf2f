// SPDX-License-Identifier: Apache-2.0
#include "methods/run.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/csv.h"
#include "core/error.h"
#include "core/manifest.h"
#include "core/plot_features.h"
#include "core/random.h"
#include "run_on_farm.h"

namespace plotscan::methods {
namespace {

using plotscan::testing::message_of;
using plotscan::testing::TemporaryFolder;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::kFarm;
using ::testing::Not;
using testing::small_run;
using testing::write_cloud;

TEST(Run, WritesAFolderFromWhichTheRunCanBeRepeated) {
  const TemporaryFolder folder;
  const RunOptions options = small_run(folder, kFarm);
  const estimate::Estimate estimate = run(options);
  EXPECT_EQ(estimate.plots.size(), 8u);
  const estimate::Estimate read = estimate::read_estimate(options.output);
  EXPECT_EQ(read.method, "dhami2020");
  ASSERT_EQ(read.plots.size(), 8u);
  EXPECT_EQ(read.plots[3].heights_m, estimate.plots[3].heights_m);
  const auto manifest = read_manifest(options.output);
  EXPECT_EQ(manifest["command"], "estimator run");
  EXPECT_EQ(manifest["options"]["plots"], 8);
  EXPECT_EQ(manifest["inputs"][0]["hash"], file_hash(options.cloud.files.front()));
  EXPECT_EQ(manifest["results"]["plots"], 8);
  EXPECT_EQ(manifest["results"]["heights"]["raw-max"]["plots"], 8);
  EXPECT_EQ(manifest["results"]["diagnostics"]["votes"]["clusters"], 8);
}

// So many points drawn in a box of side x side x height metres.
std::vector<Eigen::Vector3d> scattered(std::uint64_t count, double side_m, double height_m) {
  std::vector<Eigen::Vector3d> points;
  for (std::uint64_t i = 0; i < count; ++i) {
    RandomStream random(2, random_purpose("test/scattered"), i);
    points.emplace_back(random.uniform(0, side_m), random.uniform(0, side_m),
                        random.uniform(0, height_m));
  }
  return points;
}

estimate::Estimate estimate_of(const std::vector<Eigen::Vector3d>& points) {
  const TemporaryFolder folder;
  return run({.cloud = write_cloud(folder.path() / "scan" / "cloud.pcd", points),
              .output = folder.path() / "estimate"});
}

// Half a kilometre of town with a point on 250 square metres: over 200 s and 2.4 GB once.
TEST(Run, SaysOfASparseCloudThatItCannotShowPlots) {
  const estimate::Estimate estimate = estimate_of(scattered(1000, 500, 0.05));
  EXPECT_TRUE(estimate.plots.empty());
  EXPECT_THAT(estimate.diagnostics.why_no_plots, HasSubstr("65 a square metre"));
  EXPECT_GT(estimate.diagnostics.ground.value().cell_m, 5);
}

// 5,000 times one point, and a point a hectare: none carries a ground, and no crop box helps.
TEST(Run, SaysOfPointsThatAreTooFewForAGroundWhatIsNeeded) {
  for (const auto& points :
       {std::vector<Eigen::Vector3d>(5000, {1, 2, 3}), scattered(1000, 3000, 50)}) {
    const std::string message =
        message_of<NothingToMeasure>([&] { require_measured({}, estimate_of(points)); });
    EXPECT_THAT(message, AllOf(HasSubstr("about 65 a square metre"), HasSubstr("fly lower"),
                               Not(HasSubstr("--crop-box"))));
  }
}

TEST(Run, SaysOfACloudWithoutGroundThatItHasNone) {
  const estimate::Estimate estimate = estimate_of(scattered(300000, 20, 3));
  EXPECT_THAT(estimate.diagnostics.why_no_plots, HasSubstr("no ground"));
}

TEST(Run, SaysOfDegreesThatAreTakenForMetresWhatHelps) {
  const std::string message =
      message_of<NothingToMeasure>([&] { estimate_of(scattered(100000, 3e-4, 1)); });
  EXPECT_THAT(message, AllOf(HasSubstr("within 10 cm of one place"), HasSubstr("--crs EPSG:4326")));
}

TEST(Run, NotesCoordinatesThatLostTheirDigits) {
  std::vector<Eigen::Vector3d> points = scattered(100000, 20, 0.1);
  EXPECT_THAT(estimate_of(points).diagnostics.notes.value(), IsEmpty());
  for (Eigen::Vector3d& point : points) point.y() = std::round(point.y() * 4) / 4;
  EXPECT_THAT(estimate_of(points).diagnostics.notes.value(),
              ElementsAre(HasSubstr("y counts in steps of 0.25 m")));
}

// Heights that scatter by 7 cm, and by 3.
TEST(Run, SaysOfARoughGroundThatItMayHideCanopy) {
  EXPECT_THAT(estimate_of(scattered(200000, 20, 0.25)).diagnostics.why_no_plots,
              AllOf(HasSubstr("the ground's returns scatter by 7."), HasSubstr("--noise")));
  EXPECT_THAT(estimate_of(scattered(200000, 20, 0.1)).diagnostics.why_no_plots,
              Not(HasSubstr("scatter by")));
}

TEST(Run, NotesANoiseThatTheGroundDoesNotHave) {
  const TemporaryFolder folder;
  RunOptions options = small_run(folder, kFarm);
  options.method = "lattice";
  options.cloud = write_cloud(folder.path() / "rough.pcd", scattered(100000, 20, 0.1));
  options.lattice.noise_m = 0.01;
  EXPECT_THAT(run(options).diagnostics.notes.value(),
              ElementsAre(HasSubstr("heights of bare ground scatter by ")));
}

TEST(Run, RefusesACropForACalibrationThatIsLeftOut) {
  const TemporaryFolder folder;
  RunOptions options = small_run(folder, kFarm);
  options.method = "lattice";
  options.lattice.crop = "wheat";
  options.lattice.calibrated = false;
  EXPECT_THAT(message_of<InputError>([&] { run(options); }), HasSubstr("one or the other"));
}

TEST(Run, TakesAScanFolderAndGivesTheSameBytes) {
  const TemporaryFolder folder;
  RunOptions options = small_run(folder, kFarm);
  run(options);
  const std::string first = read_text(options.output / "manifest.json");
  options.cloud = CloudFiles(folder.path() / "scan");
  options.threads = 2;
  options.replace = true;
  run(options);
  EXPECT_EQ(read_text(options.output / "manifest.json"), first);
}

TEST(Run, KnowsWhenNothingWasMeasured) {
  estimate::Estimate estimate{.method = "lattice",
                              .diagnostics = {.density_per_m2 = 1.5, .why_no_plots = "a reason"}};
  const auto message = [&] {
    return message_of<NothingToMeasure>([&] { require_measured({}, estimate); });
  };
  EXPECT_THAT(message(), HasSubstr("no plots: a reason (1.5 points/m2); fly lower or slower"));
  EXPECT_THAT(message(), HasSubstr("--units"));
  estimate.crs = "EPSG:32617";
  EXPECT_THAT(message(), Not(HasSubstr("--units")));
  EXPECT_THAT(message(), Not(HasSubstr("--boxes")));
  estimate.diagnostics.density_per_m2 = 40;
  EXPECT_THAT(message(), AllOf(HasSubstr("--boxes"), HasSubstr("fly lower")));
  estimate.diagnostics.density_per_m2 = 1.5e3;
  EXPECT_THAT(message(), AllOf(HasSubstr("--boxes"), Not(HasSubstr("fly lower"))));
  estimate.plots = {{.id = 1, .box = {}}, {.id = 2, .box = {}}};
  EXPECT_THAT(message(), HasSubstr("no plot has enough points for a height (1500 points/m2)"));
  estimate.plots[1].heights_m["max"] = 0.5;
  EXPECT_NO_THROW(require_measured({}, estimate));
}

TEST(Run, AdvisesNothingThatWasDone) {
  const estimate::Estimate estimate{.method = "lattice",
                                    .diagnostics = {.density_per_m2 = 1.5e3, .why_no_plots = "a"}};
  RunOptions options;
  const auto message = [&] {
    return message_of<NothingToMeasure>([&] { require_measured(options, estimate); });
  };
  EXPECT_THAT(message(), HasSubstr("; give the plots' sides with --plot-width and --plot-length"));
  options.lattice.plot_width_m = 1.5;
  EXPECT_THAT(message(), HasSubstr("; give --plot-length as well"));
  options.lattice.plot_length_m = 4;
  EXPECT_THAT(message(), HasSubstr("; give --heading as well"));
  options.lattice.heading_deg = 90;
  EXPECT_THAT(message(),
              AllOf(HasSubstr("; give --rows and --columns as well"), HasSubstr("--crop-box")));
  options.lattice.rows = 3;
  options.lattice.columns = 10;
  options.crop_box = {0, 0, 20, 20};
  EXPECT_THAT(message(),
              AllOf(HasSubstr("; say where plots are with --boxes"), Not(HasSubstr("--crop-box"))));
}

TEST(Run, RefusesPlotsThatAreWiderThanLong) {
  const TemporaryFolder folder;
  RunOptions options = small_run(folder, kFarm);
  options.method = "lattice";
  options.lattice.plot_width_m = 4;
  options.lattice.plot_length_m = 1.5;
  EXPECT_THAT(message_of<InputError>([&] { run(options); }),
              HasSubstr("plot_width_m 4 is larger than plot_length_m 1.5"));
  EXPECT_FALSE(std::filesystem::exists(options.output));
}

TEST(Run, LeavesNothingBehindOnBadInput) {
  const TemporaryFolder folder;
  RunOptions options = small_run(folder, kFarm);
  const auto message = [&] { return message_of<InputError>([&] { run(options); }); };
  options.method = "magic";
  EXPECT_THAT(message(), HasSubstr("no method \"magic\""));
  options.method = "dhami2020";
  options.dhami2020.plots = 0;
  EXPECT_THAT(message(), HasSubstr("number of plots"));
  options.boxes = folder.write("none.geojson", R"({"features":[]})");
  EXPECT_THAT(message(), HasSubstr("has no plots"));
  options.cloud = folder.path() / "missing.pcd";
  EXPECT_THAT(message(), HasSubstr("missing.pcd"));
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
    EXPECT_THAT(entry.path().filename().string(), ::testing::AnyOf("scan", "none.geojson"));
  }
}

}  // namespace
}  // namespace plotscan::methods
