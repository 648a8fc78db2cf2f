// SPDX-License-Identifier: Apache-2.0
#include "farmbench/run.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/extent.h"
#include "core/manifest.h"
#include "core/statistics.h"
#include "farmbench/farm_scan.h"
#include "farmbench/internal/farm_queue.h"
#include "farmbench/plan.h"
#include "scan/cloud_reader.h"
#include "temporary_folder.h"

namespace plotscan::farmbench {
namespace {

namespace fs = std::filesystem;
using plotscan::testing::message_of;
using plotscan::testing::TemporaryFolder;
using ::testing::HasSubstr;

const fs::path kSmoke = fs::path(PLOTSCAN_SOURCE_DIR) / "benchmarks/suites/smoke.yaml";

const TableRow& row_of(const std::vector<TableRow>& table, std::string_view case_name,
                       std::string_view method) {
  const auto found = std::ranges::find_if(table, [&](const TableRow& row) {
    return row.case_name == case_name && row.method == method && row.truth == "height_max_m";
  });
  if (found == table.end())
    throw std::runtime_error("no row " + std::string(case_name) + " " + std::string(method));
  return *found;
}

RunOptions smoke_options(const fs::path& output) {
  return {.suite = kSmoke, .output = output, .build = "test"};
}

TEST(RunSuite, SmokeFindsPlotsAndHeights) {
  const TemporaryFolder folder;
  std::vector<std::string> finished;
  const RunSummary summary =
      run(smoke_options(folder.path() / "smoke"), {}, [&](const FarmResult& farm, double seconds) {
        finished.push_back(farm.case_name);
        EXPECT_GT(seconds, 0);
      });
  EXPECT_THAT(finished, ::testing::ElementsAre("flat", "half", "one"));
  EXPECT_EQ(summary.result.farms.size(), 3U);
  EXPECT_EQ(summary.table.size(), 3U * 23 * 9);  // cases, rows of the methods, truths
  const TableRow& own = row_of(summary.table, "flat", "dhami2020/raw-p99");
  const TableRow& given = row_of(summary.table, "flat", "dhami2020/raw-p99 true-boxes");
  const TableRow& oracle = row_of(summary.table, "flat", "oracle-ground");
  EXPECT_EQ(own.boxes.found, own.boxes.plots);
  EXPECT_EQ(own.boxes.extra, 0U);
  EXPECT_GT(own.boxes.iou_median, 0.6);
  EXPECT_LT(own.height.rmse_m, 0.12);
  const TableRow& alone = row_of(summary.table, "flat", "lattice/max");
  EXPECT_EQ(alone.boxes.found, alone.boxes.plots);
  EXPECT_EQ(alone.boxes.extra, 0U);
  EXPECT_LT(alone.height.rmse_m, 0.05);
  const TableRow& one_number = row_of(summary.table, "flat", "one-number/max");
  std::vector<double> truths_m;
  for (const score::PlotScore& plot : summary.result.farms[0].methods.back().score.plots)
    truths_m.push_back(plot.truth.heights_m.at("height_max_m"));
  ASSERT_EQ(truths_m.size(), 4U);
  double squared = 0;
  for (const double truth_m : truths_m) squared += std::pow(truth_m - mean(truths_m), 2);
  EXPECT_NEAR(one_number.height.rmse_m, std::sqrt(squared / 4), 1e-12);
  EXPECT_NEAR(one_number.height.bias_m, 0, 1e-12);
  EXPECT_TRUE(std::isnan(one_number.within.r2));  // it says nothing of one plot against another
  // On flat ground a plane is as good as the truth.
  EXPECT_NEAR(given.height.bias_m, oracle.height.bias_m, 0.01);
  for (const char* terrain : {"flat", "half", "one"}) {
    const TableRow& row = row_of(summary.table, terrain, "oracle-ground");
    EXPECT_EQ(row.boxes.found, row.boxes.plots);
    EXPECT_DOUBLE_EQ(row.boxes.iou_min, 1);
    // The 99th percentile of the points lies a little under the tallest plant's tip.
    EXPECT_LT(row.height.bias_m, 0.01) << terrain;
    EXPECT_GT(row.height.bias_m, -0.12) << terrain;
    EXPECT_LT(row.height.rmse_m, 0.12) << terrain;
    // The noise reaches above it.
    EXPECT_GT(row_of(summary.table, terrain, "dhami2020/raw-max true-boxes").height.bias_m,
              row.height.bias_m);
  }
  for (const char* file : {"table.csv", "results.json", "leaderboard.md", "report.html",
                           "manifest.json", "farms/one-1.json", "views/one-1.cbor"}) {
    EXPECT_TRUE(fs::exists(folder.path() / "smoke" / file)) << file;
  }
  EXPECT_FALSE(fs::exists(folder.path() / "smoke" / "work"));
}

TEST(RunSuite, ResumesWhereItWasStopped) {
  const TemporaryFolder folder;
  const fs::path output = folder.path() / "smoke";
  run(smoke_options(output));
  const std::string table = read_text(output / "table.csv");
  const auto farm = [&](const char* name) { return output / "farms" / name; };
  const std::string removed = read_text(farm("half-1.json"));
  const std::string kept = read_text(farm("one-1.json"));
  const auto kept_time = fs::last_write_time(farm("one-1.json"));
  fs::remove(farm("half-1.json"));
  const std::string view = read_text(output / "views" / "half-1.cbor");
  fs::remove(output / "views" / "half-1.cbor");
  std::ofstream(farm("flat-1.json")) << "{ \"case\": \"fl";  // cut off

  const RunSummary summary = run(smoke_options(output));
  EXPECT_EQ(summary.resumed, 1U);
  EXPECT_EQ(read_text(output / "table.csv"), table);
  EXPECT_EQ(read_text(farm("one-1.json")), kept);
  EXPECT_EQ(fs::last_write_time(farm("one-1.json")), kept_time);
  EXPECT_EQ(read_text(farm("half-1.json")), removed);
  EXPECT_EQ(read_text(output / "views" / "half-1.cbor"), view);
  for (const auto& entry : fs::directory_iterator(output)) {
    EXPECT_FALSE(entry.path().filename().string().starts_with(".work")) << entry.path();
  }

  const std::string whole = read_text(output / "table.csv");
  fs::remove(output / "table.csv");
  fs::remove(output / "report.html");
  report(output, 1);
  EXPECT_EQ(read_text(output / "table.csv"), whole);
  EXPECT_TRUE(fs::exists(output / "report.html"));

  RunOptions other_build = smoke_options(output);
  other_build.build = "another";
  EXPECT_EQ(run(other_build).resumed, 0U);
}

TEST(RunSuite, JobsAndThreadsChangeNothing) {
  const TemporaryFolder folder;
  const fs::path one = folder.path() / "one";
  const fs::path many = folder.path() / "many";
  run(smoke_options(one));
  RunOptions options = smoke_options(many);
  options.jobs = 2;
  options.threads = 5;
  run(options);
  for (const char* name : {"table.csv", "results.json", "farms/flat-1.json", "farms/half-1.json",
                           "farms/one-1.json"}) {
    EXPECT_EQ(read_text(many / name), read_text(one / name)) << name;
    EXPECT_THAT(read_text(one / name), ::testing::Not(HasSubstr("seconds"))) << name;
  }
  EXPECT_GT(nlohmann::json::parse(read_text(many / "times/flat-1.json"))["dhami2020"], 0);
}

TEST(RunSuite, AMethodThatGivesUpHasMissedEveryPlot) {
  const TemporaryFolder folder;
  const fs::path suite = folder.write(
      "bare.yaml",
      "name: bare\ncases:\n  - name: bare\n    farm: " + std::string(PLOTSCAN_SOURCE_DIR) +
          "/worlds/paper_flat.yaml\n    set: {terrain.side_m: 30, plants.count: 0, "
          "plots.rows: '[{plots: 4}]'}\nseeds: [1]\nflight: {altitude_m: 6, "
          "speed_m_s: 3, range_noise_m: 0}\nmethods: [dhami2020, oracle-ground]\n");
  RunOptions options{.suite = suite, .output = folder.path() / "bare", .build = "test"};
  options.keep_clouds = true;
  const RunSummary summary = run(options);
  EXPECT_THAT(summary.result.farms[0].methods[0].failure, HasSubstr("too few for 4 plots"));
  const TableRow& row = row_of(summary.table, "bare", "dhami2020/raw-p99");
  EXPECT_EQ(row.boxes.missed, 4U);
  EXPECT_TRUE(std::isnan(row.height.rmse_m));
  const TableRow& oracle = row_of(summary.table, "bare", "oracle-ground");
  EXPECT_EQ(oracle.height.without, 4U);  // found, but nothing stands on the ground
  const fs::path kept = options.output / "clouds" / "bare-1";
  EXPECT_TRUE(fs::exists(kept / "scan" / "cloud.pcd"));
  options.force = true;
  run(options);
  std::ofstream(kept / "notes.txt") << "precious";
  EXPECT_THAT(message_of<InputError>([&] { run(options); }), HasSubstr("notes.txt"));
  EXPECT_TRUE(fs::exists(kept / "notes.txt"));
}

// Asked for later, or lost when the run was killed at its end, or of the farm as it once was.
TEST(RunSuite, CloudsThatAreNotThereAreMadeAgain) {
  const TemporaryFolder folder;
  RunOptions options = smoke_options(folder.path() / "smoke");
  options.methods = {"one-number"};
  run(options);
  options.keep_clouds = true;
  EXPECT_EQ(run(options).resumed, 0U);
  const fs::path clouds = options.output / "clouds";
  EXPECT_TRUE(fs::exists(clouds / "flat-1/scan/cloud.pcd"));
  EXPECT_EQ(run(options).resumed, 3U);
  fs::remove_all(clouds / "half-1");
  EXPECT_EQ(run(options).resumed, 2U);
  EXPECT_TRUE(fs::exists(clouds / "half-1/scan/cloud.pcd"));
  options.keep_clouds = false;
  options.methods = {"oracle-ground"};
  run(options);
  options.keep_clouds = true;
  EXPECT_EQ(run(options).resumed, 0U);
}

// The same field, but what stands in its boxes are no plots: whatever is found is one too many.
TEST(RunSuite, WithoutPlotsWhateverIsFoundIsInvented) {
  const TemporaryFolder folder;
  const std::string text =
      "name: none\ncases:\n  - name: none\n    farm: " + std::string(PLOTSCAN_SOURCE_DIR) +
      "/worlds/paper_flat.yaml\n    without_plots: true\n    set: "
      "{terrain.side_m: 30, plants.count: 30, plots.rows: '[{plots: 4}]'}\n"
      "seeds: [1]\nflight: {altitude_m: 6, speed_m_s: 3}\n";
  RunOptions options{.suite = folder.write("none.yaml", text + "methods: [lattice]\n"),
                     .output = folder.path() / "none",
                     .build = "test"};
  const RunSummary summary = run(options);
  ASSERT_EQ(summary.table.size(), 1U);
  EXPECT_EQ(summary.table[0].boxes.plots, 0U);
  EXPECT_EQ(summary.table[0].boxes.extra, 4U);
}

TEST(RunSuite, OptionsChooseSeedsAndMethods) {
  const TemporaryFolder folder;
  RunOptions options = smoke_options(folder.path() / "smoke");
  options.seeds = 2;
  options.methods = {"one-number"};
  const RunSummary summary = run(options);
  ASSERT_EQ(summary.result.farms.size(), 6U);
  EXPECT_EQ(summary.result.farms[1].seed, 2U);
  EXPECT_THAT(summary.result.methods, ::testing::ElementsAre("one-number"));
  options.methods = {" one-number", "lattice  true-boxes "};  // "a, b"
  EXPECT_THAT(run(options).result.methods,
              ::testing::ElementsAre("one-number", "lattice true-boxes"));
  options.methods = {"magic"};
  EXPECT_THAT(message_of<InputError>([&] { run(options); }), HasSubstr("no method \"magic\""));
  options.methods = {"one-number", "one-number"};
  EXPECT_THAT(message_of<InputError>([&] { run(options); }), HasSubstr("named twice"));
  options.seeds = 0;
  EXPECT_THAT(message_of<InputError>([&] { run(options); }), HasSubstr("it is 1 to 10000"));
}

// The survey holds the first two of four plots and half of the third.
TEST(RunSuite, PlotsOutsideTheSurveyAreNotScored) {
  const TemporaryFolder folder;
  const fs::path suite = folder.write(
      "part.yaml",
      "name: part\ncases:\n  - name: part\n    farm: " + std::string(PLOTSCAN_SOURCE_DIR) +
          "/worlds/paper_flat.yaml\n    set: {terrain.side_m: 30, plants.count: 30, "
          "plots.rows: '[{plots: 4}]'}\n    survey_m: [-6, -3, 1.25, 3]\nseeds: [1]\n"
          "flight: {altitude_m: 6, speed_m_s: 3}\nmethods: [oracle-ground]\n");
  RunOptions options{.suite = suite, .output = folder.path() / "part", .build = "test"};
  options.keep_clouds = true;
  const RunSummary summary = run(options);
  const TableRow& row = row_of(summary.table, "part", "oracle-ground");
  EXPECT_EQ(row.boxes.plots, 2U);
  EXPECT_EQ(row.boxes.found, 2U);
  EXPECT_LT(row.height.rmse_m, 0.15);
  double left = 0, right = 0;
  scan::read_positions(options.output / "clouds" / "part-1" / "survey.pcd",
                       [&](std::span<const Eigen::Vector3d> points) {
                         for (const Eigen::Vector3d& point : points) {
                           left = std::min(left, point.x());
                           right = std::max(right, point.x());
                         }
                       });
  EXPECT_GE(left, -6);
  EXPECT_LT(left, -5.9);
  EXPECT_LE(right, 1.25);
  EXPECT_GT(right, 1.2);
}

// A survey of the rectangle that holds all plots is the flight over the plots, in wind as well.
TEST(RunSuite, PlantsSwayInASurvey) {
  const TemporaryFolder folder;
  SuiteCase suite_case{.name = "sway",
                       .farm = fs::path(PLOTSCAN_SOURCE_DIR) / "worlds/paper_flat.yaml",
                       .overrides = {"terrain.side_m=20", "plots.rows=[{plots: 2}]"}};
  suite_case.flight.speed_m_s = 4;
  suite_case.flight.wind.mean_m_s = 5;
  suite_case.flight.wind_acts_on = "plants";
  const farm::Farm farm = make_farm({suite_case, 1, folder.path()});
  const auto flown = [&](const std::string& name) {
    const FarmPlace place{suite_case, 1, folder.path() / name};
    fs::create_directories(place.folder);
    scan_farm(place, farm, {});
    std::vector<Eigen::Vector3d> all;
    scan::read_positions(place.folder / "scan" / "cloud.pcd",
                         [&](std::span<const Eigen::Vector3d> points) {
                           all.insert(all.end(), points.begin(), points.end());
                         });
    return all;
  };
  const std::vector<Eigen::Vector3d> over_plots = flown("plots");
  const Eigen::AlignedBox2d extent = extent_of(farm.plots, &farm::Plot::box);
  suite_case.survey = {extent.min().x(), extent.min().y(), extent.max().x(), extent.max().y()};
  const std::vector<Eigen::Vector3d> surveyed = flown("survey");
  ASSERT_EQ(surveyed.size(), over_plots.size());
  for (std::size_t i = 0; i < surveyed.size(); ++i)
    ASSERT_LT((surveyed[i] - over_plots[i]).norm(), 1e-4) << "point " << i;
}

TEST(RunSuite, RefusesAFolderOfSomebodyElse) {
  const TemporaryFolder folder;
  folder.write("mine/thesis.txt", "precious");
  EXPECT_THAT(message_of<InputError>([&] { run(smoke_options(folder.path() / "mine")); }),
              HasSubstr("was not written by plotscan"));
  RunOptions options = smoke_options(folder.path() / "new");
  options.jobs = 0;
  EXPECT_THAT(message_of<InputError>([&] { run(options); }), HasSubstr("it is 1 to 1024"));
  EXPECT_FALSE(fs::exists(folder.path() / "new"));
  EXPECT_THAT(message_of<InputError>([&] { report(folder.path(), 1); }),
              HasSubstr("results.json: no such file"));
}

// Suites share the names of cases: one's farms would take the other's place.
TEST(RunSuite, RefusesAFolderOfAnotherSuite) {
  const TemporaryFolder folder;
  RunOptions options = smoke_options(folder.path() / "results");
  options.seeds = 1;
  options.methods = {"one-number"};
  run(options);
  const nlohmann::json told = read_manifest(options.output)["options"];
  EXPECT_EQ(told["suite"], "smoke");
  EXPECT_EQ(told["methods"], nlohmann::json({"one-number"}));
  EXPECT_EQ(told["seeds"], 1);
  EXPECT_EQ(told["secret"], false);
  const std::string table = read_text(options.output / "table.csv");
  std::string other = read_text(kSmoke);
  other.replace(other.find("name: smoke"), 11, "name: other");
  for (std::size_t at = 0; (at = other.find("../../", at)) != std::string::npos;)
    other.replace(at, 6, std::string(PLOTSCAN_SOURCE_DIR) + "/");
  options.suite = folder.write("other.yaml", other);
  const char* refusal = "holds the results of suite smoke, and this is suite other";
  EXPECT_THAT(message_of<InputError>([&] { run(options); }), HasSubstr(refusal));
  EXPECT_THAT(message_of<InputError>([&] { plan(options); }), HasSubstr(refusal));
  EXPECT_EQ(read_text(options.output / "table.csv"), table);
}

TEST(RunQueue, DoesEveryPieceOnceAndReportsTheMean) {
  std::vector<std::atomic<int>> done(50);
  std::vector<double> shares;
  run_queue(
      done.size(), 3, [&](double share) { shares.push_back(share); },
      [&](std::size_t i, const ProgressReport& progress) {
        progress(0.5);
        ++done[i];
      });
  for (const auto& times : done) EXPECT_EQ(times, 1);
  EXPECT_TRUE(std::ranges::is_sorted(shares));
  EXPECT_NEAR(shares.back(), 1, 1e-9);
}

TEST(RunQueue, TheFirstFailureStopsTheRest) {
  std::atomic<int> started = 0;
  EXPECT_THROW(run_queue(1000, 1, {},
                         [&](std::size_t i, const ProgressReport&) {
                           ++started;
                           if (i == 3) throw InputError("broken");
                         }),
               InputError);
  EXPECT_EQ(started, 4);
}

}  // namespace
}  // namespace plotscan::farmbench
