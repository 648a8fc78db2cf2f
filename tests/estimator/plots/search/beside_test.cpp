// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include <gtest/gtest.h>

#include "core/angle.h"
#include "core/random.h"
#include "estimator/plots/trial_cloud.h"
#include "plots/search/find_trials.h"

// What stands beside the plots of a field.
namespace plotscan::plots {
namespace {

const Hints kSides{.width_m = 1.5, .length_m = 4};  // of Trial's plots

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
    expect_those(boxes, find_plots(cloud_over(boxes), 0.02, {}, 2), 0.75);
  }
}

// A trial of 3 x 6 plots and strips of 4 m of the same crop along two of its sides, a metre from
// it.
std::vector<PlotBox> between_guards(const Trial& trial) {
  std::vector<PlotBox> boxes = trial.boxes();
  for (const double side : {-1, 1}) {
    PlotBox guard{.width_m = 4, .length_m = 13.6, .heading_rad = trial.heading_rad};
    guard.center = side * (5.5 + 1 + 2) * guard.width_axis();
    boxes.push_back(guard);
  }
  return boxes;
}

TEST(FindPlots, FindsPlotsBetweenGuardStrips) {
  const Trial trial;
  const std::vector<Eigen::Vector3f> points = cloud_over(between_guards(trial));
  const PlotField field = find_plots(points, 0.02, {}, 2);
  expect_those(trial.boxes(), field);
  ASSERT_TRUE(field.signs.has_value());
  EXPECT_LT(field.signs->held_share, 0.6);
  EXPECT_LE(field.plots.front().confidence, 0.5);
  for (const Hints& hints :
       {Hints{.rows = 3, .columns = 6}, Hints{.columns = 6}, Hints{.plots = 18},
        Hints{.width_m = 1.5, .length_m = 4}, Hints{.width_m = 1.5, .rows = 3, .columns = 6}})
    expect_those(trial.boxes(), find_plots(points, 0.02, hints, 2));
}

// A guard plot of 0.9 m at both ends of each row: the numbers are those of the others.
TEST(FindPlots, NumbersTellPlotsFromGuardPlots) {
  const Trial trial;
  std::vector<PlotBox> boxes = trial.boxes();
  for (const std::size_t i : {0, 5, 6, 11, 12, 17}) {
    PlotBox guard = boxes[i];
    guard.width_m = 0.9;
    guard.center += (i % 6 == 0 ? -1 : 1) * (0.75 + trial.gap_m + 0.45) * guard.width_axis();
    boxes.push_back(guard);
  }
  const std::vector<Eigen::Vector3f> points = cloud_over(boxes);
  expect_those(trial.boxes(), find_plots(points, 0.02, {.rows = 3, .columns = 6}, 2));
}

// Numbers that the field does not have: refused, or found with what speaks against them.
TEST(FindPlots, FindsNoOtherNumbersThanThoseTold) {
  const std::vector<Eigen::Vector3f> points = cloud_over(Trial{}.boxes());
  for (const int told : {2, 4, 5, 7}) {
    for (const bool are_rows : {true, false}) {
      const Hints hints = are_rows ? Hints{.rows = told} : Hints{.columns = told};
      const PlotField field = find_plots(points, 0.02, hints, 2);
      if (!field.why_none.empty()) continue;
      const TrialLayout& layout = field.fit->layout;
      EXPECT_EQ(are_rows ? layout.rows() : layout.columns(), told);
      EXPECT_NE(field.rival + field.doubt, "")
          << layout.rows() << " rows of " << layout.columns() << " plots of " << layout.width_m
          << " x " << layout.length_m << " m";
    }
  }
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
  std::ranges::copy(cloud_over(boxes), std::back_inserter(points));
  EXPECT_EQ(find_plots(points, 0.02, {}, 2).plots.size(), boxes.size());
}

// A hedge of 1.8 m along one side of the field, and trees of 5 m in two corners: most of the
// volume, if not of the area.
TEST(FindPlots, FindsPlotsBesideTreesAndHedges) {
  const std::vector<PlotBox> boxes = Trial{}.boxes();
  std::vector<Eigen::Vector3f> points = cloud_over(boxes);
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
  const std::vector<Eigen::Vector3f> alone = cloud_over(boxes);
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
  std::vector<Eigen::Vector3f> points = cloud_over(boxes);
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
  for (const Hints& hints : {Hints{}, kSides, Hints{.width_m = 1.5}}) {
    const PlotField field = find_plots(points, 0.02, hints, 2);
    expect_those(boxes, field);
    EXPECT_NEAR(field.others_m2, 24 * 14, 24);
  }
}

// In the middle of 40 x 40 m of the same crop, a path around. Blocks of a metre lie along x and y:
// of a turned trial those that hold a part of the outer plots hold a part of the crop too.
TEST(FindPlots, FindsPlotsInTheMiddleOfACrop) {
  for (const double heading_deg : {0, 16}) {
    const Trial trial{.heading_rad = heading_deg * kDegrees};
    const PlotBox clearing{.width_m = 13, .length_m = 16, .heading_rad = trial.heading_rad};
    std::vector<Eigen::Vector3f> points = cloud_over(trial.boxes());
    std::erase_if(points, [&](const Eigen::Vector3f& point) {
      return !clearing.contains(point.head<2>().cast<double>());
    });
    for (std::uint64_t i = 0; i < 900000; ++i) {
      RandomStream random(9, random_purpose("test/bulk"), i);
      const Eigen::Vector2d place(random.uniform(-20, 20), random.uniform(-20, 20));
      if (clearing.contains(place)) continue;
      const double height_m = random.uniform() < 0.95 ? random.uniform(0.5, 0.8) : 0;
      points.emplace_back(place.cast<float>().x(), place.cast<float>().y(),
                          static_cast<float>(height_m + 0.02 * random.normal()));
    }
    SCOPED_TRACE(heading_deg);
    for (const Hints& hints :
         {Hints{}, Hints{.rows = 3, .columns = 6}, kSides, Hints{.width_m = 1.5}})
      expect_those(trial.boxes(), find_plots(points, 0.02, hints, 2));
  }
}

// Plots of rows that touch, beyond an alley the one column that shows by itself: the rest is as
// closed as a crop without plots, and as high.
TEST(FindPlots, FindsTouchingPlotsOfAToldWidthBesideAColumnAlone) {
  std::vector<PlotBox> boxes = Trial{
      .rows = 5,
      .gap_m = 0,
      .row_gap_m = 0.25,
      .heading_rad = 0,
      .offsets_m = {0, 0, 0, 0, 0}}.boxes();
  for (std::size_t i = 0; i < boxes.size(); i += 6) boxes[i].center -= 2.5 * boxes[i].width_axis();
  const std::vector<Eigen::Vector3f> points = cloud_over(boxes, everywhere, 20, 20);
  for (const Hints& hints : {kSides, Hints{.width_m = 1.5}})
    expect_those(boxes, find_plots(points, 0.02, hints, 2));
}

// Plots of two or three rows whose leaves cover a third of the ground, and that run on at one
// spacing from plot to plot: little tells a plot from one level, but the same rows show in all.
TEST(FindPlots, FindsTouchingPlotsOfFewRows) {
  struct Rows {
    int count;
    double spacing_m, leaves_m;
  };
  for (const Rows rows : {Rows{2, 0.75, 0.2}, Rows{2, 0.5, 0.2}, Rows{3, 0.38, 0.15}}) {
    const double width_m = rows.count * rows.spacing_m;
    const std::vector<PlotBox> boxes =
        Trial{.columns = 8, .gap_m = 0, .row_gap_m = 0.6, .width_m = width_m}.boxes();
    const auto in_rows = [&](const PlotBox&, const Eigen::Vector2d& from_center) {
      const double from_side_m = from_center.y() + width_m / 2;
      const double from_row_m = std::remainder(from_side_m - rows.spacing_m / 2, rows.spacing_m);
      return std::abs(from_row_m) < rows.leaves_m / 2;
    };
    const std::vector<Eigen::Vector3f> points = cloud_over(boxes, in_rows, 14, 14);
    for (const Hints& hints : {Hints{.width_m = width_m}, Hints{.width_m = width_m, .length_m = 4},
                               Hints{.width_m = width_m, .rows = 3, .columns = 8}}) {
      SCOPED_TRACE(rows.spacing_m);
      const PlotField field = find_plots(points, 0.02, hints, 2);
      expect_those(boxes, field, 0.8);
      EXPECT_EQ(field.doubt, "");
    }
  }
}

// Plots of every height that touch, in rows with offsets of their own: the lowest has a fifth of
// the height of the tallest, and is thin. Leaves hang over what is beside a tall one, and over the
// place of a plot that is missing.
TEST(FindPlots, FindsDwarfsThatTouchGiants) {
  const Trial trial{
      .columns = 8, .gap_m = 0, .row_gap_m = 0.6, .offsets_m = {0, 0.6, -0.5}, .missing = 11};
  const std::vector<PlotBox> boxes = trial.boxes();
  std::vector<Eigen::Vector3f> points = cloud_over({}, everywhere, 14, 14);
  for (std::size_t rank = 0; rank < boxes.size(); ++rank) {  // the tallest hang over all others
    PlotBox box = boxes[7 * rank % boxes.size()];
    const double tall = static_cast<double>(rank + 1) / static_cast<double>(boxes.size());
    box.width_m += 0.4 * tall;
    box.length_m += 0.4 * tall;
    for (std::size_t i = 0; i < points.size(); ++i) {
      RandomStream random(13, random_purpose("test/leaves"), i);
      if (box.contains(points[i].head<2>().cast<double>()) && random.uniform() < 0.4 + 0.4 * tall)
        points[i].z() = static_cast<float>((0.2 + 0.8 * tall) * random.uniform(0.6, 1));
    }
  }
  for (const Hints& hints : {kSides, Hints{.width_m = 1.5}})
    expect_those(boxes, find_plots(points, 0.02, hints, 2), 0.85);
}

// Plots with narrow gaps, 0.2 m beside the same crop without plots: on squares of a metre the crop
// goes on through them.
TEST(FindPlots, FindsPlotsWithNarrowGapsBesideACropWithoutPlots) {
  const std::vector<PlotBox> boxes = Trial{.gap_m = 0.3, .row_gap_m = 0.5}.boxes();
  double edge_m = 0;
  for (const PlotBox& box : boxes)
    for (const Eigen::Vector2d& corner : box.corners()) edge_m = std::min(edge_m, corner.y() - 0.2);
  std::vector<Eigen::Vector3f> points = cloud_over(boxes);
  std::uint64_t index = 0;
  for (Eigen::Vector3f& point : points) {
    RandomStream random(11, random_purpose("test/bulk"), index++);
    if (point.y() < edge_m && random.uniform() < 0.75)
      point.z() = static_cast<float>(random.uniform(0.3, 0.8));
  }
  for (const Hints& hints : {Hints{}, kSides})
    expect_those(boxes, find_plots(points, 0.02, hints, 2));
}

}  // namespace
}  // namespace plotscan::plots
