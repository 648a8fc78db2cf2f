// SPDX-License-Identifier: Apache-2.0
#include "plots/find_plots.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/angle.h"
#include "core/random.h"
#include "plots/internal/field_signs.h"

namespace plotscan::plots {
namespace {

using testing::HasSubstr;

// Plots 4 m long on a lattice turned by 33 degrees, with the given gaps.
struct Trial {
  int rows = 3, columns = 6;
  double gap_m = 0.4, row_gap_m = 0.8, heading_rad = 33 * kDegrees;
  std::vector<double> offsets_m = {0, 0, 0};
  int missing = -1;  // number of the plot that is not there, row by row
  double width_m = 1.5;

  std::vector<PlotBox> boxes() const {
    std::vector<PlotBox> list;
    const PlotBox axes{.heading_rad = heading_rad};
    for (int row = 0; row < rows; ++row) {
      for (int column = 0; column < columns; ++column) {
        if (row * columns + column == missing) continue;
        const double along = (row - 1) * (4 + row_gap_m);
        const double across =
            (column - 2.5) * (width_m + gap_m) + offsets_m[static_cast<std::size_t>(row)];
        list.push_back({.center = axes.length_axis() * along + axes.width_axis() * across,
                        .width_m = width_m,
                        .length_m = 4,
                        .heading_rad = heading_rad});
      }
    }
    return list;
  }
};

// Whether a plant stands at a place of a plot; `from_center` is along its length and its width.
using Sown = std::function<bool(const PlotBox& box, const Eigen::Vector2d& from_center)>;

bool everywhere(const PlotBox&, const Eigen::Vector2d&) { return true; }

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

// Returns spread evenly over a square; of those in a box where plants stand, three of four are from
// its canopy.
std::vector<Eigen::Vector3f> points_over(const std::vector<PlotBox>& boxes,
                                         const Sown& sown = everywhere) {
  constexpr int kPoints = 400000;
  constexpr double kHalf_m = 12;
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < kPoints; ++i) {
    RandomStream random(7, random_purpose("test/point"), static_cast<std::uint64_t>(i));
    const Eigen::Vector2d place(random.uniform(-kHalf_m, kHalf_m),
                                random.uniform(-kHalf_m, kHalf_m));
    double height = 0.02 * random.normal();
    for (const PlotBox& box : boxes) {
      if (!box.contains(place) || !sown(box, box.box_from_world(place))) continue;
      if (random.uniform() < 0.75) height = random.uniform(0.3, 0.8);
    }
    points.emplace_back(place.cast<float>().x(), place.cast<float>().y(),
                        static_cast<float>(height));
  }
  return points;
}

void expect_found(const Trial& trial, const Sown& sown = everywhere, double least_iou = 0.9) {
  const std::vector<PlotBox> truths = trial.boxes();
  const PlotField field = find_plots(points_over(truths, sown), 0.02, {}, 2);
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
TEST(FindPlots, PutsDrillRowsTogether) { expect_found({.gap_m = 0.3}, in_two_drill_rows); }
TEST(FindPlots, PutsTheWidestDrillRowsTogether) {
  expect_found({.columns = 4, .gap_m = 0.9, .width_m = 2}, in_two_wide_rows);
}
TEST(FindPlots, PutsPairsOfDrillRowsWithARowBetweenThemTogether) {
  expect_found({.gap_m = 0.36}, in_five_drill_rows, 0.85);
}
// The gaps are two rows wide and the offsets some rows, so that rows run through the whole field.
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
    return find_plots(points_over(boxes, sown), 0.02, {.width_m = 1.5, .length_m = 4}, 2).signs;
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
  return points_over(strips);
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

// What contradicts the canopy is taken all the same, and said.
TEST(FindPlots, SaysWhatTheCanopyShowsMoreClearlyThanWhatWasTold) {
  const std::vector<Eigen::Vector3f> points = points_over(Trial{}.boxes());
  const PlotField told = find_plots(points, 0.02, {.width_m = 0.9, .length_m = 4}, 2);
  EXPECT_THAT(told.rival, HasSubstr("3 rows of 6 plots of 1.5"));
  EXPECT_EQ(find_plots(points, 0.02, {.width_m = 1.5, .length_m = 4}, 2).rival, "");
}

TEST(FindPlots, LeavesOutTheMissingOneOfTheNumberThatIsKnown) {
  const std::vector<PlotBox> boxes = Trial{.missing = 8}.boxes();
  const auto plots = static_cast<int>(boxes.size());
  EXPECT_EQ(find_plots(points_over(boxes), 0.02, {.plots = plots}, 2).plots.size(), boxes.size());
}

TEST(FindPlots, SaysThatBareGroundHasNone) {
  const PlotField field = find_plots(points_over({}), 0.02, {}, 2);
  EXPECT_TRUE(field.plots.empty());
  EXPECT_NE(field.why_none, "");
}

TEST(FindPlots, FindsOneToThreePlots) {
  for (const std::size_t count : {1U, 2U, 3U}) {
    std::vector<PlotBox> few = Trial{}.boxes();
    few.resize(count);
    const PlotField field = find_plots(points_over(few), 0.02, {}, 2);
    ASSERT_EQ(field.plots.size(), count) << field.why_none;
    for (std::size_t i = 0; i < count; ++i)
      EXPECT_GT(intersection_over_union(few[i], field.plots[i].box), 0.9);
  }
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
    EXPECT_NE(find_plots(points_over(boxes), 0.02, {}, 2).why_none, "") << bushes;
  }
}

// 60 returns a square metre: most cells of the raster are empty.
TEST(FindPlots, FindsPlotsInFewReturns) {
  const std::vector<PlotBox> boxes = Trial{}.boxes();
  const std::vector<Eigen::Vector3f> all = points_over(boxes);
  std::vector<Eigen::Vector3f> few;
  for (std::size_t i = 0; i < all.size(); i += 12) few.push_back(all[i]);
  const PlotField field = find_plots(few, 0.02, {}, 2);
  EXPECT_EQ(field.why_none, "");
  EXPECT_EQ(field.plots.size(), boxes.size());
}

// A task of the raster gets none but points that are left out.
TEST(FindPlots, FindsPlotsBesideALargeRoof) {
  std::vector<Eigen::Vector3f> points;
  for (std::uint64_t i = 0; i < 140000; ++i) {
    RandomStream random(8, random_purpose("test/roof"), i);
    points.emplace_back(static_cast<float>(random.uniform(20, 35)),
                        static_cast<float>(random.uniform(-7, 7)),
                        static_cast<float>(4 + 0.02 * random.normal()));
  }
  EXPECT_NE(find_plots(points, 0.02, {}, 2).why_none, "");
  const std::vector<PlotBox> boxes = Trial{}.boxes();
  std::ranges::copy(points_over(boxes), std::back_inserter(points));
  EXPECT_EQ(find_plots(points, 0.02, {}, 2).plots.size(), boxes.size());
}

void expect_those(const std::vector<PlotBox>& boxes, const PlotField& field,
                  double least_iou = 0.9) {
  EXPECT_EQ(field.why_none, "");
  ASSERT_EQ(field.plots.size(), boxes.size());
  for (const FoundPlot& plot : field.plots) {
    EXPECT_TRUE(std::ranges::any_of(boxes, [&](const PlotBox& box) {
      return intersection_over_union(box, plot.box) > least_iou;
    }));
  }
}

// Two rows of three end 0.8 m early at the field's border, as grazed ones do: what stands there is
// no longer like the plots of the middle row, but nothing else either.
TEST(FindPlots, FindsPlotsOfOuterRowsThatAreShorter) {
  for (const double gap_m : {0.2, 0.3}) {
    std::vector<PlotBox> boxes = Trial{.gap_m = gap_m, .row_gap_m = 0.6, .width_m = 1.35}.boxes();
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      if (i / 6 == 1) continue;
      boxes[i].length_m -= 0.8;
      boxes[i].center += (i / 6 == 0 ? 0.4 : -0.4) * boxes[i].length_axis();
    }
    SCOPED_TRACE(gap_m);
    expect_those(boxes, find_plots(points_over(boxes), 0.02, {}, 2), 0.75);
  }
}

// A hedge of 1.8 m along one side of the field, and trees of 5 m in two corners: most of the
// volume, if not of the area.
TEST(FindPlots, FindsPlotsBesideTreesAndHedges) {
  const std::vector<PlotBox> boxes = Trial{}.boxes();
  std::vector<Eigen::Vector3f> points = points_over(boxes);
  std::uint64_t index = 0;
  for (Eigen::Vector3f& point : points) {
    RandomStream random(8, random_purpose("test/hedge"), index++);
    const float from_tree = std::min((point.head<2>() - Eigen::Vector2f(9, 9)).norm(),
                                     (point.head<2>() + Eigen::Vector2f(9, 9)).norm());
    if (from_tree < 2.4F) point.z() = static_cast<float>(random.uniform(1, 5));
    if (point.y() < -10.6F) point.z() = static_cast<float>(random.uniform(0.6, 1.8));
  }
  expect_those(boxes, find_plots(points, 0.02, {}, 2));
}

// A row of straw as high as the crop, at several distances from the field: as wide as the plots, so
// that it could be a row of them.
TEST(FindPlots, FindsPlotsBesideAWindrow) {
  const std::vector<PlotBox> boxes = Trial{}.boxes();
  const std::vector<Eigen::Vector3f> alone = points_over(boxes);
  const PlotBox axes{.heading_rad = 33 * kDegrees};
  for (const double gap_m : {1.5, 2.0, 3.0}) {
    std::vector<Eigen::Vector3f> points = alone;
    std::uint64_t index = 0;
    for (Eigen::Vector3f& point : points) {
      RandomStream random(10, random_purpose("test/windrow"), index++);
      const Eigen::Vector2d at = axes.box_from_world(point.head<2>().cast<double>());
      if (at.x() > 6.8 + gap_m && at.x() < 8.4 + gap_m && std::abs(at.y()) < 5.5)
        point.z() = static_cast<float>(random.uniform(0.3, 0.8));
    }
    SCOPED_TRACE(gap_m);
    expect_those(boxes, find_plots(points, 0.02, {}, 2));
  }
}

// The same crop without plots, 24 x 12 m, beyond an alley of 1.3 m: more of it than in the plots.
TEST(FindPlots, FindsPlotsBesideACropWithoutPlots) {
  const std::vector<PlotBox> boxes = Trial{}.boxes();
  std::vector<Eigen::Vector3f> points = points_over(boxes);
  for (std::uint64_t i = 0; i < 200000; ++i) {
    RandomStream random(9, random_purpose("test/bulk"), i);
    const double height_m = random.uniform() < 0.9 ? random.uniform(0.3, 0.8) : 0;
    points.emplace_back(static_cast<float>(random.uniform(-12, 12)),
                        static_cast<float>(random.uniform(-24, -10)),
                        static_cast<float>(height_m + 0.02 * random.normal()));
  }
  std::erase_if(points, [](const Eigen::Vector3f& point) {
    return point.y() < -10 && point.y() > -12 && point.z() < 0.2F;
  });
  expect_those(boxes, find_plots(points, 0.02, {}, 2));
}

TEST(FindPlots, SaysThatThereAreNoPoints) { EXPECT_NE(find_plots({}, 0.02, {}, 1).why_none, ""); }

TEST(FindPlots, IsTheSameForAnyNumberOfThreads) {
  const std::vector<Eigen::Vector3f> points = points_over(Trial{}.boxes());
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

}  // namespace
}  // namespace plotscan::plots
