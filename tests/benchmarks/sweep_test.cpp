// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <filesystem>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/text_file.h"
#include "farmbench/internal/sweep_table.h"
#include "farmbench/run.h"
#include "farmbench/suite.h"
#include "temporary_folder.h"

namespace plotscan::farmbench {
namespace {

namespace fs = std::filesystem;
using plotscan::testing::message_of;
using plotscan::testing::TemporaryFolder;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

// Four plots, flown in six ways; one key a line.
const std::string kSoundSweep =
    "name: mine\n"
    "farm: " +
    std::string(PLOTSCAN_SOURCE_DIR) +
    "/worlds/paper_flat.yaml\n"
    "set: {terrain.side_m: 30, terrain.vertices: 20, \"plots.rows\": \"[{plots: 4}]\", "
    "plants.count: 30}\n"
    "flight: {spin_jitter: none}\n"
    "axes:\n"
    "  altitude_m: [6, 9.5, 119]\n"
    "  sensor: [vlp16, puck_hires]\n"
    "height: max\n"
    "enough: {rmse_cm: 5, found: 1}\n"
    "seeds: [1]\n"
    "methods: [lattice true-boxes]\n";

std::string swept_with(const std::string& line, const std::string& other) {
  std::string text = kSoundSweep;
  return text.replace(text.find(line), line.size(), other);
}

TEST(LoadSweep, EveryCombinationIsACase) {
  const TemporaryFolder folder;
  const Suite suite = load_suite(folder.write("s.yaml", kSoundSweep));
  std::vector<std::string> names;
  for (const SuiteCase& one : suite.cases) names.push_back(one.name);
  EXPECT_THAT(names, ElementsAre("6_vlp16", "6_puck_hires", "9.5_vlp16", "9.5_puck_hires",
                                 "119_vlp16", "119_puck_hires"));
  EXPECT_EQ(suite.cases[3].flight.altitude_m, 9.5);
  EXPECT_EQ(suite.cases[3].flight.sensor, "puck_hires");
  EXPECT_EQ(suite.cases[3].flight.spin_jitter, "none");
  EXPECT_EQ(suite.cases[3].overrides.size(), 4U);
  ASSERT_TRUE(suite.sweep);
  EXPECT_THAT(combination(*suite.sweep, 3), ElementsAre(9.5, "puck_hires"));
  EXPECT_EQ(suite.sweep->truth, "height_max_m");
  EXPECT_EQ(suite.sweep->goal->rmse_m, 0.05);
}

TEST(LoadSweep, TellsWhatIsWrong) {
  const TemporaryFolder folder;
  const auto message = [&](const std::string& text) {
    const fs::path file = folder.write("s.yaml", text);
    return message_of<InputError>([&] { load_suite(file); });
  };
  EXPECT_THAT(message(swept_with("altitude_m: [6", "altitude: [6")),
              HasSubstr("s.yaml:6: axes.altitude is no option of a flight that can vary"));
  EXPECT_THAT(message(swept_with("[6, 9.5, 119]", "[6, 9.5, 6]")),
              HasSubstr("s.yaml:6: axes.altitude_m name 6 twice"));
  EXPECT_THAT(message(swept_with("[6, 9.5, 119]", "[6, 9000]")), HasSubstr("altitude_m"));
  EXPECT_THAT(message(swept_with("height: max", "height: tallest")), HasSubstr("s.yaml:8: height"));
  EXPECT_THAT(message(swept_with("puck_hires]", "puck]")),
              HasSubstr("s.yaml:7: axes.sensor.1 does not hold: sensor \"puck\" is unknown"));
  EXPECT_THAT(message(swept_with("sensor: [vlp16, puck_hires]", "start_utc: [noon]")),
              HasSubstr("s.yaml:7: axes.start_utc.0 \"noon\" is not like 2026-06-01T"));
  EXPECT_THAT(message(swept_with("spin_jitter: none", "altitude_m: 8")),
              HasSubstr("s.yaml:6: axes.altitude_m is given under flight as well"));
  EXPECT_THAT(message(swept_with("height: max", "height: max\ntruth: tallest")),
              HasSubstr("s.yaml:9: truth"));
  EXPECT_THAT(message(swept_with("[vlp16, puck_hires]", "[" + std::string(PLOTSCAN_SOURCE_DIR) +
                                                            "/models/sensors/vlp16.yaml, vlp16]")),
              HasSubstr("whose files would be called 6_vlp16"));
  EXPECT_THAT(message(swept_with("height: max", "baseline: mine")), HasSubstr("baseline"));
  EXPECT_THAT(message(swept_with("height: max", "published_rmse_cm: 6")),
              HasSubstr("published_rmse_cm is not a known key"));
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

// The goal holds for a farm whose flights differ in time and error as written here.
TEST(Sweep, NeedsTheShortestFlightThatSurelyReachesTheGoal) {
  SuiteResult result;
  result.methods = {"lattice"};
  result.sweep = Sweep{.axes = {{"altitude_m", {1, 2, 3, 4}}},
                       .height = "mean",
                       .truth = "height_mean_m",
                       .goal = SweepGoal{.rmse_m = 0.03, .found = 0.9}};
  const double nothing = std::nan("");
  std::vector<TableRow> rows;
  const auto add = [&](double flight_s, double rmse_m, double high_m, double recall) {
    const std::string name = std::to_string(result.cases.size());
    result.cases.push_back({name});
    for (const double off_s : {-1, 1}) {
      FarmResult& farm = result.farms.emplace_back();
      farm.case_name = name;
      farm.flight_s = flight_s + off_s;
    }
    TableRow& row = rows.emplace_back();
    row.case_name = name;
    row.method = "lattice/mean";
    row.truth = "height_mean_m";
    row.boxes.recall = recall;
    row.height.rmse_m = rmse_m;
    row.rmse_95_m.high = high_m;
  };
  add(40, 0.01, 0.02, 1);
  add(30, 0.02, 0.04, 1);                       // perhaps not
  add(20, 0.01, 0.02, 0.8);                     // too few
  add(10, nothing, nothing, 0);                 // nothing found
  result.farms.emplace_back().case_name = "2";  // a third farm, which was not flown
  EXPECT_EQ(flight_needed(result, rows), 0U);
  EXPECT_EQ(flight_costs(result)[2].flight_s, 20);
  rows[1].rmse_95_m.high = nothing;  // of a single farm: the RMSE counts
  EXPECT_EQ(flight_needed(result, rows), 1U);
  EXPECT_THAT(sweep_markdown(result, rows), HasSubstr("has altitude_m 2; 30 s over"));
  for (FarmResult& farm : result.farms) farm.flight_s = 0;  // as of a submission alone
  EXPECT_THAT(sweep_markdown(result, rows), HasSubstr("the flights' times are not known"));
  result.sweep->goal->rmse_m = 0.005;
  EXPECT_EQ(flight_needed(result, rows), std::nullopt);
}

TEST(Sweep, TablesHaveTheSuitesNumbersForAnyJobsAndThreads) {
  const TemporaryFolder folder;
  const fs::path suite = folder.write("s.yaml", swept_with("6, 9.5, 119", "6, 40"));
  const RunSummary summary = run({.suite = suite, .output = folder.path() / "a", .build = "test"});
  run({.suite = suite, .output = folder.path() / "b", .jobs = 3, .threads = 4, .build = "test"});
  for (const char* file : {"sweep.csv", "sweep.md", "table.csv", "results.json"})
    EXPECT_EQ(read_text(folder.path() / "a" / file), read_text(folder.path() / "b" / file)) << file;
  const std::vector<TableRow> rows = sweep_rows(summary.result, summary.table);
  ASSERT_EQ(rows.size(), 4U);
  const std::vector<std::string> csv = lines_of(read_text(folder.path() / "a/sweep.csv"));
  EXPECT_THAT(csv.front(), ::testing::StartsWith("altitude_m,sensor,method,truth,farms,plots"));
  EXPECT_EQ(csv.size(), 1 + 4 * 8U);  // each height beside its truth
  const std::string asked = "6,vlp16,lattice/max true-boxes,height_max_m,1,4,4,0,0,1,";
  const auto found =
      std::ranges::find_if(csv, [&](const std::string& line) { return line.starts_with(asked); });
  ASSERT_NE(found, csv.end());
  EXPECT_NEAR(std::stod(found->substr(asked.size())), 100 * rows[0].height.rmse_m, 1e-4);
  const std::string page = read_text(folder.path() / "a/report.html");
  EXPECT_THAT(page, HasSubstr("\"flights\":["));
  EXPECT_TRUE(fs::is_empty(folder.path() / "a/views")) << "a sweep shows no farm";
  // A second run finds all of it.
  const RunSummary again = run({.suite = suite, .output = folder.path() / "a", .build = "test"});
  EXPECT_EQ(again.resumed, 4U);
  EXPECT_EQ(lines_of(read_text(folder.path() / "a/sweep.csv")), csv);
  EXPECT_EQ(report(folder.path() / "b", 1).result.sweep->axes.size(), 2U);
  EXPECT_EQ(lines_of(read_text(folder.path() / "b/sweep.csv")), csv);
}

// From 119 m the ground is out of the sensor's range.
TEST(Sweep, GoesOnAfterAFlightThatSeesNothing) {
  const TemporaryFolder folder;
  const fs::path suite = folder.write(
      "s.yaml", swept_with("[6, 9.5, 119]\n  sensor: [vlp16, puck_hires]", "[119, 6]"));
  const RunSummary summary = run({.suite = suite, .output = folder.path() / "a", .build = "test"});
  const std::vector<TableRow> rows = sweep_rows(summary.result, summary.table);
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0].boxes.found, 0U);
  EXPECT_EQ(rows[0].boxes.missed, 4U);
  EXPECT_EQ(rows[1].boxes.found, 4U);
  const std::string table = read_text(folder.path() / "a/sweep.md");
  EXPECT_THAT(table, HasSubstr("the shortest flight that does has altitude_m 6;"));
  EXPECT_THAT(table, HasSubstr("| 119 | - | - | 0 of 4 | 0 | none | - |"));
  EXPECT_THAT(table, HasSubstr("lattice true-boxes, 119: 1 of 1 farm, no flight: scan/cloud.pcd: "
                               "the cloud is empty"));
}

}  // namespace
}  // namespace plotscan::farmbench
