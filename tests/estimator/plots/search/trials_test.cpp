// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "core/angle.h"
#include "core/random.h"
#include "estimator/plots/trial_cloud.h"
#include "plots/search/find_trials.h"
#include "plots/search/internal/trial_area.h"
#include "plots/search/internal/trials_beside.h"

// Several trials on one field.
namespace plotscan::plots {
namespace {

constexpr double kHeading_rad = 20 * kDegrees;

// A grid of plots about a centre, both in the frame of the heading.
std::vector<PlotBox> grid(int rows, int columns, const PlotBox& plot, const Eigen::Vector2d& gaps,
                          const Eigen::Vector2d& center) {
  std::vector<PlotBox> boxes;
  const PlotBox axes{.heading_rad = kHeading_rad};
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const double along = (row - 0.5 * (rows - 1)) * (plot.length_m + gaps.x()) + center.x();
      const double across = (column - 0.5 * (columns - 1)) * (plot.width_m + gaps.y()) + center.y();
      boxes.push_back(plot);
      boxes.back().center = along * axes.length_axis() + across * axes.width_axis();
      boxes.back().heading_rad = kHeading_rad;
    }
  }
  return boxes;
}

// 14 plots, and 2 m beside them 30 smaller ones at other steps.
std::vector<PlotBox> large_plots() {
  return grid(2, 7, {.width_m = 1.5, .length_m = 4}, {0.8, 0.5}, {-4.7, 0});
}
std::vector<PlotBox> small_plots() {
  return grid(3, 10, {.width_m = 0.9, .length_m = 2}, {0.7, 0.4}, {5.4, 0});
}

std::vector<PlotBox> both() {
  std::vector<PlotBox> boxes = large_plots();
  const std::vector<PlotBox> more = small_plots();
  boxes.insert(boxes.end(), more.begin(), more.end());
  return boxes;
}

// Scales what stands in the boxes.
void grow(std::vector<Eigen::Vector3f>& points, const std::vector<PlotBox>& boxes, float factor) {
  for (Eigen::Vector3f& point : points) {
    const Eigen::Vector2d place = point.head<2>().cast<double>();
    if (point.z() > 0.1F &&
        std::ranges::any_of(boxes, [&](const PlotBox& box) { return box.contains(place); }))
      point.z() *= factor;
  }
}

// Each trial with its own plots, from the south-west on.
void expect_both(const std::vector<PlotField>& trials) {
  ASSERT_EQ(trials.size(), 2u);
  expect_those(large_plots(), trials[0], 0.85);
  expect_those(small_plots(), trials[1], 0.85);
  EXPECT_NEAR(trials[0].fit->layout.length_m, 4, 0.1);
  EXPECT_NEAR(trials[1].fit->layout.length_m, 2, 0.1);
  EXPECT_EQ(trials[0].fit->layout.columns(), 7);
  EXPECT_EQ(trials[1].fit->layout.columns(), 10);
}

TEST(FindTrials, FindsTwoTrialsOfPlotsOfTwoSizes) {
  expect_both(find_trials(cloud_over(both()), 0.02, {}, 2));
}

TEST(FindTrials, FindsATrialThatIsThreeTimesAsTallAsTheOther) {
  std::vector<Eigen::Vector3f> points = cloud_over(both());
  grow(points, small_plots(), 3);
  expect_both(find_trials(points, 0.02, {}, 2));
}

// Of what stands on the field, weighed by its height, the low trial is next to nothing.
TEST(FindTrials, FindsALowTrialBesideATallOne) {
  std::vector<Eigen::Vector3f> points = cloud_over(both());
  const std::vector<PlotBox> tall = small_plots();
  for (Eigen::Vector3f& point : points) {
    const Eigen::Vector2d place = point.head<2>().cast<double>();
    const bool is_tall =
        std::ranges::any_of(tall, [&](const PlotBox& box) { return box.contains(place); });
    if (is_tall || point.z() > 0.1F) point.z() *= is_tall ? 3.5F : 0.5F;
  }
  expect_both(find_trials(points, 0.02, {}, 2));
}

// One lattice may explain both.
TEST(FindTrials, TellsTrialsOfNearlyEqualStepsApart) {
  const std::vector<PlotBox> wide =
      grid(2, 5, {.width_m = 1.8, .length_m = 4}, {0.9, 1.4}, {-4.9, 0});
  const std::vector<PlotBox> narrow =
      grid(2, 6, {.width_m = 1.5, .length_m = 3.6}, {0.9, 1.4}, {5.6, 0.8});
  std::vector<PlotBox> boxes = wide;
  boxes.insert(boxes.end(), narrow.begin(), narrow.end());
  const std::vector<PlotField> trials = find_trials(cloud_over(boxes), 0.02, {}, 2);
  ASSERT_EQ(trials.size(), 2u);
  expect_those(wide, trials[0], 0.85);
  expect_those(narrow, trials[1], 0.85);
}

// Plots of one length in lines that one lattice may explain, with gaps across some of its boxes.
TEST(FindTrials, TellsThreeCropsSideBySideApart) {
  const std::vector<PlotBox> wheat =
      grid(2, 8, {.width_m = 1.5, .length_m = 6}, {1.4, 0.4}, {-7, -6.5});
  const std::vector<PlotBox> soybean =
      grid(2, 5, {.width_m = 2.4, .length_m = 6}, {1.4, 0.5}, {-7, 9.5});
  const std::vector<PlotBox> canola =
      grid(2, 8, {.width_m = 1.8, .length_m = 6}, {1.5, 0.6}, {10, 0});
  std::vector<PlotBox> boxes = wheat;
  boxes.insert(boxes.end(), soybean.begin(), soybean.end());
  boxes.insert(boxes.end(), canola.begin(), canola.end());
  const auto sown = [](const PlotBox& box, const Eigen::Vector2d& from_center) {
    return box.width_m < 2 || std::abs(std::remainder(from_center.y(), 0.48)) < 0.16;
  };
  std::vector<Eigen::Vector3f> points = cloud_over(boxes, sown, 24, 23);
  grow(points, canola, 1.6F);
  grow(points, soybean, 0.75F);
  const std::vector<PlotField> trials = find_trials(points, 0.02, {}, 2);
  ASSERT_EQ(trials.size(), 3u);
  expect_those(wheat, trials[0]);
  expect_those(soybean, trials[1]);
  expect_those(canola, trials[2]);
}

// A hedge 4 m beside the trial, as tall as the crop, with places every 2.5 m that are a little
// thinner: no second trial of one column.
TEST(FindTrials, TakesNoHedgeWithThinPlacesForPlots) {
  const std::vector<PlotBox> plots =
      grid(3, 6, {.width_m = 1.5, .length_m = 4}, {0.8, 0.4}, {-3, 0});
  std::vector<PlotBox> boxes = plots;
  boxes.push_back(grid(1, 1, {.width_m = 15, .length_m = 1.6}, {}, {9, 0}).front());
  const auto sown = [](const PlotBox& box, const Eigen::Vector2d& from_center) {
    const bool thin = box.width_m > 10 && std::abs(std::remainder(from_center.y(), 2.5)) < 0.25;
    return !thin || std::abs(std::remainder(from_center.x(), 0.2)) < 0.07;
  };
  const std::vector<PlotField> trials = find_trials(cloud_over(boxes, sown, 16, 14), 0.02, {}, 2);
  ASSERT_EQ(trials.size(), 1u);
  expect_those(plots, trials.front());
}

// Rectangles that are hardly better than ellipses, as pieces of bushes are.
void make_unclear(Look& look) {
  if (look.field.signs) look.field.signs->squareness = look.field.signs->straightness = 0.95;
}

TEST(TrialsBeside, AreSoughtOnlyWhereALookShowsOneClearly) {
  const std::vector<Eigen::Vector3f> points = cloud_over(both());
  const FieldBlocks blocks(points, 0.02, 2);
  const Hints hints;
  const GroundError ground_error;
  const ScannedField field{points, blocks, 0.02, hints, 2, ground_error};
  Looks looks = look_in_all_ways(field);
  EXPECT_EQ(trials_beside(field, looks).size(), 2u);
  make_unclear(looks.best);
  for (Look& look : looks.at_all) make_unclear(look);
  EXPECT_TRUE(trials_beside(field, looks).empty());
}

TEST(FindTrials, GivesTheSameForAnyOrderOfThePoints) {
  std::vector<Eigen::Vector3f> points = cloud_over(both());
  const std::vector<PlotField> before = find_trials(points, 0.02, {}, 2);
  std::ranges::reverse(points);
  const std::vector<PlotField> after = find_trials(points, 0.02, {}, 2);
  ASSERT_EQ(before.size(), after.size());
  for (std::size_t i = 0; i < before.size(); ++i)
    for (std::size_t j = 0; j < before[i].plots.size(); ++j)
      EXPECT_LT((before[i].plots[j].box.center - after[i].plots[j].box.center).norm(), 1e-9);
}

TEST(FindTrials, GivesTheSameForAnyNumberOfThreads) {
  const std::vector<Eigen::Vector3f> points = cloud_over(both());
  const std::vector<PlotField> one = find_trials(points, 0.02, {}, 1);
  const std::vector<PlotField> seven = find_trials(points, 0.02, {}, 7);
  ASSERT_EQ(one.size(), seven.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    ASSERT_EQ(one[i].plots.size(), seven[i].plots.size());
    for (std::size_t j = 0; j < one[i].plots.size(); ++j)
      EXPECT_EQ(one[i].plots[j].box.center, seven[i].plots[j].box.center);
  }
}

TEST(FindTrials, SaysOnceWhyThereAreNone) {
  const std::vector<PlotField> trials = find_trials(cloud_over({}), 0.02, {}, 2);
  ASSERT_EQ(trials.size(), 1u);
  EXPECT_NE(trials.front().why_none, "");
}

// What the user tells of plots is told of all of them.
TEST(FindTrials, TakesToldPlotsAsOneTrial) {
  const Hints hints{.rows = 2, .columns = 7};
  EXPECT_EQ(find_trials(cloud_over(both()), 0.02, hints, 2).size(), 1u);
}

TEST(TrialArea, LeavesOutWhatLiesInTheBoxes) {
  const std::vector<PlotBox> boxes = large_plots();
  std::vector<Eigen::Vector3f> points;
  for (std::uint64_t i = 0; i < 20000; ++i) {
    RandomStream random(3, random_purpose("test/area"), i);
    points.emplace_back(static_cast<float>(random.uniform(-12, 12)),
                        static_cast<float>(random.uniform(-12, 12)), 0.5F);
  }
  points.emplace_back(NAN, 0.0F, 0.0F);
  const std::vector<Eigen::Vector3f> outside = points_outside(points, boxes);
  const auto lies_in = [&](const Eigen::Vector3f& point, double wider_m) {
    return std::ranges::any_of(boxes, [&](PlotBox box) {
      box.width_m += wider_m;
      box.length_m += wider_m;
      return box.contains(point.head<2>().cast<double>());
    });
  };
  const auto clearly_outside = [&](const auto& point) { return !lies_in(point, 0.2); };
  const auto clearly_inside = [&](const auto& point) { return lies_in(point, -0.2); };
  EXPECT_TRUE(std::ranges::none_of(outside, clearly_inside));
  points.pop_back();
  EXPECT_EQ(std::ranges::count_if(outside, clearly_outside),
            std::ranges::count_if(points, clearly_outside));
}

// Outer rows of shorter plots are no trial that lies about another.
TEST(FindTrials, TakesRowsAboutATrialAsItsOwn) {
  std::vector<PlotBox> boxes = Trial{.rows = 4, .offsets_m = {0, 0, 0, 0}}.boxes();
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    boxes[i].center -= 2.4 * boxes[i].length_axis();
    if (i >= 6 && i < 18) continue;
    boxes[i].length_m -= 1;
    boxes[i].center += (i < 6 ? 0.5 : -0.5) * boxes[i].length_axis();
  }
  EXPECT_EQ(find_trials(cloud_over(boxes), 0.02, {}, 2).size(), 1u);
}

TEST(TrialArea, HasAnOutlineAboutAllPlots) {
  const std::vector<PlotBox> boxes = large_plots();
  TrialLayout layout{.width_m = 1.5, .length_m = 4};
  const PlotBox axes{.heading_rad = kHeading_rad};
  layout.row_axis = -axes.width_axis();
  layout.column_axis = axes.length_axis();
  for (const PlotBox& box : boxes)
    layout.places.push_back(
        {.position_m = {-box.center.dot(axes.width_axis()), box.center.dot(axes.length_axis())}});
  const PlotBox outline = outline_of(layout);
  EXPECT_NEAR(outline.length_m, 2 * 4 + 0.8, 1e-9);
  EXPECT_NEAR(outline.width_m, 7 * 1.5 + 6 * 0.5, 1e-9);
  EXPECT_TRUE(outline.center.isApprox(-4.7 * axes.length_axis(), 1e-9));
}

TEST(TrialArea, TakesTheGapsBetweenThePlots) {
  TrialLayout layout{.width_m = 1.5, .length_m = 4, .column_pitch_m = 2, .row_pitch_m = 4.8};
  layout.places = {{.row = 1, .column = 1, .position_m = {0, 0}}};
  EXPECT_NEAR(area_of(layout).front().width_m, 2, 1e-12);
  EXPECT_NEAR(area_of(layout).front().length_m, 4.8, 1e-12);
  layout.row_pitch_m = 0;  // one row only
  EXPECT_NEAR(area_of(layout).front().length_m, 4.5, 1e-12);
}

// Vine rows, 1.85 m apart, of vines from -half_m to half_m but for 1 m from gaps_m on.
std::vector<PlotBox> vine_rows(double half_m, const std::vector<double>& gaps_m) {
  const PlotBox axes{.heading_rad = kHeading_rad};
  std::vector<PlotBox> boxes;
  double across_m = -9.25 + 1.85 / 2;
  const auto add = [&](double from_m, double to_m) {
    if (to_m <= from_m) return;
    boxes.push_back(
        {.center = axes.length_axis() * (from_m + to_m) / 2 + axes.width_axis() * across_m,
         .width_m = 0.75,
         .length_m = to_m - from_m,
         .heading_rad = kHeading_rad});
  };
  for (const double gap_m : gaps_m) {
    add(-half_m, gap_m);
    add(gap_m + 1, half_m);
    across_m += 1.85;
  }
  return boxes;
}

void expect_none(const std::vector<PlotBox>& rows) {
  const std::vector<PlotField> fields = find_trials(cloud_over(rows), 0.02, {}, 2);
  ASSERT_EQ(fields.size(), 1u);
  EXPECT_EQ(fields[0].plots.size(), 0u);
  EXPECT_NE(fields[0].why_none, "");
}

// One row has a gap near its middle: either half of the rows is a row of plots, were the other a
// trial of its own.
TEST(FindTrials, LeavesRowsThatRunOnBe) {
  constexpr double kNone_m = 5.86;
  std::vector<double> gaps_m(10, kNone_m);
  gaps_m[4] = -0.18;
  expect_none(vine_rows(kNone_m, gaps_m));
}

// Here plots at offsets of each row's own were found, two at each place.
TEST(FindTrials, LeavesRowsWithGapsAnywhereBe) {
  constexpr double kNone_m = 6.533;
  std::vector<double> gaps_m(10, kNone_m);
  gaps_m[3] = 3.980336;
  gaps_m[4] = 4.566917;
  gaps_m[7] = -2.838467;
  expect_none(vine_rows(kNone_m, gaps_m));
}

}  // namespace
}  // namespace plotscan::plots
