// SPDX-License-Identifier: Apache-2.0
#include "lidar/flight_plan.h"

#include <algorithm>
#include <cmath>

#include "small_farm.h"
#include "temporary_folder.h"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"

namespace plotscan::lidar {
namespace {

using ::testing::HasSubstr;
using testing::message_of;

std::vector<Eigen::Vector3d> strips_over(const farm::Farm& farm, const FlightPlanOptions& options) {
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
  for (const double spacing : {1.0, 3.3, 6.0, 50.0}) {
    const auto path = strips_over(farm, {.altitude_m = 8, .spacing_m = spacing, .run_up_m = 1.5});
    ASSERT_EQ(path.size() % 2, 0u);
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

INSTANTIATE_TEST_SUITE_P(Headings, StripsOver, ::testing::Values(0.0, 0.4, -1.2, 1.5707963, 3.0));

TEST(FlightPlan, ImpossibleFlightsAreRefused) {
  const farm::Farm farm = plots_on_a_grid(0);
  const auto refusal = [](const farm::Farm& over, const FlightPlanOptions& options) {
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

}  // namespace
}  // namespace plotscan::lidar
