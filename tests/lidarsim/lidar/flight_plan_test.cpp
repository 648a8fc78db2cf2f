// SPDX-License-Identifier: Apache-2.0
#include "lidar/flight_plan.h"

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "small_farm.h"
#include "temporary_folder.h"

namespace plotscan::lidar {
namespace {

using ::testing::HasSubstr;
using testing::message_of;

std::vector<Eigen::Vector3d> strips_over(const farm::Farm& farm,
                                         const flight::StripOptions& options) {
  return plan_strips(site_of(farm), Scene(scene_content(farm)), options);
}

// 3 rows of 5 plots on a grid turned by `heading_rad`, on flat ground at 2 m.
farm::Farm plots_on_a_grid(double heading_rad) {
  farm::Farm farm{.name = "grid",
                  .terrain = testing::flat_terrain(60, 2),
                  .models = {},
                  .plots = {},
                  .plants = {}};
  const Eigen::Rotation2Dd turn(heading_rad);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 5; ++column) {
      const Eigen::Vector2d center = turn * Eigen::Vector2d(6.0 * column - 9, 4.0 * row + 2);
      farm.plots.push_back({.id = static_cast<std::uint32_t>(farm.plots.size() + 1),
                            .row = row + 1,
                            .column = column + 1,
                            .box = {.center = center,
                                    .width_m = 1.5,
                                    .length_m = 4,
                                    // Both ways of saying the same box direction occur.
                                    .heading_rad = heading_rad + (column % 2) * std::numbers::pi},
                            .heights = {}});
    }
  }
  return farm;
}

double distance_to_segment(const Eigen::Vector2d& p, const Eigen::Vector2d& a,
                           const Eigen::Vector2d& b) {
  const double share = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (a + share * (b - a) - p).norm();
}

class StripsOver : public ::testing::TestWithParam<double> {};

TEST_P(StripsOver, CoverEveryPlot) {
  const farm::Farm farm = plots_on_a_grid(GetParam());
  // The field is 9.5 m wide.
  for (const auto& [spacing, strips] : {std::pair{0.95, 10U}, {3.3, 3U}, {4.75, 2U}, {50.0, 1U}}) {
    const auto path = strips_over(farm, {.altitude_m = 8, .spacing_m = spacing, .run_up_m = 1.5});
    ASSERT_EQ(path.size(), 2 * strips);
    for (const farm::Plot& plot : farm.plots) {
      for (const Eigen::Vector2d& corner : plot.box.corners()) {
        double nearest = 1e9;
        for (std::size_t i = 0; i < path.size(); i += 2) {
          nearest = std::min(nearest,
                             distance_to_segment(corner, path[i].head<2>(), path[i + 1].head<2>()));
        }
        ASSERT_LE(nearest, spacing / 2 + 1e-9);
      }
    }
  }
}

TEST_P(StripsOver, RunAlongTheLongerSideThereAndBack) {
  const farm::Farm farm = plots_on_a_grid(GetParam());
  const auto path = strips_over(farm, {.altitude_m = 8, .spacing_m = 3, .run_up_m = 1.5});
  ASSERT_EQ(path.size(), 8u);  // 9.5 m of plots across: 4 strips
  const Eigen::Vector2d along(std::cos(GetParam()), std::sin(GetParam()));
  for (std::size_t i = 0; i < path.size(); i += 2) {
    const Eigen::Vector2d strip = (path[i + 1] - path[i]).head<2>();
    EXPECT_NEAR(strip.norm(), 28 + 2 * 1.5, 1e-9);  // four pitches, a plot, the run-ups
    EXPECT_NEAR(std::abs(strip.normalized().dot(along)), 1, 1e-12);
    if (i > 0) {
      EXPECT_LT(strip.dot((path[i - 1] - path[i - 2]).head<2>()), 0);
      EXPECT_NEAR((path[i] - path[i - 1]).norm(), 3, 1e-9);
    }
    EXPECT_DOUBLE_EQ(path[i].z(), 10);  // 8 m over ground at 2 m
  }
}

// Of the corners of all plots, the one furthest from the strips along `direction`.
double furthest_corner(const farm::Farm& farm, const std::vector<Eigen::Vector3d>& path,
                       const Eigen::Vector2d& direction) {
  double furthest = 0;
  for (const farm::Plot& plot : farm.plots) {
    for (const Eigen::Vector2d& corner : plot.box.corners()) {
      double nearest = 1e9;
      for (std::size_t i = 0; i < path.size(); i += 2) {
        const Eigen::Vector2d from = path[i].head<2>();
        const Eigen::Vector2d to = path[i + 1].head<2>();
        if (std::abs((to - from).normalized().dot(direction)) < 0.999) continue;
        nearest = std::min(nearest, distance_to_segment(corner, from, to));
      }
      furthest = std::max(furthest, nearest);
    }
  }
  return furthest;
}

TEST_P(StripsOver, CrosshatchCoversEveryPlotBothWays) {
  const farm::Farm farm = plots_on_a_grid(GetParam());
  const auto path = strips_over(farm, {.spacing_m = 5, .pattern = flight::Pattern::crosshatch});
  const Eigen::Vector2d along(std::cos(GetParam()), std::sin(GetParam()));
  EXPECT_LE(furthest_corner(farm, path, along), 2.5 + 1e-9);
  EXPECT_LE(furthest_corner(farm, path, {-along.y(), along.x()}), 2.5 + 1e-9);
  EXPECT_EQ(path.size(), 2u * (2 + 6));  // 9.5 m and 28 m of plots
}

TEST_P(StripsOver, SinglePassIsOverTheMiddleOfTheLongerSide) {
  const farm::Farm farm = plots_on_a_grid(GetParam());
  const auto path = strips_over(farm, {.run_up_m = 1, .pattern = flight::Pattern::single});
  ASSERT_EQ(path.size(), 2u);
  const Eigen::Vector2d along(std::cos(GetParam()), std::sin(GetParam()));
  const Eigen::Vector2d way = (path[1] - path[0]).head<2>();
  EXPECT_NEAR(std::abs(way.dot(along)), 30, 1e-9);
  const Eigen::Vector2d middle = Eigen::Rotation2Dd(GetParam()) * Eigen::Vector2d(3, 6);
  EXPECT_NEAR(((path[0] + path[1]).head<2>() / 2 - middle).norm(), 0, 1e-9);
}

TEST_P(StripsOver, AHeadingOfOnesOwnIsKept) {
  const farm::Farm farm = plots_on_a_grid(GetParam());
  const auto path = strips_over(farm, {.spacing_m = 4, .heading_rad = 0.3});
  EXPECT_LE(furthest_corner(farm, path, {std::cos(0.3), std::sin(0.3)}), 2 + 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Headings, StripsOver, ::testing::Values(0.0, 0.4, -1.2, 1.5707963, 3.0));

TEST(FlightPlan, ImpossibleFlightsAreRefused) {
  const farm::Farm farm = plots_on_a_grid(0);
  const auto refusal = [](const farm::Farm& over, const flight::StripOptions& options) {
    return message_of<InputError>([&] { strips_over(over, options); });
  };
  EXPECT_THAT(refusal(farm, {.altitude_m = 0}), HasSubstr("altitude 0 m must be in [0.5, 120]"));
  EXPECT_THAT(refusal(farm, {.altitude_m = 121}), HasSubstr("altitude"));
  EXPECT_THAT(refusal(farm, {.altitude_m = std::nan("")}), HasSubstr("altitude"));
  EXPECT_THAT(refusal(farm, {.spacing_m = 0}), HasSubstr("spacing 0 m must be"));

  farm::Farm none = plots_on_a_grid(0);
  none.plots.clear();
  EXPECT_THAT(refusal(none, {}), HasSubstr("no plots to fly over; give a trajectory"));

  farm::Farm vast = plots_on_a_grid(0);
  vast.plots[0].box.center = {-1e4, -1e4};
  EXPECT_THAT(refusal(vast, {.spacing_m = 0.1}), HasSubstr("longer than 100 km"));

  farm::Farm hilly = testing::small_farm();
  EXPECT_THAT(refusal(hilly, {.altitude_m = 0.6}), HasSubstr("meet the ground or the crop"));

  farm::Farm elsewhere = plots_on_a_grid(0);
  for (farm::Plot& plot : elsewhere.plots) plot.box.center.x() += 1000;
  EXPECT_THAT(refusal(elsewhere, {}), HasSubstr("no plot of the farm lies on its terrain"));
}

std::string waypoint_refusal(const std::string& entries) {
  const testing::TemporaryFolder folder;
  const auto file = folder.write("way.yaml", "waypoints:\n" + entries);
  const Scene scene(scene_content(testing::small_farm()));
  return message_of<InputError>([&] { plan_waypoints(scene, file); });
}

// The small farm's plants stand under some of these; altitudes count from the ground.
TEST(FlightPlan, AltitudesOfWaypointsCountFromTheGroundBelow) {
  const farm::Farm farm = testing::small_farm();
  const testing::TemporaryFolder folder;
  std::string entries = "waypoints:\n";
  for (const farm::Plant& plant : farm.plants) {
    entries += "  - {x_m: " + std::to_string(plant.position.x()) +
               ", y_m: " + std::to_string(plant.position.y()) + ", altitude_m: 6}\n";
  }
  const auto waypoints =
      plan_waypoints(Scene(scene_content(farm)), folder.write("way.yaml", entries));
  ASSERT_EQ(waypoints.size(), farm.plants.size());
  for (std::size_t i = 0; i < waypoints.size(); ++i)
    EXPECT_NEAR(waypoints[i].position_m.z(), farm.plants[i].position.z() + 6, 1e-4);
}

TEST(FlightPlan, ImpossibleWaypointsAreRefused) {
  EXPECT_THAT(waypoint_refusal("  - {x_m: 0, y_m: 0, z_m: 5}\n  - {x_m: 0, y_m: 0, z_m: 5}\n"),
              ::testing::AllOf(HasSubstr("way.yaml"), HasSubstr("waypoint 2 is where")));
  EXPECT_THAT(waypoint_refusal("  - {x_m: 0, y_m: 0, z_m: 5}\n  - {x_m: 3, y_m: 0, z_m: 200}\n"),
              HasSubstr("waypoint 2: its height over the ground below"));
  EXPECT_THAT(
      waypoint_refusal("  - {x_m: 99, y_m: 0, altitude_m: 5}\n  - {x_m: 3, y_m: 0, z_m: 9}\n"),
      HasSubstr("waypoint 1: no ground lies below it; give z_m"));
  EXPECT_THAT(waypoint_refusal("  - {x_m: 99000, y_m: 0, z_m: 5}\n"
                               "  - {x_m: -9000, y_m: 0, z_m: 5}\n"),
              HasSubstr("at most 100 km"));
  // A slope whose ends are clear and whose middle meets the bushes' ground.
  EXPECT_THAT(
      waypoint_refusal("  - {x_m: 30, y_m: 0, z_m: 11}\n  - {x_m: -30, y_m: 0, z_m: -10}\n"),
      HasSubstr("meet the ground or the crop"));
}

}  // namespace
}  // namespace plotscan::lidar
