// SPDX-License-Identifier: Apache-2.0
// `estimator series`: folders in, tables out.
#include "series/run.h"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/plot_features.h"
#include "estimator/series/field_results.h"
#include "temporary_folder.h"

namespace plotscan::series {
namespace {

using plotscan::testing::message_of;
using plotscan::testing::TemporaryFolder;
using ::testing::HasSubstr;

class SeriesRun : public ::testing::Test {
 protected:
  // An estimate's folder, with what its manifest says besides the method.
  std::filesystem::path write(const std::string& name,
                              const std::vector<estimate::PlotEstimate>& plots,
                              const nlohmann::json& results = nlohmann::json::object()) const {
    const nlohmann::json manifest = {{"options", {{"method", "lattice"}}}, {"results", results}};
    folder_.write(name + "/manifest.json", manifest.dump());
    estimate::write_estimate(folder_.path() / name,
                             {.method = "lattice", .plots = plots, .id_property = "plot"});
    return folder_.path() / name;
  }
  std::string text(const std::string& name) const {
    return read_text(folder_.path() / "series" / name);
  }

  TemporaryFolder folder_;
  std::filesystem::path series_ = folder_.path() / "series";
};

estimate::PlotEstimate with_cultivar(estimate::PlotEstimate plot, const std::string& cultivar) {
  plot.attributes["cultivar"] = cultivar;
  return plot;
}

TEST_F(SeriesRun, WritesTheTables) {
  const nlohmann::json boxes = {{"diagnostics", {{"boxes", {{"id", "plot"}}}}}};
  estimate::PlotEstimate flagged = plot_at(101, 0, 0, 0.25);
  flagged.flags = {"too few returns"};
  const auto june = write(
      "june_2026-06-01",
      {with_cultivar(flagged, "Apollo, early"), with_cultivar(plot_at(102, 2, 0, 0.5), "Bella")},
      boxes);
  const auto july = write("july_2026-07-11", {plot_at(101, 0, 0, 0.75)}, boxes);
  run({.estimates = {july, june}, .output = series_});
  EXPECT_EQ(text("series.csv"),
            "plot_id,date,row_number,col_number,canopy_p95_m,se_canopy_p95_m,low95_canopy_p95_m,"
            "high95_canopy_p95_m,height_mean_m,flags\n"
            "101,2026-06-01,,,0.25,0.01,0.23,0.27,0.15,\"too few returns\"\n"
            "102,2026-06-01,,,0.5,0.01,0.48,0.52,0.4,\n"
            "101,2026-07-11,,,0.75,0.01,0.73,0.77,0.65,\n");
  EXPECT_EQ(text("by_date.csv"),
            "plot_id,row_number,col_number,canopy_p95_m_2026-06-01,canopy_p95_m_2026-07-11,"
            "cultivar\n"
            "101,,,0.25,0.75,\"Apollo, early\"\n"
            "102,,,0.5,,Bella\n");
  EXPECT_EQ(text("growth.csv"),
            "plot_id,from,to,days,growth_m,se_growth_m,growth_cm_per_day,flags\n"
            "101,2026-06-01,2026-07-11,40,0.5,0.01414213562373095,1.25,too few returns\n");
  const auto map = read_plot_features(series_ / "by_date.geojson");
  EXPECT_EQ(map.at(0).properties["canopy_p95_m_2026-07-11"], 0.75);
  EXPECT_EQ(map.at(0).properties["plot"], 101);
  EXPECT_EQ(map.at(0).properties["cultivar"], "Apollo, early");
  EXPECT_FALSE(map.at(1).properties.contains("canopy_p95_m_2026-07-11"));
}

TEST_F(SeriesRun, TakesTheDateOfTheFlightBeforeThatOfTheFolder) {
  const auto first = write("2020-01-01", {plot_at(1, 0, 0, 0.25)}, {{"flown", "2026-07-01"}});
  const auto second = write("V6", {plot_at(1, 0, 0, 0.75)});
  const Series series = run({.estimates = {second, first}, .output = series_});
  EXPECT_EQ(series.dates, (std::vector<std::string>{"V6", "2026-07-01"}));  // as given: one is none
  const Series named = run({.estimates = {second, first},
                            .dates = {"2026-08-01", "2026-07-01"},
                            .height = "mean",
                            .output = folder_.path() / "named"});
  EXPECT_EQ(named.dates.front(), "2026-07-01");
}

TEST_F(SeriesRun, RefusesWhatIsNoSeries) {
  const auto one = write("one", {plot_at(1, 0, 0, 0.25)});
  const auto two = write("two", {plot_at(1, 0, 0, 0.5)});
  const auto refusal = [&](const RunOptions& options) {
    return message_of<InputError>([&] { run(options); });
  };
  EXPECT_THAT(refusal({.estimates = {one}, .output = series_}), HasSubstr("two estimates"));
  EXPECT_THAT(refusal({.estimates = {one, two}, .dates = {"a"}, .output = series_}),
              HasSubstr("--dates has 1 dates, and there are 2 estimates"));
  EXPECT_THAT(refusal({.estimates = {one, two}, .height = "p96", .output = series_}),
              HasSubstr("no plot has a height \"p96\"; --height names one of canopy_p95, mean"));
  EXPECT_FALSE(std::filesystem::exists(series_));
}

}  // namespace
}  // namespace plotscan::series
