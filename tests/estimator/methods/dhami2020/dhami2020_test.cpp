// SPDX-License-Identifier: Apache-2.0
#include "methods/dhami2020/dhami2020.h"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/angle.h"
#include "core/error.h"
#include "estimator/synthetic_farm.h"
#include "temporary_folder.h"

namespace plotscan::methods::dhami2020 {
namespace {

using plotscan::testing::message_of;
using ::testing::HasSubstr;
using testing::SyntheticFarm;

const estimate::PlotEstimate* at(const estimate::Estimate& estimate, const PlotBox& box) {
  const auto found = std::ranges::find_if(estimate.plots, [&](const estimate::PlotEstimate& plot) {
    return plot.box.contains(box.center);
  });
  return found == estimate.plots.end() ? nullptr : &*found;
}

double worst_overlap(const estimate::Estimate& estimate, const SyntheticFarm& farm) {
  double worst = 1;
  for (const PlotBox& box : farm.boxes()) {
    const estimate::PlotEstimate* plot = at(estimate, box);
    worst = std::min(worst, plot ? intersection_over_union(plot->box, box) : 0.0);
  }
  return worst;
}

// The largest error of a height over the farm's plots.
double worst_error_m(const estimate::Estimate& estimate, const SyntheticFarm& farm,
                     const char* height) {
  double worst = 0;
  const std::vector<PlotBox> boxes = farm.boxes();
  const std::vector<double> heights = farm.heights();
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const estimate::PlotEstimate* plot = at(estimate, boxes[i]);
    worst = std::max(worst, plot ? std::abs(plot->heights_m.at(height) - heights[i]) : 1e9);
  }
  return worst;
}

class Headings : public ::testing::TestWithParam<double> {};

TEST_P(Headings, FindsEveryPlotOfAFlatFarm) {
  SyntheticFarm farm;
  farm.heading_rad = GetParam() * kDegrees;
  const estimate::Estimate estimate = estimate_plots(farm.map(), {.plots = 30});
  EXPECT_EQ(estimate.plots.size(), 30u);
  EXPECT_GT(worst_overlap(estimate, farm), 0.8) << to_json(estimate.diagnostics).dump(1);
  EXPECT_LT(worst_error_m(estimate, farm, "raw-max"), 1e-4);
}

INSTANTIATE_TEST_SUITE_P(Dhami2020, Headings, ::testing::Values(0.0, 33.0, 70.0, 90.0, 179.0));

TEST(Dhami2020, MeasuresKnownHeightsInGivenBoxes) {
  SyntheticFarm farm;
  farm.heading_rad = 0.4;
  const estimate::Estimate estimate = estimate_plots(farm.map(), {.boxes = farm.boxes()});
  ASSERT_EQ(estimate.plots.size(), 30u);
  // Noise-free: the highest point is the canopy's height, to float32. A voxel's centroid lies at
  // most its edge lower. A tenth of the points stands at the top, so that the 99th percentile does.
  EXPECT_LT(worst_error_m(estimate, farm, "raw-max"), 1e-5);
  EXPECT_LT(worst_error_m(estimate, farm, "raw-p99"), 1e-4);
  EXPECT_LT(worst_error_m(estimate, farm, "voxel-max"), 0.05);
  for (const estimate::PlotEstimate& plot : estimate.plots) {
    EXPECT_LE(plot.heights_m.at("voxel-max"), plot.heights_m.at("raw-max") + 1e-6);
    EXPECT_LE(plot.heights_m.at("raw-p99"), plot.heights_m.at("raw-max"));
    EXPECT_GT(plot.points, 2400u);
  }
}

TEST(Dhami2020, MeasuresPerpendicularToTiltedGround) {
  SyntheticFarm farm;
  farm.slope = {0.15, -0.08};
  const estimate::Estimate estimate = estimate_plots(farm.map(), {.plots = 30});
  EXPECT_EQ(estimate.plots.size(), 30u);
  EXPECT_GT(worst_overlap(estimate, farm), 0.75);  // the canopies lean over their boxes' edges
  const estimate::Estimate given = estimate_plots(farm.map(), {.boxes = farm.boxes()});
  EXPECT_LT(worst_error_m(given, farm, "raw-max"), 1e-3);
}

TEST(Dhami2020, TellsTheClustersAndThePlotsPlanes) {
  SyntheticFarm farm;
  farm.slope = {0.15, -0.08};
  farm.offset = {500000, 5000000, 600};
  const estimate::Estimate estimate = estimate_plots(farm.map(), {.plots = 30});
  ASSERT_EQ(estimate.clusters.size(), 30U);
  for (const PlotBox& box : farm.boxes()) {
    const auto nearest = std::ranges::min(estimate.clusters, {}, [&](const PlotBox& cluster) {
      return (cluster.center - box.center).norm();
    });
    EXPECT_LT((nearest.center - box.center).norm(), 0.3);
  }
  for (const estimate::PlotEstimate& plot : estimate.plots) {
    ASSERT_TRUE(plot.ground);
    EXPECT_NEAR(plot.ground->slope.x(), 0.15, 1e-3);
    EXPECT_NEAR(plot.ground->slope.y(), -0.08, 1e-3);
    const Eigen::Vector2d place = plot.box.center - farm.offset.head<2>();
    EXPECT_NEAR(plot.ground->z_m, 600 + farm.ground_z(place), 2e-3);
    EXPECT_EQ(plot.ground->tolerance_m, 0.05);
  }
  const estimate::Estimate given = estimate_plots(farm.map(), {.boxes = farm.boxes()});
  EXPECT_TRUE(given.clusters.empty());
  EXPECT_TRUE(given.plots.front().ground);
}

TEST(Dhami2020, GivesTheSameHeightsInMapGridCoordinates) {
  SyntheticFarm farm;
  const estimate::Estimate near = estimate_plots(farm.map(), {.plots = 30});
  farm.offset = {500000, 5000000, 600};
  const estimate::Estimate far = estimate_plots(farm.map(), {.plots = 30});
  ASSERT_EQ(near.plots.size(), far.plots.size());
  for (std::size_t i = 0; i < near.plots.size(); ++i) {
    const Eigen::Vector2d moved = far.plots[i].box.center - near.plots[i].box.center;
    EXPECT_LT((moved - farm.offset.head<2>()).norm(), 0.01);
    for (const auto& [name, height_m] : near.plots[i].heights_m)
      EXPECT_NEAR(far.plots[i].heights_m.at(name), height_m, 1e-3) << name;
  }
}

TEST(Dhami2020, CarriesALearntGridOverTheWholeField) {
  SyntheticFarm farm;
  farm.rows = 4;
  farm.columns = 15;
  const PlotBox low = farm.box(0, 0);  // the learn box holds a corner of 2 x 4 plots
  const PlotBox high = farm.box(1, 3);
  const cloud::Area learn{low.center.x() - 2.7, low.center.y() - 1.2, high.center.x() + 2.7,
                          high.center.y() + 1.2};
  const estimate::Estimate estimate = estimate_plots(farm.map(), {.plots = 8, .learn_box = learn});
  EXPECT_EQ(estimate.plots.size(), 60u);
  EXPECT_GT(worst_overlap(estimate, farm), 0.8) << to_json(estimate.diagnostics).dump(1);
}

TEST(Dhami2020, LearnsNoGridFromOneLineOfPlots) {
  SyntheticFarm farm;
  const PlotBox low = farm.box(0, 0);
  const PlotBox high = farm.box(0, 3);
  const cloud::Area learn{low.center.x() - 2.7, low.center.y() - 1.2, high.center.x() + 2.7,
                          high.center.y() + 1.2};
  EXPECT_THAT(
      message_of<InputError>([&] { estimate_plots(farm.map(), {.plots = 4, .learn_box = learn}); }),
      HasSubstr("2 x 2 plots"));
  EXPECT_THAT(message_of<InputError>([&] {
                estimate_plots(
                    farm.map(),
                    {.plots = 4, .crop_box = cloud::Area{-1, -1, 1, 1}, .learn_box = learn});
              }),
              HasSubstr("out of the crop box"));
}

TEST(Dhami2020, SearchesTheCropBoxOnly) {
  SyntheticFarm farm;
  const cloud::Area crop{-8.2, -100, 2.7, 100};  // two of the three rows
  const estimate::Estimate estimate = estimate_plots(farm.map(), {.plots = 20, .crop_box = crop});
  EXPECT_EQ(estimate.plots.size(), 20u);
  for (const estimate::PlotEstimate& plot : estimate.plots) EXPECT_LT(plot.box.center.x(), 2.7);
}

TEST(Dhami2020, LeavesMissingPlotsOut) {
  SyntheticFarm farm;
  std::vector<Eigen::Vector3d> points = farm.points();
  const PlotBox gone = farm.box(1, 4);
  std::erase_if(points, [&](const Eigen::Vector3d& point) {
    return gone.contains(point.head<2>()) && point.z() > 0;
  });
  cloud::CloudMap map(farm.area());
  map.add(points);
  const estimate::Estimate estimate = estimate_plots(map, {.plots = 29});
  EXPECT_EQ(estimate.plots.size(), 29u);
  EXPECT_EQ(at(estimate, gone), nullptr);
}

TEST(Dhami2020, GivesTheSameForAnyNumberOfThreads) {
  const SyntheticFarm farm;
  const estimate::Estimate one = estimate_plots(farm.map(), {.plots = 30, .threads = 1});
  for (const int threads : {2, 7}) {
    const estimate::Estimate many = estimate_plots(farm.map(), {.plots = 30, .threads = threads});
    ASSERT_EQ(many.plots.size(), one.plots.size());
    EXPECT_EQ(to_json(many.diagnostics), to_json(one.diagnostics));
    for (std::size_t i = 0; i < one.plots.size(); ++i) {
      EXPECT_EQ(many.plots[i].box.center, one.plots[i].box.center);
      EXPECT_EQ(many.plots[i].heights_m, one.plots[i].heights_m);
    }
  }
}

TEST(Dhami2020, SaysHowEachStepWent) {
  const SyntheticFarm farm;
  const auto diagnostics = to_json(estimate_plots(farm.map(), {.plots = 30}).diagnostics);
  EXPECT_EQ(diagnostics["votes"]["clusters"], 30);
  EXPECT_GE(diagnostics["votes"]["width"], 15);
  EXPECT_GE(diagnostics["votes"]["length"], 15);
  EXPECT_GE(diagnostics["votes"]["heading"], 15);
  EXPECT_NEAR(diagnostics["grid"]["column_step_m"], 2.5, 0.02);
  EXPECT_NEAR(diagnostics["grid"]["row_step_m"], 5.5, 0.05);
  EXPECT_NEAR(diagnostics["ground_level"]["z_m"], 0, 0.01);
  EXPECT_GT(diagnostics["canopy_share"], 0.3);
}

TEST(Dhami2020, MeasuresNothingInABoxOutsideOfTheCloud) {
  const SyntheticFarm farm;
  PlotBox outside = farm.box(0, 0);
  outside.center.x() += 500;
  const estimate::Estimate estimate =
      estimate_plots(farm.map(), {.boxes = {farm.box(0, 0), outside}});
  EXPECT_EQ(estimate.plots[0].heights_m.size(), 3u);
  EXPECT_TRUE(estimate.plots[1].heights_m.empty());
  EXPECT_EQ(estimate.plots[1].points, 0u);
}

TEST(Dhami2020, RefusesBadOptions) {
  const SyntheticFarm farm{.rows = 1, .columns = 2};
  const cloud::CloudMap map = farm.map();
  const auto message = [&](const Options& options) {
    return message_of<InputError>([&] { estimate_plots(map, options); });
  };
  EXPECT_THAT(message({.plots = 0}),
              HasSubstr("number of plots is not given, or 0; it is 1 to 100000, unless"));
  EXPECT_THAT(message({.plots = -1}), HasSubstr("number of plots is -1; it is 1 to 100000"));
  EXPECT_THAT(message({.plots = 100001}), HasSubstr("number of plots"));
  EXPECT_THAT(message({.plots = 2, .voxel_m = 0}), HasSubstr("voxel_m 0 must be in [0.005, 1]"));
  EXPECT_THAT(message({.plots = 2, .min_height_m = -1}), HasSubstr("min_height_m -1"));
  EXPECT_THAT(message({.plots = 2, .extend_m = -1}), HasSubstr("extend_m"));
  EXPECT_THAT(message({.plots = 2, .plane_tolerance_m = std::nan("")}),
              HasSubstr("plane_tolerance_m nan"));
  EXPECT_THAT(message({.plots = 2, .crop_box = cloud::Area{3, 0, 1, 1}}), HasSubstr("crop box"));
  EXPECT_THAT(message({.plots = 2, .learn_box = cloud::Area{500, 500, 501, 501}}),
              HasSubstr("only 0"));
  EXPECT_THAT(message({.plots = 100000}), HasSubstr("too few for 100000 plots"));
  EXPECT_THAT(message({.learn_box = cloud::Area{0, 0, 1, 1}, .boxes = farm.boxes()}),
              HasSubstr("exclude each other"));
}

}  // namespace
}  // namespace plotscan::methods::dhami2020
