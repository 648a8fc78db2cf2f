// SPDX-License-Identifier: Apache-2.0
#include "series/series.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/list_of.h"
#include "estimator/series/field_results.h"
#include "temporary_folder.h"

namespace plotscan::series {
namespace {

using plotscan::testing::message_of;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::vector<std::string> ids_of(const Series& series) {
  return list_of<std::string>(series.plots,
                              [](const PlotSeries& plot) { return plot.plot.id.text(); });
}

// The heights of a plot at each date; -1 where it has none.
std::vector<double> heights_of(const PlotSeries& plot) {
  return list_of<double>(plot.at,
                         [](const auto& at) { return at ? at->heights_m.at("canopy_p95") : -1; });
}

TEST(Series, JoinsFoundPlotsByPlaceWhateverTheirNumbers) {
  const Series series =
      joined_series({found("2026-07-01", {plot_at(1, 2.1, 1.9, 0.8), plot_at(2, 0.7, 0.1, 0.7)}),
                     found("2026-06-01", {plot_at(1, 0, 0, 0.2), plot_at(2, 2, 0, 0.3)})});
  EXPECT_THAT(series.dates, ElementsAre("2026-06-01", "2026-07-01"));
  EXPECT_EQ(series.joined_by, JoinBy::places);
  EXPECT_THAT(ids_of(series), ElementsAre("1", "2"));
  EXPECT_THAT(heights_of(series.plots[0]), ElementsAre(0.2, 0.7));  // 0.7 of 0.75 m across
  EXPECT_THAT(heights_of(series.plots[1]), ElementsAre(0.3, 0.8));  // 1.9 of 2 m along
  EXPECT_THAT(series.notes, IsEmpty());
}

TEST(Series, KeepsPlotsThatOneDateAloneHas) {
  const Series series =
      joined_series({found("a", {plot_at(1, 0, 0, 0.2), plot_at(2, 2, 0, 0.3)}),
                     found("b", {plot_at(1, 2.1, 0, 0.5), plot_at(2, 4, 0, 0.7),
                                 plot_at(3, 0.76, 0, 0.6), plot_at(4, 2, 0, 0.8)})});
  EXPECT_THAT(ids_of(series), ElementsAre("1", "2", "1@b", "2@b", "3"));
  EXPECT_THAT(heights_of(series.plots[0]), ElementsAre(0.2, -1));
  EXPECT_THAT(heights_of(series.plots[1]), ElementsAre(0.3, 0.8));  // the nearest of two
  EXPECT_THAT(heights_of(series.plots[2]), ElementsAre(-1, 0.5));
  EXPECT_THAT(series.notes, ElementsAre("b: 1 of the 2 plots before it are missing, 3 are new"));
}

TEST(Series, TakesTheNamesOfTheResultThatHasThoseOfAMap) {
  const Series series =
      joined_series({found("2026-06-01", {plot_at(1, 0, 0, 0.2), plot_at(2, 2, 0, 0.3)}),
                     given("2026-07-01", {plot_at(101, 2, 0, 0.8), plot_at(102, 0, 0, 0.7)})});
  EXPECT_EQ(series.joined_by, JoinBy::places);
  EXPECT_THAT(ids_of(series), ElementsAre("101", "102"));
  EXPECT_THAT(heights_of(series.plots[0]), ElementsAre(0.3, 0.8));
}

TEST(Series, JoinsPlotsOfOneMapByTheirIds) {
  std::vector<DatedEstimate> results = {
      given("2026-06-01", {plot_at(101, 0, 0, 0.2), plot_at(102, 2, 0, 0.3)}),
      given("2026-07-01", {plot_at(102, 502, 0, 0.8), plot_at(101, 500, 0, 0.7)})};
  EXPECT_THAT(joined_series(results).notes, ElementsAre(HasSubstr("2 of 2 plots lie more than")));
  results[1].estimate.crs = "EPSG:32632";
  const Series series = joined_series(results);
  EXPECT_EQ(series.joined_by, JoinBy::ids);
  EXPECT_THAT(heights_of(series.plots[0]), ElementsAre(0.2, 0.7));
  EXPECT_THAT(series.notes, IsEmpty());  // their places cannot be compared
}

TEST(Series, RefusesWhatCannotBeJoined) {
  std::vector<DatedEstimate> results = {found("a", {plot_at(1, 0, 0, 0.2)}),
                                        found("b", {plot_at(1, 0, 0, 0.8)})};
  const auto refusal = [&](std::optional<JoinBy> by = std::nullopt) {
    return message_of<InputError>([&] { joined_series(results, by); });
  };
  results[1].estimate.crs = "EPSG:32632";
  EXPECT_THAT(refusal(), HasSubstr("of_b: is in \"EPSG:32632\", of_a in coordinates of no known"));
  EXPECT_EQ(joined_series(results, JoinBy::ids).plots.size(), 1U);
  results[1] = found("b", {plot_at(7, 50, 0, 0.8)});
  EXPECT_THAT(refusal(), HasSubstr("of_b: has no plot where another result has one: its plots lie "
                                   "within x 49.2 to 50.8, y -2.0 to 2.0, those of the others"));
  EXPECT_THAT(refusal(JoinBy::ids), HasSubstr("of_b: has no plot id that an earlier result has"));
  results[1] = found("b", {});
  EXPECT_THAT(refusal(), HasSubstr("of_b: has no plots"));
  results[1] = found("a", {plot_at(1, 0, 0, 0.8)});
  EXPECT_THAT(refusal(), HasSubstr("have the same date, a; --dates gives each its own"));
}

TEST(Growth, GoesFromEachDateWithTheHeightToTheNext) {
  Series series =
      joined_series({found("a", {plot_at(1, 0, 0, 0.2, 0.03)}), found("b", {plot_at(1, 0, 0, 0.5)}),
                     found("c", {plot_at(1, 0, 0, 0.9, 0.04)})});
  series.plots[0].at[0]->flags = {"ground is unsure by centimetres"};
  series.plots[0].at[2]->flags = {"mean height is unsure by centimetres", "too few returns"};
  series.plots[0].at[1]->heights_m.erase("canopy_p95");
  const std::vector<Growth> growth = growth_of(series.plots[0], "canopy_p95");
  ASSERT_EQ(growth.size(), 1U);
  EXPECT_EQ(growth[0].from, 0U);
  EXPECT_EQ(growth[0].to, 2U);
  EXPECT_NEAR(growth[0].growth_m, 0.7, 1e-12);
  EXPECT_NEAR(growth[0].standard_error_m, 0.05, 1e-12);  // 3, 4, 5
  EXPECT_THAT(growth[0].flags, ElementsAre("ground is unsure by centimetres", "too few returns"));
  const std::vector<Growth> of_mean = growth_of(series.plots[0], "mean");
  ASSERT_EQ(of_mean.size(), 2U);
  EXPECT_TRUE(std::isnan(of_mean[0].standard_error_m));
  EXPECT_EQ(of_mean[1].flags.size(), 2U);  // the mean's own flag counts for the mean
}

}  // namespace
}  // namespace plotscan::series
