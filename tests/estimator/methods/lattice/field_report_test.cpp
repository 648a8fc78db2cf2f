// SPDX-License-Identifier: Apache-2.0
#include "methods/lattice/internal/field_report.h"

#include <set>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace plotscan::methods::lattice {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(FieldReport, TellsWhatWasLeftOut) {
  plots::PlotField field{.fit = plots::FieldFit{}};
  EXPECT_FALSE(json_of(field).contains("others_m2"));
  EXPECT_THAT(lines_of(field), Not(Contains(HasSubstr("left out"))));
  field.others_m2 = 477.6;
  EXPECT_EQ(json_of(field)["others_m2"], 477.6);
  EXPECT_THAT(lines_of(field), Contains(HasSubstr("left out   478 m2")));
  field.why_none = "no canopy";
  EXPECT_THAT(lines_of(field), Not(Contains(HasSubstr("left out"))));
}

// Three rows of four columns, but for these places.
plots::PlotField field_without(const std::set<std::pair<int, int>>& empty) {
  plots::PlotField field{.fit = plots::FieldFit{}};
  for (int row = 1; row <= 3; ++row)
    for (int column = 1; column <= 4; ++column)
      if (!empty.contains({row, column}))
        field.fit->layout.places.push_back({.row = row, .column = column});
  return field;
}

TEST(FieldReport, TellsPlacesWithoutAPlot) {
  EXPECT_FALSE(json_of(field_without({})).contains("places_without_plot"));
  EXPECT_THAT(lines_of(field_without({})), Not(Contains(HasSubstr("no plot"))));
  plots::PlotField field = field_without({{3, 1}, {1, 2}});
  EXPECT_EQ(json_of(field)["places_without_plot"], nlohmann::json::parse("[[1, 2], [3, 1]]"));
  EXPECT_THAT(lines_of(field),
              Contains("none found at 2 of 12 places: row 1 column 2, row 3 column 1"));
  field.fit->columns_aligned = false;
  EXPECT_FALSE(json_of(field).contains("places_without_plot"));
  field.fit->columns_aligned = true;
  field.why_none = "parked cars";
  EXPECT_FALSE(json_of(field).contains("places_without_plot"));
  const plots::PlotField many =
      field_without({{1, 1}, {1, 2}, {1, 3}, {2, 2}, {2, 3}, {2, 4}, {3, 1}});
  EXPECT_THAT(lines_of(many), Contains(AllOf(HasSubstr("at 7 of 12"), HasSubstr("column 4, ..."))));
}

TEST(FieldReport, TellsEachTrialWhereThereAreSeveral) {
  plots::PlotField small{.plots = std::vector<plots::FoundPlot>(48), .fit = plots::FieldFit{}};
  small.fit->layout = {.width_m = 1.2, .length_m = 2.5};
  small.fit->sown_rows = plots::SownRows{.rows = 6, .spacing_m = 0.2};
  estimate::Diagnostics of_one;
  report_trials({&small, 1}, of_one);
  EXPECT_EQ(of_one.lines, lines_of(small));
  EXPECT_EQ(of_one.of_method["field"], json_of(small));
  const std::vector<plots::PlotField> both = {small, small};
  estimate::Diagnostics of_two;
  report_trials(both, of_two);
  EXPECT_FALSE(of_two.of_method.contains("field"));
  EXPECT_EQ(of_two.of_method["trials"].size(), 2u);
  EXPECT_THAT(of_two.lines,
              ::testing::ElementsAre(HasSubstr("trial 1    48 plots of 1.20 x 2.50 m"),
                                     HasSubstr("trial 2    48 plots of 1.20 x 2.50 m")));
  EXPECT_THAT(of_two.lines.front(), HasSubstr("sown in 6 rows, 0.20 m apart"));
}

}  // namespace
}  // namespace plotscan::methods::lattice
