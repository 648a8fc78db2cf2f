// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/angle.h"
#include "core/random.h"
#include "estimator/plots/trial_cloud.h"
#include "plots/search/find_trials.h"
#include "plots/signs/field_signs.h"

namespace plotscan::plots {
namespace {

using testing::HasSubstr;

// Two rows of plants 0.75 m apart, their leaves 0.36 m wide, half a row's spacing from the edges.
bool in_two_drill_rows(const PlotBox&, const Eigen::Vector2d& from_center) {
  return std::abs(std::abs(from_center.y()) - 0.375) < 0.18;
}

// Two rows 1 m apart, as maize's; their leaves lean 3.5 cm to where there is light.
bool in_two_wide_rows(const PlotBox&, const Eigen::Vector2d& from_center) {
  return std::abs(std::abs(from_center.y()) - 0.535) < 0.18;
}

// Five rows that show as two pairs with a row between them.
bool in_five_drill_rows(const PlotBox&, const Eigen::Vector2d& from_center) {
  const double off_m = std::abs(from_center.y());
  return off_m < 0.15 || (off_m > 0.24 && off_m < 0.68);
}

// Three rows 0.43 m apart, as young soybeans'.
bool in_three_drill_rows(const PlotBox&, const Eigen::Vector2d& from_center) {
  const double off_m = std::abs(from_center.y());
  return off_m < 0.09 || std::abs(off_m - 0.43) < 0.09;
}

// A number of its own for each plot.
std::uint64_t number_of(const PlotBox& box) {
  return static_cast<std::uint64_t>(std::llround(1000 * std::abs(box.center.sum())));
}

// Squares of 0.25 m of which a share holds a plant, drawn for each plot.
bool in_clumps(const PlotBox& box, const Eigen::Vector2d& from_center, double share) {
  const Eigen::Vector2i square = (from_center / 0.25).array().floor().cast<int>();
  const auto index = static_cast<std::uint64_t>((square.x() + 64) * 128 + square.y() + 64);
  return RandomStream(number_of(box), random_purpose("test/clump"), index).uniform() < share;
}

bool in_one_of_three_clumps(const PlotBox& box, const Eigen::Vector2d& from_center) {
  return in_clumps(box, from_center, 0.35);
}

// Dense at one end of the plot and thin at the other.
bool at_one_end(const PlotBox& box, const Eigen::Vector2d& from_center) {
  return in_clumps(box, from_center, from_center.x() < 0 ? 0.9 : 0.25);
}

bool at_either_end(const PlotBox& box, const Eigen::Vector2d& from_center) {
  return at_one_end(box, number_of(box) % 2 == 0 ? from_center : -from_center);
}

void expect_found(const Trial& trial, const Sown& sown = everywhere, double least_iou = 0.9) {
  const std::vector<PlotBox> truths = trial.boxes();
  const PlotField field = find_plots(cloud_over(truths, sown), 0.02, {}, 2);
  EXPECT_EQ(field.why_none, "");
  ASSERT_EQ(field.plots.size(), truths.size());
  for (const PlotBox& truth : truths) {
    double best = 0;
    for (const FoundPlot& plot : field.plots) {
      best = std::max(best, intersection_over_union(truth, plot.box));
    }
    EXPECT_GT(best, least_iou) << truth.center.transpose();
  }
  EXPECT_TRUE(std::ranges::is_sorted(
      field.plots, {}, [](const FoundPlot& plot) { return std::pair(plot.row, plot.column); }));
  const double off_rad = heading_difference(field.plots.front().box.heading_rad, trial.heading_rad);
  EXPECT_LT(off_rad, 0.3 * kDegrees);
}

TEST(FindPlots, FindsATurnedTrial) { expect_found({}); }
TEST(FindPlots, LeavesAMissingPlotOut) { expect_found({.missing = 8}); }
TEST(FindPlots, FindsPlotsWithNarrowGaps) { expect_found({.gap_m = 0.2, .row_gap_m = 0.3}); }
TEST(FindPlots, FollowsRowsThatStartAtOffsets) { expect_found({.offsets_m = {0.6, -0.5, 0.1}}); }

// The last row begins two plots before the others and lacks its second plot, so that no row has a
// plot there; and the rows' offsets, less whole plots, lie on a line as those of tilted plots
// would.
TEST(FindPlots, KeepsAPlaceThatNoRowFills) {
  expect_found({.offsets_m = {0.35, 0, -0.35 - 2 * 1.9}, .missing = 13});
}

// The box reaches half a row's spacing beyond the outer rows, where there are no leaves.
// As clouds often are, along the plots' sides. The plots are thin, as young ones.
TEST(FindPlots, FindsPlotsInACloudThatIsCutToThem) {
  const Trial trial;
  const PlotBox field{.width_m = 11.4, .length_m = 14, .heading_rad = trial.heading_rad};
  for (const double margin_m : {0.0, 0.3, 1.0}) {
    std::vector<Eigen::Vector3f> points = cloud_over(trial.boxes(), in_one_of_three_clumps);
    PlotBox kept = field;
    kept.width_m += 2 * margin_m;
    kept.length_m += 2 * margin_m;
    std::erase_if(points, [&](const Eigen::Vector3f& point) {
      return !kept.contains(point.head<2>().cast<double>());
    });
    expect_those(trial.boxes(), find_plots(points, 0.02, {}, 2), 0.8);
  }
}

TEST(FindPlots, PutsDrillRowsTogether) { expect_found({.gap_m = 0.3}, in_two_drill_rows); }
TEST(FindPlots, PutsTheWidestDrillRowsTogether) {
  expect_found({.columns = 4, .gap_m = 0.9, .width_m = 2}, in_two_wide_rows);
}
TEST(FindPlots, PutsPairsOfDrillRowsWithARowBetweenThemTogether) {
  expect_found({.gap_m = 0.36}, in_five_drill_rows, 0.85);
}
// The gaps are two rows wide and the offsets some rows, so that rows run through the whole field.
// Pairs of rows, with a thin one between them in place of a gap, explain the canopy too.
TEST(FindPlots, PutsFiveDrillRowsTogetherOfWhichOneIsThin) {
  constexpr double kSpacing_m = 0.32, kHalfRow_m = 0.09, kClump_m = 0.5, kThin = 0.3;
  const Sown in_five_rows = [](const PlotBox&, const Eigen::Vector2d& from_center) {
    const double row = from_center.y() / kSpacing_m, clump = from_center.x() / kClump_m;
    const bool in_row = std::abs(row - std::round(row)) * kSpacing_m < kHalfRow_m;
    const bool in_clump = std::round(row) != 0 || clump - std::floor(clump) < kThin;
    return std::abs(row) < 2.5 && in_row && in_clump;
  };
  expect_found({.gap_m = 0.4, .width_m = 1.6}, in_five_rows);
}
TEST(FindPlots, PutsDrillRowsTogetherThatRunThroughAllRowsOfPlots) {
  expect_found({.gap_m = 0.86, .offsets_m = {0.86, -0.43, 0}, .width_m = 1.29},
               in_three_drill_rows);
}
TEST(FindPlots, FindsPlotsOfSingleClumps) { expect_found({}, in_one_of_three_clumps, 0.8); }

// From metre to metre a plot's canopy differs from its mean by (0.9 - 0.25) / (0.9 + 0.25) of that.
// Plants at random do so in every plot in its own way, trees two by two in all plots alike.
TEST(FindPlots, TellsPlotsOfFewPlantsFromTreesAtEqualPlaces) {
  constexpr double kUneven = 0.65 / 1.15;
  const std::vector<PlotBox> boxes = Trial{}.boxes();
  const auto signs_where = [&](const Sown& sown) {
    return find_plots(cloud_over(boxes, sown), 0.02, {.width_m = 1.5, .length_m = 4}, 2).signs;
  };
  const auto plants = signs_where(at_either_end), trees = signs_where(at_one_end);
  ASSERT_TRUE(plants && trees);
  EXPECT_NEAR(plants->unevenness, kUneven, 0.1);
  EXPECT_LT(plants->mean_unevenness, 0.2);
  EXPECT_EQ(no_plots_because(*plants), "");
  EXPECT_NEAR(trees->mean_unevenness, kUneven, 0.1);
  EXPECT_THAT(no_plots_because(*trees), HasSubstr("single bushes or trees"));
}

// Strips side by side may be the rows of one plot, or plots: the user may know.
std::vector<Eigen::Vector3f> points_over_strips() {
  std::vector<PlotBox> strips;
  for (const PlotBox& box : Trial{.gap_m = 0.8}.boxes()) {
    for (const double side : {-0.42, 0.42}) {
      strips.push_back(box);
      strips.back().center += side * box.width_axis();
      strips.back().width_m = 0.66;
    }
  }
  return cloud_over(strips);
}

TEST(FindPlots, TakesTheSidesThatAreKnown) {
  const std::vector<Eigen::Vector3f> points = points_over_strips();
  EXPECT_EQ(find_plots(points, 0.02, {}, 2).plots.size(), 18U);
  const PlotField known = find_plots(points, 0.02, {.width_m = 0.66, .length_m = 4}, 2);
  ASSERT_EQ(known.plots.size(), 36U);
  EXPECT_NEAR(known.plots.front().box.width_m, 0.66, 0.1);
}

TEST(FindPlots, TakesTheNumbersThatAreKnown) {
  const std::vector<Eigen::Vector3f> points = points_over_strips();
  const auto found = [&](const Hints& hints) { return find_plots(points, 0.02, hints, 2); };
  EXPECT_EQ(found({.columns = 12}).plots.size(), 36U);
  EXPECT_EQ(found({.rows = 3, .columns = 12}).plots.size(), 36U);
  EXPECT_EQ(found({.columns = 6}).plots.size(), 18U);
  EXPECT_EQ(found({.plots = 36}).plots.size(), 36U);
  EXPECT_EQ(found({.plots = 18}).plots.size(), 18U);
  EXPECT_EQ(found({.rows = 3}).rival, "");
  EXPECT_THAT(found({.rows = 5}).why_none, HasSubstr("the canopy shows 3 rows of 6 plots"));
  EXPECT_NE(found({.plots = 7}).why_none, "");
}

// Wheels went across the plots: pieces of these show, unless the plots' length is known.
TEST(FindPlots, FindsPlotsOfKnownSidesThatWheelsCrossed) {
  std::vector<PlotBox> boxes = Trial{.row_gap_m = 10, .heading_rad = 0}.boxes();
  for (PlotBox& box : boxes) box.length_m = 12;
  const Sown beside_tracks = [](const PlotBox&, const Eigen::Vector2d& from_center) {
    return std::abs(from_center.x() + 2) > 0.18 && std::abs(from_center.x() + 0.2) > 0.18;
  };
  const std::vector<Eigen::Vector3f> points = cloud_over(boxes, beside_tracks, 24, 8);
  EXPECT_NE(find_plots(points, 0.02, {}, 2).plots.size(), 18U);
  expect_those(boxes, find_plots(points, 0.02, {.width_m = 1.5, .length_m = 12}, 2));
}

// A tractor's wheels ran along plots of 3 m: two tracks, and a piece of 1.2 m between them. The
// pieces beside the tracks of two plots are as far apart as those of one.
TEST(FindPlots, FindsPlotsWithTracksOfWheelsAlongThem) {
  const Sown beside_tracks = [](const PlotBox&, const Eigen::Vector2d& from_center) {
    return std::abs(std::abs(from_center.y()) - 0.775) > 0.175;
  };
  const std::vector<PlotBox> boxes = Trial{.gap_m = 0.5, .width_m = 3}.boxes();
  const std::vector<Eigen::Vector3f> points = cloud_over(boxes, beside_tracks, 16, 16);
  for (const Hints& hints : {Hints{}, Hints{.width_m = 3, .length_m = 4}})
    expect_those(boxes, find_plots(points, 0.02, hints, 2));
}

// Plots of one drill row, of which the step from plot to plot is told as the width.
TEST(FindPlots, TakesTheStepForTheWidthIfThatIsTold) {
  std::vector<PlotBox> boxes = Trial{.gap_m = 0.4, .width_m = 0.5}.boxes();
  const std::vector<Eigen::Vector3f> points = cloud_over(boxes);
  for (PlotBox& box : boxes) {
    box.width_m = 0.9;
    box.length_m = 3.7;
  }
  expect_those(boxes, find_plots(points, 0.02, {.width_m = 0.9, .length_m = 3.7}, 2));
  const Hints all{.width_m = 0.9, .length_m = 3.7, .rows = 3, .columns = 6};
  expect_those(boxes, find_plots(points, 0.02, all, 2));
}

// Every other row begins half a step farther on.
TEST(FindPlots, CountsTheColumnsOfTheWidestRow) {
  const Trial trial{.offsets_m = {0, 0.95, 0}};
  expect_those(trial.boxes(),
               find_plots(cloud_over(trial.boxes()), 0.02, {.rows = 3, .columns = 6}, 2));
}

// What contradicts the canopy is taken all the same, and said.
TEST(FindPlots, SaysWhatTheCanopyShowsMoreClearlyThanWhatWasTold) {
  const std::vector<Eigen::Vector3f> points = cloud_over(Trial{}.boxes());
  const PlotField told = find_plots(points, 0.02, {.width_m = 0.9, .length_m = 4}, 2);
  EXPECT_THAT(told.rival, HasSubstr("3 rows of 6 plots of 1.5"));
  EXPECT_EQ(find_plots(points, 0.02, {.width_m = 1.5, .length_m = 4}, 2).rival, "");
}

// As in breeding trials whose rows run on at one spacing.
TEST(FindPlots, FindsPlotsWithoutAGapWhoseWidthIsKnown) {
  const Trial trial{.gap_m = 0, .missing = 8};
  const std::vector<Eigen::Vector3f> points = cloud_over(trial.boxes(), in_two_drill_rows);
  expect_those(trial.boxes(), find_plots(points, 0.02, {.width_m = 1.5}, 2));
  expect_those(trial.boxes(), find_plots(points, 0.02, {.width_m = 1.5, .length_m = 4}, 2), 0.97);
  expect_those(trial.boxes(), find_plots(points, 0.02, {.rows = 3, .columns = 6}, 2));
  // Rows of a crop are no plots, and are no reason to doubt what was told.
  EXPECT_NE(find_plots(points, 0.02, {}, 2).why_none, "");
  EXPECT_EQ(find_plots(points, 0.02, {.width_m = 1.5}, 2).rival, "");
}

// 9 x 12 m of crop are 6 x 3 plots of 1.5 x 4 m, or 4 x 4.5 of them: which way they lie must be
// told.
TEST(FindPlots, FindsPlotsWithoutAnyGapWhoseSidesAndHeadingAreKnown) {
  const Trial trial{.gap_m = 0, .row_gap_m = 0};
  const Hints hints{.heading_rad = trial.heading_rad, .width_m = 1.5, .length_m = 4};
  expect_those(trial.boxes(), find_plots(cloud_over(trial.boxes()), 0.02, hints, 2));
}

TEST(FindPlots, LeavesOutTheMissingOneOfTheNumberThatIsKnown) {
  const std::vector<PlotBox> boxes = Trial{.missing = 8}.boxes();
  const auto plots = static_cast<int>(boxes.size());
  EXPECT_EQ(find_plots(cloud_over(boxes), 0.02, {.plots = plots}, 2).plots.size(), boxes.size());
}

TEST(FindPlots, SaysThatBareGroundHasNone) {
  const PlotField field = find_plots(cloud_over({}), 0.02, {}, 2);
  EXPECT_TRUE(field.plots.empty());
  EXPECT_NE(field.why_none, "");
}

TEST(FindPlots, FindsOneToThreePlots) {
  for (const std::size_t count : {1U, 2U, 3U}) {
    std::vector<PlotBox> few = Trial{}.boxes();
    few.resize(count);
    const PlotField field = find_plots(cloud_over(few), 0.02, {}, 2);
    ASSERT_EQ(field.plots.size(), count) << field.why_none;
    for (std::size_t i = 0; i < count; ++i)
      EXPECT_GT(intersection_over_union(few[i], field.plots[i].box), 0.9);
  }
}

// Of one large rectangle nothing tells whether it is a plot, but the user.
TEST(FindPlots, TakesAWholeCropForAPlotIfToldSo) {
  const std::vector<PlotBox> crop = {{.width_m = 10, .length_m = 13, .heading_rad = 33 * kDegrees}};
  const std::vector<Eigen::Vector3f> points = cloud_over(crop);
  const PlotField field = find_plots(points, 0.02, {}, 2);
  EXPECT_TRUE(field.plots.empty());
  EXPECT_NE(field.why_none.find("a whole crop"), std::string::npos) << field.why_none;
  const PlotField told = find_plots(points, 0.02, {.plots = 1}, 2);
  expect_those(crop, told);
  EXPECT_EQ(told.doubt, "");
}

TEST(FindPlots, SaysThatRandomBushesAreNoLattice) {
  for (const std::uint64_t bushes : {12, 25, 50, 100}) {
    std::vector<PlotBox> boxes;
    for (std::uint64_t i = 0; i < bushes; ++i) {
      RandomStream random(bushes, random_purpose("test/bush"), i);
      const Eigen::Vector2d place(random.uniform(-9, 9), random.uniform(-9, 9));
      boxes.push_back({.center = place,
                       .width_m = random.uniform(0.4, 0.9),
                       .length_m = random.uniform(0.4, 0.9),
                       .heading_rad = random.uniform(0, 3)});
    }
    EXPECT_NE(find_plots(cloud_over(boxes), 0.02, {}, 2).why_none, "") << bushes;
  }
}

// 60 returns a square metre: most cells of the raster are empty.
TEST(FindPlots, FindsPlotsInFewReturns) {
  const std::vector<PlotBox> boxes = Trial{}.boxes();
  const std::vector<Eigen::Vector3f> all = cloud_over(boxes);
  std::vector<Eigen::Vector3f> few;
  for (std::size_t i = 0; i < all.size(); i += 12) few.push_back(all[i]);
  const PlotField field = find_plots(few, 0.02, {}, 2);
  EXPECT_EQ(field.why_none, "");
  EXPECT_EQ(field.plots.size(), boxes.size());
}

TEST(FindPlots, SaysThatThereAreNoPoints) { EXPECT_NE(find_plots({}, 0.02, {}, 1).why_none, ""); }

TEST(FindPlots, IsTheSameForAnyNumberOfThreads) {
  const std::vector<Eigen::Vector3f> points = cloud_over(Trial{}.boxes());
  const PlotField one = find_plots(points, 0.02, {}, 1), two = find_plots(points, 0.02, {}, 2);
  ASSERT_EQ(one.plots.size(), two.plots.size());
  for (std::size_t i = 0; i < one.plots.size(); ++i) {
    EXPECT_EQ(one.plots[i].box.center, two.plots[i].box.center);
    EXPECT_EQ(one.plots[i].box.heading_rad, two.plots[i].box.heading_rad);
    EXPECT_EQ(one.plots[i].confidence, two.plots[i].confidence);
  }
  EXPECT_EQ(one.fit->layout.row_axis, two.fit->layout.row_axis);
  EXPECT_EQ(one.signs->squareness, two.signs->squareness);
}

// As in a trial of many cultivars: of two plots hardly a leaf is as high as those of the others.
TEST(FindPlots, FindsPlotsThatAreMuchLower) {
  const std::vector<PlotBox> boxes = Trial{}.boxes();
  std::vector<Eigen::Vector3f> points = cloud_over(boxes);
  for (Eigen::Vector3f& point : points)
    for (const std::size_t low : {0, 9})
      if (boxes[low].contains(point.head<2>().cast<double>())) point.z() *= 0.28F;
  expect_those(boxes, find_plots(points, 0.02, {}, 2));
}

// Seedlings of 4 to 12 cm, seen by a sensor of little noise.
TEST(FindPlots, FindsSeedlings) {
  const std::vector<PlotBox> boxes = Trial{}.boxes();
  std::vector<Eigen::Vector3f> points = cloud_over(boxes);
  for (Eigen::Vector3f& point : points) point.z() *= 0.15F;
  expect_those(boxes, find_plots(points, 0.003, {}, 2));
}

// Young plants at random in rows of 0.2 x 1.1 m across the plots, with bare ground between: the
// rows are not the plots.
TEST(FindPlots, FindsYoungPlotsOfShortRowsAcross) {
  constexpr double kSpacing_m = 0.45, kPlant_m = 0.12, kHalf_m = 0.1;
  const std::vector<PlotBox> boxes = Trial{.width_m = 1.1}.boxes();
  const auto grows = [&](const PlotBox& box, const Eigen::Vector2d& off) {
    const double row = std::floor(off.x() / kSpacing_m);
    const double plant = std::floor((off.y() + 5) / kPlant_m);
    const auto plot =
        static_cast<std::uint64_t>(1000 * box.center.x() + 77777 * box.center.y() + 1e7);
    RandomStream random(plot, random_purpose("test/plant"),
                        static_cast<std::uint64_t>((row + 50) * 1000 + plant));
    return random.uniform() < 0.75 &&
           std::abs(off.x() - (row + 0.5) * kSpacing_m) < kHalf_m * random.uniform(0.6, 1.4);
  };
  EXPECT_EQ(find_plots(cloud_over(boxes, grows), 0.02, {}, 2).plots.size(), boxes.size());
}

}  // namespace
}  // namespace plotscan::plots
