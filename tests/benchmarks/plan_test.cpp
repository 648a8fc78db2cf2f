// SPDX-License-Identifier: Apache-2.0
#include "farmbench/plan.h"

#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/manifest.h"
#include "temporary_folder.h"

namespace plotscan::farmbench {
namespace {

namespace fs = std::filesystem;
using plotscan::testing::message_of;
using plotscan::testing::TemporaryFolder;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

// Two cases and two seeds of a farm of four plots; a flight of the second case can be asked for.
class Plan : public ::testing::Test {
 protected:
  fs::path write_suite(const std::string& flight = "") const {
    const std::string worlds = std::string(PLOTSCAN_SOURCE_DIR) + "/worlds/";
    return folder_.write(
        "tiny.yaml",
        "name: tiny\ncases:\n  - name: flat\n    farm: " + worlds +
            "paper_flat.yaml\n    set: &small {terrain.side_m: 30, terrain.vertices: 20, "
            "plots.rows: '[{plots: 4}]', plants.count: 30}\n  - {name: half-1, farm: " +
            worlds + "paper_half.yaml, set: *small" + flight +
            "}\nseeds: [1, 12]\nflight: {altitude_m: 6, speed_m_s: 3}\nmethods: [one-number]\n");
  }

  RunOptions options(const std::string& name) const {
    return {
        .suite = folder_.path() / "tiny.yaml", .output = folder_.path() / name, .build = "test"};
  }

  TemporaryFolder folder_;
  const PlannedFarmOptions own_{.build = "test"};
};

TEST_F(Plan, FarmByFarmGivesTheBytesOfARun) {
  write_suite();
  RunOptions whole = options("whole");
  whole.entered = {"mine=/bin/true {out}"};
  run(whole);
  RunOptions planned = whole;
  planned.output = folder_.path() / "planned";
  EXPECT_EQ(plan(planned).changed, 2U);
  EXPECT_EQ(read_text(planned.output / "tasks.csv"),
            "farm,case,seed,viewed\nflat-1,flat,1,1\nflat-12,flat,12,0\n"
            "half-1-1,half-1,1,1\nhalf-1-12,half-1,12,0\n");
  EXPECT_THAT(message_of<InputError>([&] { merge(planned.output, {.build = "test"}); }),
              HasSubstr("4 of 4 farms have no result: flat-1, flat-12, half-1-1, half-1-12"));
  const fs::path elsewhere = folder_.path() / "elsewhere";
  fs::create_directories(elsewhere);
  for (const char* farm : {"half-1-12", "flat-12", "flat-1", "half-1-1"}) {
    EXPECT_FALSE(
        run_planned(planned.output, farm, {.threads = 2, .build = "test", .work = elsewhere})
            .resumed);
  }
  EXPECT_TRUE(fs::is_empty(elsewhere));
  const auto last = fs::last_write_time(planned.output / "farms/flat-1.json");
  EXPECT_TRUE(run_planned(planned.output, "flat-1", own_).resumed);
  EXPECT_EQ(fs::last_write_time(planned.output / "farms/flat-1.json"), last);
  fs::create_directories(planned.output / ".flat-12.work-77/scan");  // it was killed at its end
  EXPECT_TRUE(merge(planned.output, {.build = "test"}).missing.empty());
  EXPECT_FALSE(fs::exists(planned.output / ".flat-12.work-77"));
  for (const char* file : {"table.csv", "results.json", "farms/flat-12.json", "farms/half-1-1.json",
                           "views/flat-1.cbor", "views/half-1-1.cbor"})
    EXPECT_TRUE(read_text(planned.output / file) == read_text(whole.output / file)) << file;
  EXPECT_EQ(run(planned).resumed, 4U);  // a run takes the farms as its own
}

// However the suite's path was written, and from wherever its farms are run.
TEST_F(Plan, CommandsOfTheSuitesFolderStayAsTheyWerePlanned) {
  write_suite();
  folder_.write("mine.sh", "exit 1\n");
  RunOptions planned = options("planned");
  fs::create_directories(folder_.path() / "below");
  planned.suite = folder_.path() / "below/../tiny.yaml";
  planned.entered = {"mine=sh {suite}/mine.sh {cloud} {out}"};
  plan(planned);
  EXPECT_FALSE(run_planned(planned.output, "flat-1", own_).resumed);
}

// A workflow merges again where plan.json is new.
TEST_F(Plan, IsNewWhereTheReportsShowSomethingElse) {
  const fs::path suite = write_suite();
  plan(options("planned"));
  const fs::path file = folder_.path() / "planned/plan.json";
  const std::string before = read_text(file);
  const auto made = fs::last_write_time(file);
  plan(options("planned"));
  EXPECT_EQ(fs::last_write_time(file), made);
  std::ofstream(suite, std::ios::app) << "truths: [height_max_m]\n";
  EXPECT_EQ(plan(options("planned")).changed, 0U);
  EXPECT_NE(read_text(file), before);
}

// A page of a sweep shows no farm: a workflow must not wait for its view.
TEST_F(Plan, ASweepsFarmsHaveNoViews) {
  folder_.write("sweep.yaml", "name: swept\nfarm: " + std::string(PLOTSCAN_SOURCE_DIR) +
                                  "/worlds/paper_flat.yaml\naxes: {altitude_m: [6, 8]}\n"
                                  "seeds: [1]\nmethods: [one-number]\n");
  RunOptions planned = options("planned");
  planned.suite = folder_.path() / "sweep.yaml";
  plan(planned);
  EXPECT_EQ(read_text(planned.output / "tasks.csv"),
            "farm,case,seed,viewed\n6-1,6,1,0\n8-1,8,1,0\n");
}

TEST_F(Plan, WhatIsMissingIsNamedOrLeftOut) {
  write_suite(", flight: {altitude_m: 0.5}");
  const RunOptions planned = options("planned");
  plan(planned);
  run_planned(planned.output, "flat-1", own_);
  run_planned(planned.output, "flat-12", own_);
  EXPECT_THAT(message_of<InputError>([&] { run_planned(planned.output, "half-1-1", own_); }),
              ::testing::AllOf(HasSubstr("case half-1, seed 1"),
                               HasSubstr("would meet the ground or the crop")));
  EXPECT_FALSE(fs::exists(planned.output / "farms/half-1-1.json"));
  EXPECT_THAT(message_of<InputError>([&] { merge(planned.output, {.build = "test"}); }),
              HasSubstr("2 of 4 farms have no result: half-1-1, half-1-12; --finished"));
  EXPECT_FALSE(fs::exists(planned.output / "table.csv"));
  fs::create_directories(planned.output / ".half-1-1.work-77");  // it may run elsewhere
  const MergeSummary merged = merge(planned.output, {.build = "test", .finished_only = true});
  EXPECT_THAT(merged.missing, ElementsAre("half-1-1", "half-1-12"));
  EXPECT_EQ(merged.run.result.farms.size(), 2U);
  EXPECT_TRUE(fs::exists(planned.output / ".half-1-1.work-77"));
  EXPECT_EQ(read_manifest(planned.output)["results"]["finished"], false);
}

TEST_F(Plan, IsOfOneBuildAndOfTheFilesAsTheyWere) {
  write_suite();
  const RunOptions planned = options("planned");
  plan(planned);
  const auto written = fs::last_write_time(planned.output / "plan.json");
  EXPECT_EQ(plan(planned).changed, 0U);
  EXPECT_EQ(fs::last_write_time(planned.output / "plan.json"), written);
  const auto refusal = [&](const std::string& farm, const std::string& build) {
    return message_of<InputError>([&] { run_planned(planned.output, farm, {.build = build}); });
  };
  EXPECT_THAT(refusal("flat-1", "other"), HasSubstr("another build's"));
  for (const char* farm : {"flat-2", "flat", "half-1", "../flat-1"})
    EXPECT_THAT(refusal(farm, "test"), HasSubstr("plans no farm \"" + std::string(farm) + "\""));
  write_suite(", flight: {altitude_m: 7}");
  EXPECT_THAT(refusal("half-1-1", "test"),
              HasSubstr("case half-1, or a file that it is made from, is not"));
  EXPECT_THAT(message_of<InputError>([&] { merge(planned.output, {.build = "test"}); }),
              HasSubstr("plan again"));
  EXPECT_EQ(plan(planned).changed, 1U);  // the other case stays as it is
  std::ofstream(planned.output / "plan.json") << "{\"format\": 1}";
  EXPECT_THAT(refusal("flat-1", "test"), HasSubstr("not farmbench's plan"));
  fs::remove(planned.output / "plan.json");
  EXPECT_THAT(refusal("flat-1", "test"), HasSubstr("holds no plan.json"));
  const fs::path other = folder_.path() / "other";
  fs::create_directories(other);
  std::ofstream(other / "notes.txt") << "precious";
  EXPECT_THAT(message_of<InputError>([&] { plan(options("other")); }), HasSubstr("other"));
}

}  // namespace
}  // namespace plotscan::farmbench
