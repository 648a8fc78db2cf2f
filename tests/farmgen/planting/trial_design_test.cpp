// SPDX-License-Identifier: Apache-2.0
#include "planting/trial_design.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "planting/plot_layout.h"
#include "temporary_folder.h"

namespace plotscan::planting {
namespace {

using plotscan::testing::message_of;
using ::testing::HasSubstr;

std::vector<farm::Plot> grid(std::uint32_t rows, std::uint32_t columns,
                             PlotNumbering numbering = PlotNumbering::rows) {
  return grid_plots({.width_m = 1,
                     .length_m = 2,
                     .rows = std::vector<PlotRowDescription>(rows, {.plots = columns}),
                     .numbering = numbering});
}

std::vector<std::string> names(std::size_t count) {
  std::vector<std::string> all;
  for (std::size_t i = 0; i < count; ++i) all.push_back("c" + std::to_string(i));
  return all;
}

void expect_complete_blocks(const std::vector<farm::Plot>& plots, std::size_t cultivars) {
  std::map<int, std::set<std::string>> blocks;
  for (const farm::Plot& plot : plots) {
    EXPECT_TRUE(blocks[plot.block].insert(plot.accession).second)
        << plot.accession << " twice in block " << plot.block;
    EXPECT_EQ(plot.rep, plot.block);
  }
  EXPECT_EQ(blocks.size(), plots.size() / cultivars);
  for (const auto& [block, accessions] : blocks) EXPECT_EQ(accessions.size(), cultivars);
}

TEST(TrialDesign, EveryCultivarStandsOnceInEveryBlock) {
  for (const PlotNumbering numbering : {PlotNumbering::rows, PlotNumbering::serpentine}) {
    std::vector<farm::Plot> plots = grid(4, 15, numbering);
    assign_cultivars({.block_by = BlockBy::plots}, names(6), 3, plots);
    expect_complete_blocks(plots, 6);
    for (std::size_t i = 0; i < plots.size(); ++i) {
      EXPECT_EQ(plots[i].block, i / 6 + 1) << "plots that follow each other";
    }
  }
}

TEST(TrialDesign, BlocksMayBeWholeRowsOrColumns) {
  std::vector<farm::Plot> plots = grid(4, 15, PlotNumbering::serpentine);
  assign_cultivars({.block_by = BlockBy::rows}, names(30), 3, plots);
  expect_complete_blocks(plots, 30);
  for (const farm::Plot& plot : plots) EXPECT_EQ(plot.block, (plot.row + 1) / 2);
  assign_cultivars({.block_by = BlockBy::columns}, names(12), 3, plots);
  expect_complete_blocks(plots, 12);
  for (const farm::Plot& plot : plots) EXPECT_EQ(plot.block, (plot.column + 2) / 3);
}

TEST(TrialDesign, EveryOrderWithinABlockIsAsLikely) {
  std::vector<farm::Plot> plots = grid(1000, 4);
  const std::vector<std::size_t> assigned = assign_cultivars({}, names(4), 8, plots);
  std::map<std::vector<std::size_t>, int> orders;
  for (std::size_t i = 0; i < assigned.size(); i += 4) {
    ++orders[{assigned[i], assigned[i + 1], assigned[i + 2], assigned[i + 3]}];
  }
  EXPECT_EQ(orders.size(), 24u);
  double chi2 = 0;
  for (const auto& [order, count] : orders)
    chi2 += std::pow(count - 1000 / 24.0, 2) / (1000 / 24.0);
  EXPECT_LT(chi2, 49.7) << "of 23 degrees of freedom, exceeded with probability 0.001";
}

TEST(TrialDesign, CompletelyRandomisedIsBalanced) {
  std::vector<farm::Plot> plots = grid(5, 8);
  const auto assigned = assign_cultivars({.design = TrialDesign::random}, names(8), 3, plots);
  std::map<std::size_t, int> counts;
  for (std::size_t i = 0; i < plots.size(); ++i) {
    EXPECT_EQ(plots[i].rep, ++counts[assigned[i]]);
    EXPECT_EQ(plots[i].block, 1);
  }
  for (const auto& [cultivar, count] : counts) EXPECT_EQ(count, 5);
  auto again = grid(5, 8);
  EXPECT_NE(assigned, assign_cultivars({.design = TrialDesign::random}, names(8), 4, again));
  EXPECT_EQ(assigned, assign_cultivars({.design = TrialDesign::random}, names(8), 3, again));
}

TEST(TrialDesign, CyclesAndListsFollowTheNumbers) {
  std::vector<farm::Plot> plots = grid(2, 3, PlotNumbering::serpentine);
  EXPECT_EQ(assign_cultivars({.design = TrialDesign::cycle}, names(4), 1, plots),
            (std::vector<std::size_t>{0, 1, 2, 3, 0, 1}));
  EXPECT_EQ(plots[4].rep, 2);
  EXPECT_EQ(assign_cultivars({.design = TrialDesign::list, .list = {1, 1, 0, 0, 1, 0}}, names(2), 1,
                             plots),
            (std::vector<std::size_t>{1, 1, 0, 0, 1, 0}));
  EXPECT_EQ(plots[4].accession, "c1");
  EXPECT_EQ(plots[4].rep, 3);
}

TEST(TrialDesign, RefusesBlocksThatAreNotWhole) {
  std::vector<farm::Plot> plots = grid(2, 6);
  const auto message = [&](const DesignDescription& design, std::size_t cultivars) {
    return message_of<InputError>([&] { assign_cultivars(design, names(cultivars), 1, plots); });
  };
  EXPECT_THAT(message({}, 5), HasSubstr("12 plots are not a multiple of 5 cultivars"));
  EXPECT_THAT(message({.block_by = BlockBy::rows}, 4), HasSubstr("4 cultivars end within row 1"));
  EXPECT_THAT(message({.block_by = BlockBy::columns}, 3), HasSubstr("end within column 2"));
  EXPECT_THAT(message({.design = TrialDesign::list, .list = {0}}, 1),
              HasSubstr("list names the cultivars of 1 plots; the grid has 12"));
}

}  // namespace
}  // namespace plotscan::planting
