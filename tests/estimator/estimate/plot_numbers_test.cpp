// SPDX-License-Identifier: Apache-2.0
#include "estimate/plot_numbers.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/angle.h"
#include "core/error.h"
#include "estimator/synthetic_farm.h"
#include "temporary_folder.h"

namespace plotscan::estimate {
namespace {

using plotscan::testing::message_of;
using plotscan::testing::TemporaryFolder;
using ::testing::HasSubstr;
using testing::SyntheticFarm;

// 2 rows of 3 plots. Heading 0: plots lie west to east, row 1 is the western one, and columns count
// northwards.
Estimate found(double heading_rad = 0) {
  const SyntheticFarm farm{.rows = 2, .columns = 3, .heading_rad = heading_rad};
  Estimate estimate{.method = "lattice"};
  for (int row = 0; row < 2; ++row) {
    for (int column = 0; column < 3; ++column) {
      estimate.plots.push_back({.id = estimate.plots.size() + 1,
                                .row = row + 1,
                                .column = column + 1,
                                .box = farm.box(row, column)});
    }
  }
  return estimate;
}

// The ids as they lie on the map: one line for each of the 3 columns from north to south, each from
// west to east. Made of the boxes' places alone.
std::string map_of(const Estimate& estimate) {
  std::map<std::pair<int, int>, std::string> places;
  for (const PlotEstimate& plot : estimate.plots) {
    const int south = static_cast<int>(std::lround(-plot.box.center.y() / 2.5));
    const int east = plot.box.center.x() > 0 ? 1 : 0;
    places[{south, east}] = plot.id.text();
  }
  std::string text;
  for (const auto& [place, id] : places) text += id + (place.second == 1 ? "\n" : " ");
  return text;
}

std::string numbered(const NumberingOptions& options, Estimate estimate = found()) {
  number_plots(options, estimate);
  return map_of(estimate);
}

// The same plots twice, the second time as a trial 100 m farther north.
Estimate two_trials() {
  Estimate estimate = found();
  for (PlotEstimate plot : found().plots) {
    plot.box.center.y() += 100;
    plot.trial = 2;
    estimate.plots.push_back(plot);
  }
  for (std::size_t i = 0; i < 6; ++i) estimate.plots[i].trial = 1;
  return estimate;
}

TEST(PlotNumbers, CountEachTrialFromItsOwnCorner) {
  EXPECT_EQ(numbered({.first_number = 101}, two_trials()),
            "109 112\n108 111\n107 110\n" + numbered({.first_number = 101}));
  EXPECT_EQ(numbered({.first_corner = Corner::nw}, two_trials()),
            "7 10\n8 11\n9 12\n" + numbered({.first_corner = Corner::nw}));
}

TEST(PlotNumbers, AreGivenByNameToOneTrialOnly) {
  Estimate estimate = two_trials();
  const std::string message =
      message_of<InputError>([&] { name_plots({}, NamedPlaces{}, estimate); });
  EXPECT_THAT(message, HasSubstr("2 trials"));
  EXPECT_THAT(message, HasSubstr("--crop-box"));
}

TEST(PlotNumbers, StartInTheCornerThatIsNamed) {
  EXPECT_EQ(numbered({.first_number = 101}), "103 106\n102 105\n101 104\n");
  EXPECT_EQ(numbered({.first_corner = Corner::se}), "6 3\n5 2\n4 1\n");
  EXPECT_EQ(numbered({.first_corner = Corner::nw}), "1 4\n2 5\n3 6\n");
  EXPECT_EQ(numbered({.first_corner = Corner::ne}), "4 1\n5 2\n6 3\n");
}

TEST(PlotNumbers, TurnBackInEveryOtherRow) {
  EXPECT_EQ(numbered({.first_number = 101, .numbering = PlotNumbering::serpentine}),
            "103 104\n102 105\n101 106\n");
  EXPECT_EQ(numbered({.numbering = PlotNumbering::serpentine, .first_corner = Corner::ne}),
            "6 1\n5 2\n4 3\n");
}

// Whatever way the method counted rows and columns.
TEST(PlotNumbers, DoNotDependOnHowThePlotsWereFound) {
  Estimate other = found();
  for (PlotEstimate& plot : other.plots) {
    plot.row = 3 - plot.row;
    plot.column = 4 - plot.column;
  }
  EXPECT_EQ(numbered({.first_corner = Corner::nw}, other), numbered({.first_corner = Corner::nw}));
}

// A field turned by 20 degrees keeps its corners.
TEST(PlotNumbers, FollowATurnedField) {
  const auto ids = [](double heading_rad) {
    Estimate estimate = found(heading_rad);
    number_plots({.numbering = PlotNumbering::serpentine, .first_corner = Corner::se}, estimate);
    std::vector<Eigen::Vector2d> centers;
    for (const PlotEstimate& plot : estimate.plots)
      centers.emplace_back(Eigen::Rotation2Dd(-heading_rad) * plot.box.center);
    return centers;
  };
  const auto straight = ids(0);
  const auto turned = ids(radians(20));
  for (std::size_t i = 0; i < straight.size(); ++i)
    EXPECT_LT((straight[i] - turned[i]).norm(), 1e-9);
}

TEST(PlotNumbers, LeaveANumberToAPlotThatFailed) {
  Estimate estimate = found();
  estimate.plots.erase(estimate.plots.begin() + 1);
  number_plots({.first_number = 11, .numbering = PlotNumbering::serpentine}, estimate);
  std::vector<std::string> ids;
  for (const PlotEstimate& plot : estimate.plots) ids.push_back(plot.id.text());
  EXPECT_THAT(ids, ::testing::ElementsAre("11", "13", "14", "15", "16"));
}

// Every second plot of a field is there, so that no two are neighbours.
TEST(PlotNumbers, CountOnAChequerboard) {
  const auto chequered = [] {
    const SyntheticFarm farm{.rows = 4, .columns = 4};
    Estimate estimate{.method = "lattice"};
    for (int row = 0; row < 4; ++row) {
      for (int column = row % 2; column < 4; column += 2) {
        estimate.plots.push_back({.id = estimate.plots.size() + 1,
                                  .row = row + 1,
                                  .column = column + 1,
                                  .box = farm.box(row, column)});
      }
    }
    return estimate;
  };
  Estimate from_south_west = chequered(), from_north_east = chequered();
  number_plots({.first_corner = Corner::sw}, from_south_west);
  number_plots({.first_corner = Corner::ne}, from_north_east);
  for (std::size_t i = 0; i < 8; ++i) {
    const PlotEstimate& plot = from_south_west.plots[i];
    const auto same = std::ranges::find(from_north_east.plots, plot.box.center,
                                        [](const auto& other) { return other.box.center; });
    EXPECT_EQ(same->row, 5 - plot.row);
    EXPECT_EQ(same->column, 5 - plot.column);
  }
}

TEST(PlotNumbers, NeedRowsAndColumns) {
  Estimate estimate = found();
  estimate.plots[2].row = 0;
  EXPECT_THAT(message_of<InputError>([&] { number_plots({}, estimate); }),
              HasSubstr("no rows and columns"));
}

constexpr const char* kTable =
    "row,column,plot_id,cultivar\n1,1,A1,\"Rock, early\"\n1,2,A2,Tor\n1,3,A3,Tor\n"
    "2,1,B1,Rock\n2,2,B2,Tor\n2,3,0101,Rock\n";

TEST(PlotNames, AreThoseOfTheirPlaces) {
  const TemporaryFolder folder;
  const NamedPlaces places = read_named_places(folder.write("book.csv", kTable));
  Estimate estimate = found();
  estimate.plots.erase(estimate.plots.begin() + 4);
  name_plots({.first_corner = Corner::nw}, places, estimate);
  EXPECT_EQ(map_of(estimate), "A1 B1\nA2 A3 0101\n") << "B2 has no plot";
  EXPECT_EQ(estimate.id_property, "plot_id");
  EXPECT_EQ(estimate.plots[0].attributes["cultivar"], "Rock, early");
  EXPECT_EQ(estimate.diagnostics.names.value().not_found, std::vector{PlotId("B2")});
}

// A table's own numbers beside its rows and columns are not those of the estimate.
TEST(PlotNames, LeaveRowAndColumnNumbersToTheEstimate) {
  const TemporaryFolder folder;
  const NamedPlaces places = read_named_places(
      folder.write("book.csv", "row,column,row_number,col_number,plot_id\n1,1,7,9,A\n"));
  const nlohmann::json& attributes = places.plots.at({1, 1}).attributes;
  EXPECT_EQ(attributes["given_row_number"], "7");
  EXPECT_EQ(attributes["given_col_number"], "9");
  EXPECT_FALSE(attributes.contains("row_number"));
}

TEST(PlotNames, AreRefusedWhereTheyDoNotFitTheField) {
  const TemporaryFolder folder;
  const auto message = [&](const std::string& table) {
    const auto file = folder.write("book.csv", table);
    Estimate estimate = found();
    return message_of<InputError>([&] { name_plots({}, read_named_places(file), estimate); });
  };
  const std::string text = kTable;
  EXPECT_THAT(message(text + "3,1,C1,Tor\n"),
              HasSubstr("have 3 rows and 3 columns, and plots in 2 rows and 3 columns were found"));
  EXPECT_THAT(message("row,col,plot_id\n1,1,A\n2,3,B\n"),
              HasSubstr("in row 1, column 2, and no plot is named there"));
  EXPECT_THAT(message(text + "2,3,B4,Tor\n"), HasSubstr("book.csv:8: names a row and column"));
  EXPECT_THAT(message(text + "2,4,A1,Tor\n"), HasSubstr("line 2 and line 8 have the same plot_id"));
  EXPECT_THAT(message("row,column,plot_id\n1,x,A\n"), HasSubstr("book.csv:2: column \"x\""));
  EXPECT_THAT(message("row,plot_id\n1,A\n"), HasSubstr("has no column column or col"));
  EXPECT_THAT(message("row,column,label\n1,1,A\n"), HasSubstr("--id names the column"));
  EXPECT_THAT(message("row,column,plot_id\n"), HasSubstr("has no plots"));
}

}  // namespace
}  // namespace plotscan::estimate
