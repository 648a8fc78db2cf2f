// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "strata/beside_plots.h"

namespace plotscan::strata {
namespace {

constexpr double kHeading = 0.4;  // radians

// 2 rows of 6 plots of 1.5 x 4 m, turned.
std::vector<farm::Plot> turned_plots() {
  std::vector<farm::Plot> plots;
  for (int i = 0; i < 12; ++i) {
    const PlotBox axes{.heading_rad = kHeading};
    farm::Plot plot;
    plot.box = {.center = 5.0 * (i / 6) * axes.length_axis() + 2.0 * (i % 6) * axes.width_axis(),
                .width_m = 1.5,
                .length_m = 4,
                .heading_rad = kHeading};
    plot.heights.p50 = 0.8;
    plots.push_back(plot);
  }
  return plots;
}

// The rectangle about its plots: 9 m along their heading and 11.5 m across.
const PlotBox kField = [] {
  const PlotBox axes{.heading_rad = kHeading};
  return PlotBox{.center = 2.5 * axes.length_axis() + 5.0 * axes.width_axis(),
                 .width_m = 11.5,
                 .length_m = 9,
                 .heading_rad = kHeading};
}();

// How far a place lies out of the field, metres; negative inside.
double out_of_field(const Eigen::Vector2d& place) {
  const Eigen::Vector2d local = kField.box_from_world(place).cwiseAbs();
  return std::max(local.x() - kField.length_m / 2, local.y() - kField.width_m / 2);
}

// Level ground over 60 x 60 m at z = 3, and what stands on it.
std::vector<Eigen::Vector3f> scanned(Beside beside, std::uint64_t seed) {
  std::vector<Eigen::Vector3f> points;
  for (float x = -30; x <= 30; x += 0.25F)
    for (float y = -30; y <= 30; y += 0.25F) points.emplace_back(x, y, 3.0F);
  RandomStream random(seed, random_purpose("test/beside"), 0);
  lift(points, draw_beside(beside, turned_plots(), random), random);
  return points;
}

TEST(DrawBeside, ObjectsStandBesideTheFieldAtLeastAMetreFromIt) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    double highest_m = 0;
    for (const Eigen::Vector3f& point : scanned(Beside::objects, seed)) {
      if (point.z() == 3.0F) continue;
      highest_m = std::max(highest_m, point.z() - 3.0);
      ASSERT_GT(out_of_field(point.head<2>().cast<double>()), 0.99) << seed;
    }
    EXPECT_GT(highest_m, 0.1) << seed;
    EXPECT_LT(highest_m, 7) << seed;
  }
}

// All beyond one of the four sides, from 0.5 to 3 m on, as high as the plots or a third off.
TEST(DrawBeside, ABorderLiesBeyondOneSide) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    std::size_t lifted = 0;
    double nearest_m = 100;
    Eigen::Vector2d middle = Eigen::Vector2d::Zero();
    for (const Eigen::Vector3f& point : scanned(Beside::border, seed)) {
      if (point.z() == 3.0F) continue;
      ++lifted;
      middle += point.head<2>().cast<double>();
      nearest_m = std::min(nearest_m, out_of_field(point.head<2>().cast<double>()));
      ASSERT_LT(point.z() - 3, 0.8 * 1.34);
    }
    EXPECT_GT(lifted, 5000U) << seed;
    EXPECT_GT(nearest_m, 0.49) << seed;
    EXPECT_LT(nearest_m, 3.5) << seed;
    EXPECT_GT(out_of_field(middle / static_cast<double>(lifted)), 3) << seed;
  }
}

TEST(DrawBeside, NothingIsLiftedWhereNothingStands) {
  for (const Eigen::Vector3f& point : scanned(Beside::nothing, 1)) ASSERT_EQ(point.z(), 3.0F);
}

}  // namespace
}  // namespace plotscan::strata
