// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/csv.h"
#include "core/error.h"
#include "farmbench/internal/chosen_rows.h"
#include "farmbench/internal/suite_page.h"
#include "farmbench/reports.h"
#include "farmbench/results_table.h"
#include "farmbench/run.h"
#include "temporary_folder.h"

namespace plotscan::farmbench {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

score::PlotScore plot(double truth_m, double error_m, double iou) {
  score::PlotScore plot{.truth = {.id = 1, .box = {}, .heights_m = {{"height_max_m", truth_m}}},
                        .found = {}};
  if (iou > 0) plot.found = {.iou = iou, .heights_m = {{"p99", truth_m + error_m}}};
  return plot;
}

FarmResult farm(const std::string& case_name, std::uint64_t seed, double seconds,
                const std::vector<score::PlotScore>& plots) {
  return {.case_name = case_name,
          .seed = seed,
          .made_from = {{"seed", seed}},
          .shots = 10,
          .points = 5,
          .flight_s = 1,
          .methods = {{.method = "oracle-ground",
                       .seconds = seconds,
                       .failure = {},
                       .diagnostics = {{"voxels", 7}},
                       .score = {.method = "oracle-ground", .plots = plots, .extra = {9}}}}};
}

// Three farms of case a, of which the last has a missed plot; of case b nothing was found.
SuiteResult small_result() {
  return {.suite = "s<1>",
          .cases = {{"a", 4.8}, {"b", {}}},
          .methods = {"oracle-ground"},
          .published = Published{.source = "A & B, 2020", .methods = {"oracle-ground"}},
          .farms = {farm("a", 1, 3, {plot(1.0, 0.03, 0.9), plot(1.2, -0.01, 0.8)}),
                    farm("a", 2, 1, {plot(1.1, 0.02, 0.7), plot(1.3, 0.04, 0.95)}),
                    farm("a", 3, 2, {plot(0.9, 0.05, 0.85), plot(1.0, 0, 0)}),
                    farm("b", 1, 1, {plot(1.0, 0, 0)})}};
}

TEST(MakeTable, PoolsTheFarmsOfACase) {
  const std::vector<TableRow> table = make_table(small_result(), 1);
  ASSERT_EQ(table.size(), 2U);
  const TableRow& row = table[0];
  EXPECT_EQ(row.farms, 3U);
  EXPECT_EQ(row.boxes.plots, 6U);
  EXPECT_EQ(row.boxes.found, 5U);
  EXPECT_EQ(row.boxes.missed, 1U);
  EXPECT_EQ(row.boxes.extra, 3U);
  EXPECT_DOUBLE_EQ(row.boxes.iou_median, 0.85);
  EXPECT_DOUBLE_EQ(row.boxes.iou_min, 0.7);
  EXPECT_NEAR(row.height.rmse_m, std::sqrt((9 + 1 + 4 + 16 + 25) * 1e-4 / 5), 1e-12);
  EXPECT_NEAR(row.height.bias_m, 0.13 / 5, 1e-12);
  EXPECT_NEAR(row.height.mae_m, 0.15 / 5, 1e-12);
  EXPECT_NEAR(row.height.r2, 1 - 0.0055 / 0.1, 1e-12);  // truths 1.0 1.2 1.1 1.3 0.9
  EXPECT_DOUBLE_EQ(row.seconds, 2);
  // All resamples lie between the best farm and the worst one alone.
  EXPECT_GE(row.rmse_95_m.low, std::sqrt(10e-4 / 2) - 1e-12);
  EXPECT_LE(row.rmse_95_m.high, 0.05 + 1e-12);
  EXPECT_LT(row.rmse_95_m.low, row.rmse_95_m.high);
}

// The found plots have intervals of 3.5 cm to either side of their first height, and one has a
// flag.
SuiteResult result_with_intervals() {
  SuiteResult result = small_result();
  for (FarmResult& farm : result.farms) {
    for (score::PlotScore& plot : farm.methods[0].score.plots) {
      plot.truth.heights_m["height_p99_m"] = plot.truth.heights_m.at("height_max_m");
      if (!plot.found) continue;
      const double height_m = plot.found->heights_m.at("p99");
      plot.found->errors["p99"] = {
          .standard_error_m = 0.015, .low95_m = height_m - 0.035, .high95_m = height_m + 0.035};
      plot.found->heights_m["p99"] += 0.019;  // errors 4.9, 0.9, 3.9, 5.9 and 6.9 cm
    }
  }
  result.farms[2].methods[0].score.plots[0].found->flags = {"cut"};
  return result;
}

TEST(MakeTable, CountsIntervalsAndFlags) {
  const std::vector<TableRow> table = make_table(result_with_intervals(), 1);
  ASSERT_EQ(table.size(), 4U);
  const TableRow& largest = table[0];
  EXPECT_FALSE(largest.named);
  EXPECT_TRUE(
      std::isnan(largest.height.coverage95));  // p99's intervals say nothing of the tallest plant
  const TableRow& named = table[1];
  EXPECT_EQ(named.truth, "height_p99_m");
  EXPECT_TRUE(named.named && named.shown);
  EXPECT_DOUBLE_EQ(named.height.coverage95, 3.0 / 5);  // truths 3, -1, 2, 4 and 5 cm below
  EXPECT_EQ(named.height.flagged, 1U);
  EXPECT_EQ(named.height.large_unflagged, 1U);
  EXPECT_DOUBLE_EQ(named.height.large_unflagged_share, 0.2);
  EXPECT_DOUBLE_EQ(named.boxes.recall, 5.0 / 6);
  EXPECT_DOUBLE_EQ(named.boxes.precision, 5.0 / 8);
  EXPECT_NEAR(named.boxes.iou_mean, (0.9 + 0.8 + 0.7 + 0.95 + 0.85) / 5, 1e-12);
}

TEST(SummaryLines, SayHowFarAMethodIsToBeTrusted) {
  const SuiteResult result = result_with_intervals();
  const auto lines = summary_lines(result, make_table(result, 1));
  for (const std::string& line : lines) EXPECT_LE(line.size(), 100U) << line;
  EXPECT_THAT(lines,
              ::testing::Contains(::testing::AllOf(HasSubstr("60.0 %"), HasSubstr("1 (20.00 %)"))));
  SuiteResult of_p99 = result;
  of_p99.truths = {"height_p99_m"};
  EXPECT_THAT(summary_lines(of_p99, make_table(of_p99, 1)),
              ::testing::Contains(HasSubstr("Truth height_p99_m")));
  const nlohmann::json document = of_p99;
  EXPECT_EQ(nlohmann::json(document.get<SuiteResult>()), document);
}

// Errors 3 and -1, 2 and 4, and 5 cm: the farms' biases are 1, 3 and 5.
TEST(MakeTable, TakesTheFarmsBiasesFromTheRest) {
  const TableRow row = make_table(small_result(), 1)[0];
  EXPECT_EQ(row.within.farms, 3U);
  EXPECT_NEAR(row.within.farm_bias_m, std::sqrt((1 + 9 + 25) * 1e-4 / 3), 1e-12);
  EXPECT_NEAR(row.within.within_m, std::sqrt((4 + 4 + 1 + 1) * 1e-4 / 5), 1e-12);
  EXPECT_NEAR(row.within.rho, 1, 1e-12);
  const std::vector<std::string> lines =
      summary_lines(result_with_intervals(), make_table(result_with_intervals(), 1));
  EXPECT_THAT(lines, ::testing::Contains(
                         ::testing::AllOf(HasSubstr("bias a farm"), HasSubstr("rho within"))));
}

// A case without plots has no truth, and still says how many plots were invented.
TEST(MakeTable, ACaseWithoutPlotsCountsWhatWasInvented) {
  SuiteResult result = small_result();
  result.farms = {farm("a", 1, 1, {}), farm("a", 2, 1, {})};
  const std::vector<TableRow> table = make_table(result, 1);
  ASSERT_EQ(table.size(), 1U);
  EXPECT_EQ(table[0].truth, "");
  EXPECT_EQ(table[0].boxes.plots, 0U);
  EXPECT_EQ(table[0].boxes.extra, 2U);
  EXPECT_EQ(plot_rows(result, table).front().boxes.extra, 2U);
  EXPECT_TRUE(suite_document(result, table)["plots"].empty());
}

TEST(MakeTable, NothingFoundIsARowOfItsOwn) {
  const TableRow row = make_table(small_result(), 1)[1];
  EXPECT_EQ(row.case_name, "b");
  EXPECT_EQ(row.boxes.missed, 1U);
  EXPECT_TRUE(std::isnan(row.height.rmse_m) && std::isnan(row.boxes.iou_median));
}

// Two farms of a case and the same two with larger errors: what changes is the difference of the
// RMSEs, and the interval holds it.
TEST(MakeTable, AgainstABaselineRmseChangesByTheDifference) {
  SuiteResult result = small_result();
  result.baseline = "a";
  const std::vector<TableRow> table = make_table(result, 1);
  EXPECT_EQ(table[0].case_name, "a");
  EXPECT_EQ(table[0].rmse_change_m, 0);
  EXPECT_TRUE(std::isnan(table[1].rmse_change_m));  // "b" has other farms than "a"
  EXPECT_TRUE(std::isnan(make_table(small_result(), 1)[0].rmse_change_m));
  // As many farms, of which some are missing on either side: they are no pairs.
  result.farms.erase(result.farms.begin(), result.farms.begin() + 2);
  EXPECT_EQ(make_table(result, 1)[0].rmse_change_m, 0);
  result.farms.back() = farm("b", 1, 1, {plot(1.0, 0.03, 0.9)});
  EXPECT_TRUE(std::isnan(make_table(result, 1)[1].rmse_change_m));
  result.farms.back().seed = 3;
  EXPECT_FALSE(std::isnan(make_table(result, 1)[1].rmse_change_m));
}

TEST(TableCsv, HasTheColumnsOthersReadIt) {
  const testing::TemporaryFolder folder;
  const CsvTable table =
      read_csv_table(folder.write("table.csv", table_csv(make_table(small_result(), 1))));
  EXPECT_THAT(table.columns,
              ::testing::ElementsAre(
                  "suite", "case", "method", "truth", "farms", "plots", "found", "missed", "extra",
                  "without", "recall", "precision", "iou_mean", "iou_median", "iou_min",
                  "center_rmse_cm", "heading_rmse_deg", "rmse_cm", "rmse_lo_cm", "rmse_hi_cm",
                  "rmse_change_cm", "rmse_change_lo_cm", "rmse_change_hi_cm", "bias_cm", "mae_cm",
                  "r2", "farm_bias_cm", "within_cm", "r2_within", "rho_within", "coverage95",
                  "flagged", "over_5cm_unflagged", "over_5cm_unflagged_share"));
  ASSERT_EQ(table.lines.size(), 2U);
  EXPECT_EQ(table.lines[0].fields[17], "3.3166");
  EXPECT_EQ(table.lines[1].fields[17], "");
  for (const CsvTable::Line& line : table.lines)
    EXPECT_EQ(line.fields[30], "");  // this method gives no intervals
}

TEST(TableCsv, QuotesASettingThatIsAList) {
  const testing::TemporaryFolder folder;
  std::vector<TableRow> rows = make_table(small_result(), 1);
  rows.front().method = "lattice/max ground_classes=2,3";
  const CsvTable table = read_csv_table(folder.write("table.csv", table_csv(rows)));
  EXPECT_EQ(table.lines.front().fields[2], "lattice/max ground_classes=2,3");
}

TEST(SuiteResultJson, ComesBack) {
  const nlohmann::json document = small_result();
  const SuiteResult again = nlohmann::json::parse(document.dump());
  EXPECT_EQ(nlohmann::json(again), document);
  EXPECT_EQ(table_csv(make_table(again, 1)), table_csv(make_table(small_result(), 1)));
}

TEST(SuiteResultJson, PartsThatDoNotBelongTogetherAreRefused) {
  const testing::TemporaryFolder folder;
  const auto write = [&](const std::function<void(nlohmann::json&)>& edit) {
    nlohmann::json document = small_result();
    document["sweep"] = {{"height", "p99"}, {"truth", "height_max_m"}};
    document["sweep"]["axes"][0] = {{"key", "altitude_m"}, {"values", {1, 2}}};
    edit(document);
    folder.write("results.json", document.dump());
  };
  const auto refused = [&](const std::function<void(nlohmann::json&)>& edit) {
    write(edit);
    return testing::message_of<InputError>([&] { read_results(folder.path()); });
  };
  using nlohmann::json;
  write([](json&) {});
  EXPECT_NO_THROW(read_results(folder.path()));
  EXPECT_THAT(refused([](json& d) { d["methods"] = json::array(); }), HasSubstr("names no method"));
  EXPECT_THAT(refused([](json& d) { d["farms"] = json::array(); }), HasSubstr("has no farms"));
  EXPECT_THAT(refused([](json& d) { d["cases"][1]["name"] = "a"; }), HasSubstr("two cases a"));
  EXPECT_THAT(refused([](json& d) { d["farms"][0]["case"] = "c"; }),
              HasSubstr("results.json: farm c-1 is of no case"));
  EXPECT_THAT(refused([](json& d) { d["farms"][0]["seed"] = 2; }), HasSubstr("two farms a-2"));
  EXPECT_THAT(refused([](json& d) { d["baseline"] = "c"; }), HasSubstr("the baseline c"));
  json::json_pointer values("/sweep/axes/0/values");
  EXPECT_THAT(refused([&](json& d) { d[values] = json::array(); }), HasSubstr("0 combinations"));
  EXPECT_THAT(refused([&](json& d) { d[values] = {1, nullptr}; }), HasSubstr("the value null"));
  folder.write("times/a-1.json", "{");
  EXPECT_THAT(refused([](json&) {}), HasSubstr("times/a-1.json: not the times of a farm"));
}

// A submission from before the suite had the case.
TEST(WriteReports, AMethodWithoutACaseLeavesItsColumnToNoOther) {
  const testing::TemporaryFolder folder;
  SuiteResult result = small_result();
  result.baseline = "a";
  result.methods = result.entered = {"early", "late"};
  result.farms.back() = farm("b", 1, 1, {plot(1.0, 0.03, 0.9)});
  for (FarmResult& farm : result.farms) {
    farm.methods.front().method = "late";
    if (farm.case_name == "b") continue;
    farm.methods.push_back(farm.methods.front());
    farm.methods.back().method = "early";
  }
  write_reports(folder.path(), result, make_table(result, 1));
  EXPECT_THAT(read_text(folder.path() / "leaderboard.md"),
              ::testing::AllOf(HasSubstr("| case | early/p99 | late/p99 |"),
                               HasSubstr("\n| b | - | 3.00 (-) |\n")));
}

// One measures the plot that it is sure of, the other all of them.
TEST(WriteReports, AMethodThatLeavesPlotsOutHasNoPlace) {
  const testing::TemporaryFolder folder;
  SuiteResult result = small_result();
  result.cases = {{"a", {}}};
  result.methods = result.entered = {"sure", "whole"};
  result.farms = {farm("a", 1, 3, {plot(1.0, 0.03, 0.9), plot(1.2, -0.03, 0.8)})};
  MethodResult whole = result.farms.front().methods.front();
  whole.method = "whole";
  whole.score.extra.clear();
  MethodResult sure = whole;
  sure.method = "sure";
  sure.score.plots[0].found->heights_m["p99"] = 1.001;
  sure.score.plots[1].found->heights_m.clear();
  result.farms.front().methods = {sure, whole};
  const std::vector<TableRow> table = make_table(result, 1);
  write_reports(folder.path(), result, table);
  const std::string board = read_text(folder.path() / "leaderboard.md");
  const auto first = board.find("\n| 1 | whole/p99 | 3.00"),
             second = board.find("\n|  | sure/p99 | 0.10");
  EXPECT_NE(first, std::string::npos) << board;
  EXPECT_NE(second, std::string::npos) << board;
  EXPECT_LT(first, second);
  EXPECT_THAT(board, HasSubstr("| 2 of 2, 1 without |"));
  EXPECT_THAT(read_text(folder.path() / "table.csv"),
              HasSubstr(",sure/p99,height_max_m,1,2,2,0,0,1,"));
  const nlohmann::json row = suite_document(result, table)["table"][0];
  EXPECT_EQ(row["method"], "sure/p99");
  EXPECT_EQ(row["without"], 1);
}

TEST(SummaryLines, FitATerminalAndShowThePublishedFigure) {
  const SuiteResult result = small_result();
  const auto lines = summary_lines(result, make_table(result, 1));
  for (const std::string& line : lines) EXPECT_LE(line.size(), 100U) << line;
  EXPECT_THAT(lines[2], ::testing::AllOf(HasSubstr("oracle-ground"), HasSubstr("5/6"),
                                         HasSubstr("0.8333"), HasSubstr("0.6250")));
  EXPECT_THAT(lines[3], ::testing::AllOf(HasSubstr("0/1"), Not(HasSubstr("nan"))));
  EXPECT_THAT(lines[7], ::testing::AllOf(HasSubstr("oracle-ground"), HasSubstr("3.32 ["),
                                         HasSubstr("+2.60"), HasSubstr("4.8")));
}

// Their last column ends at the right.
TEST(SummaryLines, StayInLineWhereNamesAreLong) {
  SuiteResult result = result_with_intervals();
  for (FarmResult& farm : result.farms) farm.case_name += "-of-a-long-name";
  for (CaseInfo& info : result.cases) info.name += "-of-a-long-name";
  const auto lines = summary_lines(result, make_table(result, 1));
  std::size_t tables = 0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (!lines[i].starts_with("method")) continue;
    ++tables;
    EXPECT_EQ(lines[i + 1].size(), lines[i].size()) << lines[i + 1];
  }
  EXPECT_GE(tables, 4U);
}

TEST(SummaryLines, SayWhyNoPlotsWereFoundWhereThereAreSome) {
  SuiteResult result = small_result();
  MethodResult& in_b = result.farms[3].methods[0];
  in_b.diagnostics["why_no_plots"] = "too few points";
  const auto lines = [&] { return summary_lines(result, make_table(result, 1)); };
  EXPECT_THAT(lines(), Contains("oracle-ground, b: 1 of 1 farm, no plots: too few points"));
  in_b.score.plots.clear();
  EXPECT_THAT(lines(), Not(Contains(HasSubstr("too few points"))));
}

// The page's figures are made from these pairs: they give the table's figures back.
TEST(SuiteDocument, HoldsEveryPlotsTruthAndEstimate) {
  const SuiteResult result = small_result();
  const std::vector<TableRow> table = make_table(result, 1);
  const nlohmann::json document = nlohmann::json::parse(suite_document(result, table).dump());
  const nlohmann::json& truths = document["plots"]["height_max_m"];
  const nlohmann::json& series = document["series"][0];
  EXPECT_EQ(series["row"], "oracle-ground");
  ASSERT_EQ(series["values"].size(), truths.size());
  std::size_t at = 0;
  double squares = 0, found = 0;
  for (const auto& farm : document["farms"]) {
    for (std::size_t i = 0; i < farm["plot_numbers"].size(); ++i, ++at) {
      if (farm["case"] != "a" || series["values"][at].is_null()) continue;
      squares += std::pow(series["values"][at].get<double>() - truths[at].get<double>(), 2);
      ++found;
    }
  }
  EXPECT_EQ(at, truths.size());
  EXPECT_EQ(found, 5);
  EXPECT_NEAR(std::sqrt(squares / found), table[0].height.rmse_m, 1e-5);
  EXPECT_NEAR(document["table"][0]["rmse_m"].get<double>(), table[0].height.rmse_m, 1e-5);
  EXPECT_EQ(document["table"][1]["rmse_m"], nullptr);  // nothing was found in b
  EXPECT_EQ(document["published"]["source"], result.published->source);
}

}  // namespace
}  // namespace plotscan::farmbench
