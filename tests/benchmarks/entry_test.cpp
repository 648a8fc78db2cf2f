// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <functional>

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "benchmarks/blind_suite.h"
#include "core/angle.h"
#include "core/error.h"
#include "farmbench/entries.h"
#include "farmbench/entry/sha256.h"
#include "farmbench/farm_scan.h"
#include "farmbench/internal/suite_page.h"
#include "farmbench/plan.h"
#include "farmbench/run.h"
#include "farmbench/submission/internal/submission.h"
#include "farmbench/submission/score_submission.h"
#include "methods/lattice/lattice.h"
#include "temporary_folder.h"

namespace plotscan::farmbench {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using plotscan::testing::message_of;
using plotscan::testing::TemporaryFolder;
using plotscan::testing::write_blind_suite;
using ::testing::HasSubstr;

constexpr const char* kStatement = R"({"method": "mine"})";

const TableRow& row_of(const std::vector<TableRow>& table, std::string_view case_name,
                       std::string_view method, std::string_view truth) {
  const auto found = std::ranges::find_if(table, [&](const TableRow& row) {
    return row.case_name == case_name && row.method == method && row.truth == truth;
  });
  if (found == table.end()) throw std::runtime_error("no row " + std::string(method));
  return *found;
}

TEST(Entries, OneWithAFarmTwiceIsRefused) {
  const TemporaryFolder folder;
  EnteredFarm farm;
  farm.case_name = "flat";
  farm.seed = 3;
  Entry entry;
  entry.method = "mine";
  entry.farms = {farm};
  write_entry(folder.path(), entry);
  EXPECT_NO_THROW(require_entries(folder.path(), {"lattice"}));
  entry.farms.push_back(farm);
  write_entry(folder.path(), entry);
  EXPECT_THAT(message_of<InputError>([&] { require_entries(folder.path(), {"lattice"}); }),
              HasSubstr("entries/mine.json: has two farms of case flat, seed 3"));
}

// The blind suite run once by our own method, and what that method says of each field.
class Scoring : public ::testing::Test {
 protected:
  void SetUp() override {
    choice_ = {.file = write_blind_suite(folder_)};
    suite_ = chosen_suite(choice_);
    fields_ = blind_fields(suite_, choice_);
    submission_ = folder_.path() / "submission";
    fs::create_directories(submission_);
  }

  ScoreSubmissionOptions options() const {
    return {.submission = submission_, .suite = choice_, .output = folder_.path() / "results"};
  }
  void write(const std::string& file, const std::string& text) const {
    folder_.write("submission/" + file, text);
  }
  RunSummary run_suite() const {
    return run({.suite = choice_.file, .output = folder_.path() / "results", .build = "test"});
  }
  // The first field's estimate is handed in as GeoJSON, the second one's as a table.
  void hand_in_lattice() const {
    write("submission.json", kStatement);
    for (const BlindField& field : fields_) {
      const fs::path work = folder_.path() / "work" / field.code;
      fs::create_directories(work);
      const FarmPlace place{field.suite_case, field.seed, work, 1};
      estimate::write_estimate(
          work, methods::lattice::estimate_plots(scan_farm(place, make_farm(place), {}).cloud, {}));
      const bool as_table = field.code == fields_.back().code;
      write(field.code + (as_table ? ".csv" : ".geojson"),
            read_text(work / (as_table ? "heights.csv" : "plots.geojson")));
    }
  }

  TemporaryFolder folder_;
  SuiteChoice choice_;
  Suite suite_;
  std::vector<BlindField> fields_;
  fs::path submission_;
};

TEST_F(Scoring, GivesTheScoresOfOurOwnMethodToTheSameEstimate) {
  const RunSummary own = run_suite();
  hand_in_lattice();
  const ScoredSubmission scored = score_submission(options());
  EXPECT_TRUE(scored.missing.empty());
  for (const TableRow& row : own.table) {
    const std::string height = row.method.substr(std::string("lattice").size());
    const TableRow& entered = row_of(scored.table, row.case_name, "mine" + height, row.truth);
    EXPECT_EQ(entered.boxes.found, row.boxes.found);
    EXPECT_EQ(entered.boxes.extra, row.boxes.extra);
    EXPECT_NEAR(entered.boxes.iou_mean, row.boxes.iou_mean, 1e-9);
    EXPECT_NEAR(entered.height.rmse_m, row.height.rmse_m, 1e-12);
    EXPECT_NEAR(entered.height.bias_m, row.height.bias_m, 1e-12);
    EXPECT_EQ(entered.height.flagged, row.height.flagged);
    if (row.named) {
      EXPECT_EQ(entered.height.coverage95, row.height.coverage95);
    }
  }
}

TEST_F(Scoring, AddsToTablesAndReportAndStaysThere) {
  run_suite();
  const fs::path results = folder_.path() / "results";
  hand_in_lattice();
  score_submission(options());
  const std::string table = read_text(results / "table.csv");
  EXPECT_THAT(table, HasSubstr("blindsuite,zq-even-hidden,mine/p99,height_p99_m,1,4,4,0,0,"));
  EXPECT_THAT(table, HasSubstr("blindsuite,zq-even-hidden,lattice/p99,"));
  EXPECT_THAT(read_text(results / "leaderboard.md"), HasSubstr("| mine/p99 |"));
  const SuiteResult added = read_results(results);
  const json page = suite_document(added, make_table(added, 1));
  EXPECT_TRUE(std::ranges::any_of(page["series"],
                                  [](const json& series) { return series["row"] == "mine/p99"; }));
  const json entry = json::parse(read_text(results / "entries" / "mine.json"));
  for (std::size_t i = 0; i < fields_.size(); ++i) {
    const auto farm = std::ranges::find_if(entry["farms"], [&](const json& candidate) {
      return candidate["field"] == fields_[i].code;
    });
    ASSERT_NE(farm, entry["farms"].end());
    EXPECT_EQ((*farm)["farm_sha256"],
              sha256_of_folder(folder_.path() / "work" / fields_[i].code / "farm" / "truth"));
  }
  score_submission(options());  // again: it takes its own place
  EXPECT_EQ(read_text(results / "table.csv"), table);
  report(results, 1);
  EXPECT_EQ(read_text(results / "table.csv"), table);
  EXPECT_EQ(run_suite().resumed, 2U);
  EXPECT_EQ(read_text(results / "table.csv"), table);
}

TEST_F(Scoring, HeightsInGivenBoxesHaveRowsOfTheirOwn) {
  write("submission.json", kStatement);
  write(fields_[0].code + ".csv", "plot_number,height_p99_m\n1,0.8\n2,0.8\n");
  const ScoredSubmission scored = score_submission(options());  // into a new results folder
  EXPECT_EQ(scored.missing, std::vector<std::string>{fields_[1].code});
  const TableRow& row =
      row_of(scored.table, fields_[0].suite_case.name, "mine/p99 true-boxes", "height_p99_m");
  EXPECT_EQ(row.boxes.found, 2U);
  EXPECT_EQ(row.boxes.missed, 2U);
  EXPECT_EQ(row.boxes.iou_min, 1);
  const TableRow& missing =
      row_of(scored.table, fields_[1].suite_case.name, "mine/p99 true-boxes", "height_p99_m");
  EXPECT_EQ(missing.boxes.found, 0U);
  EXPECT_EQ(missing.boxes.missed, 4U);
  EXPECT_TRUE(fs::exists(folder_.path() / "results" / "report.html"));
}

// Whoever hands the true boxes in has found nothing, whether the boxes are named or repeated.
TEST_F(Scoring, TheTrueBoxesAreNoFind) {
  write("submission.json", kStatement);
  const BlindField& field = fields_[0];
  const fs::path work = folder_.path() / "work";
  fs::create_directories(work);
  const FarmPlace place{field.suite_case, field.seed, work, 1};
  make_farm(place);
  std::string rows = "center_x_m,center_y_m,width_m,length_m,heading_deg,height_p99_m\n";
  std::string shifted = rows;
  for (const score::TruePlot& plot : standing_plots(place)) {
    const PlotBox& box = plot.box;
    const std::string rest =
        fmt::format("{},{},{},0.8\n", box.width_m, box.length_m, degrees(box.heading_rad));
    rows += fmt::format("{},{},", box.center.x(), box.center.y()) + rest;
    shifted += fmt::format("{},{},", box.center.x() + 0.02, box.center.y()) + rest;
  }
  ScoreSubmissionOptions alone = options();
  alone.output.reset();
  write(field.code + ".csv", rows);
  EXPECT_EQ(score_submission(alone).result.methods, std::vector<std::string>{"mine true-boxes"});
  write(field.code + ".csv", shifted);
  EXPECT_EQ(score_submission(alone).result.methods, std::vector<std::string>{"mine"});
  json fields = json::array();
  for (const BlindField& each : fields_) {
    const fs::path made = folder_.path() / each.code;
    fs::create_directories(made);
    make_farm({each.suite_case, each.seed, made, 1});
    fields.push_back(
        {{"field", each.code},
         {"farm_sha256", blinded_farm_sha256(each.code, sha256_of_folder(made / "farm" / "truth"))},
         {"sha256", json::object()}});
  }
  write("task.json", json{{"boxes_given", true}, {"fields", fields}}.dump());
  EXPECT_EQ(score_submission(alone).result.methods, std::vector<std::string>{"mine true-boxes"});
}

TEST_F(Scoring, BoxesWithoutHeightsAreScoredAsBoxes) {
  write("submission.json", kStatement);
  write(fields_[0].code + ".csv",
        "center_x_m,center_y_m,width_m,length_m,heading_deg\n50,50,1,4,0\n");
  const ScoredSubmission scored = score_submission(options());
  const TableRow& row = row_of(scored.table, fields_[0].suite_case.name, "mine", "height_max_m");
  EXPECT_EQ(row.boxes.found, 0U);
  EXPECT_EQ(row.boxes.extra, 1U);
  EXPECT_TRUE(std::isnan(row.height.rmse_m));
  EXPECT_EQ(scored.apart, std::vector<std::string>{fields_[0].code});
}

// Centimetres under the names of metres, in the first field alone.
TEST_F(Scoring, HintsAtCentimetres) {
  hand_in_lattice();
  EXPECT_TRUE(score_submission(options()).hints.empty());
  const std::string file = fields_[0].code + ".geojson";
  json map = json::parse(read_text(submission_ / file));
  for (json& plot : map["features"]) {
    for (auto& [name, value] : plot["properties"].items())
      if (name.find("height_") != std::string::npos || name.find("canopy_") != std::string::npos)
        value = 100 * value.get<double>();
  }
  write(file, map.dump());
  const auto hints = score_submission(options()).hints;
  ASSERT_EQ(hints.size(), 1U);
  EXPECT_THAT(hints.begin()->first, HasSubstr("about 100 times the true ones"));
  EXPECT_EQ(hints.begin()->second, std::vector<std::string>{fields_[0].code});
}

TEST_F(Scoring, RefusesAllThatIsWrongAtOnceAndWritesNothing) {
  write("submission.json", R"({"method": "lattice", "team": "x", "program_sha256": "12"})");
  write("0123456789.csv", "plot_number,height_p99_m\n1,0.8\n");
  write(fields_[0].code + ".csv", "plot_number,height_p99_m\n1,x\n");
  write(fields_[0].code + ".geojson", "{}");
  write("task.json", "{}");
  const std::string told = message_of<InputError>([&] { score_submission(options()); });
  for (const char* problem :
       {"\"lattice\" is one of Plotscan's methods", "\"team\" is none of", "is no SHA-256",
        "0123456789.csv: no field is called 0123456789", ".csv:2: height_p99_m is \"x\"",
        ".geojson: the field has another file", "task.json: is not the task.json of an export"}) {
    EXPECT_THAT(told, HasSubstr(problem));
  }
  EXPECT_FALSE(fs::exists(folder_.path() / "results"));
}

// Farms of the same names, which were another ones when the results were made.
TEST_F(Scoring, RefusesResultsOfAnotherTruthAndWritesNothing) {
  run_suite();
  std::string text = read_text(choice_.file);
  text.replace(text.find("plants.count: 30"), 16, "plants.count: 20");
  folder_.write("blind.yaml", text);
  write("submission.json", kStatement);
  write(fields_[0].code + ".csv", "plot_number,height_p99_m\n1,0.8\n");
  EXPECT_THAT(message_of<InputError>([&] { score_submission(options()); }),
              ::testing::AllOf(HasSubstr("results/results.json: case "), HasSubstr("another truth"),
                               HasSubstr("run the suite again")));
  EXPECT_FALSE(fs::exists(folder_.path() / "results/entries"));
}

// An earlier entry that can't be read is there: the new one is not left half added.
TEST_F(Scoring, RefusesToStandBesideABrokenEntryAndWritesNothing) {
  run_suite();
  const fs::path results = folder_.path() / "results";
  folder_.write("results/entries/broken.json", "{");
  write("submission.json", kStatement);
  write(fields_[0].code + ".csv", "plot_number,height_p99_m\n1,0.8\n");
  const std::string manifest = read_text(results / "manifest.json");
  EXPECT_THAT(message_of<InputError>([&] { score_submission(options()); }),
              HasSubstr("broken.json: not what farmbench score writes"));
  EXPECT_FALSE(fs::exists(results / "entries/mine true-boxes.json"));
  EXPECT_EQ(read_text(results / "manifest.json"), manifest);
}

// Not after the hours that the farms of a suite take.
TEST_F(Scoring, WhatCannotStandBesideTheSuitesMethodsIsToldBeforeTheFirstFarm) {
  write("submission.json", kStatement);
  write(fields_[0].code + ".csv", "plot_number,height_p99_m\n1,0.8\n");
  score_submission(options());
  const fs::path results = folder_.path() / "results";
  RunOptions again{.suite = choice_.file,
                   .output = results,
                   .entered = {"mine=true {boxes} {out}"},
                   .build = "test"};
  for (const auto& begin :
       {std::function<void()>([&] { run(again); }), std::function<void()>([&] { plan(again); })}) {
    EXPECT_THAT(message_of<InputError>(begin),
                HasSubstr("mine true-boxes.json: \"mine true-boxes\" is the name of another"));
  }
  again.entered.clear();
  folder_.write("results/entries/broken.json", "{");
  EXPECT_THAT(message_of<InputError>([&] { run(again); }),
              HasSubstr("broken.json: not what farmbench score writes"));
  EXPECT_FALSE(fs::exists(results / "farms"));
}

TEST_F(Scoring, NamesTheFolderForTemporaryFilesThatIsNotThere) {
  write("submission.json", kStatement);
  write(fields_[0].code + ".csv", "plot_number,height_p99_m\n1,0.8\n");
  const char* before = std::getenv("TMPDIR");
  const std::string kept = before == nullptr ? "" : before;
  setenv("TMPDIR", "/no/such/folder", 1);
  EXPECT_THAT(message_of<InputError>([&] { score_submission(options()); }), HasSubstr("TMPDIR"));
  before == nullptr ? unsetenv("TMPDIR") : setenv("TMPDIR", kept.c_str(), 1);
}

TEST_F(Scoring, RefusesOtherFarms) {
  write("submission.json", kStatement);
  write(fields_[0].code + ".csv", "plot_number,height_p99_m\n1,0.8\n");
  json fields = json::array();
  for (const BlindField& field : fields_)
    fields.push_back(
        {{"field", field.code}, {"farm_sha256", std::string(64, '0')}, {"sha256", json::object()}});
  write("task.json", json({{"fields", fields}}).dump());
  EXPECT_THAT(message_of<InputError>([&] { score_submission(options()); }),
              HasSubstr("task.json: is of other farms: field " + fields_[0].code));
  fs::remove(submission_ / "task.json");
  score_submission(options());
  ScoreSubmissionOptions other = options();
  other.suite.seeds = 2;
  EXPECT_THAT(message_of<InputError>([&] { score_submission(other); }),
              HasSubstr("holds results of other farms"));
  other.submission = folder_.path() / "nothing";
  EXPECT_THAT(message_of<InputError>([&] { score_submission(other); }), HasSubstr("other farms"));
}

}  // namespace
}  // namespace plotscan::farmbench
