// SPDX-License-Identifier: Apache-2.0
#include "plots/search/internal/canopy_parts.h"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "estimator/plots/trial_cloud.h"

namespace plotscan::plots {
namespace {

constexpr double kLow_m = 0.15;

// 2.2 m apart; a weed of 0.8 m lies far from both.
const PlotBox kLeft{.center = {-4, 0}, .width_m = 4, .length_m = 5.8};
const PlotBox kRight{.center = {4, 0}, .width_m = 4, .length_m = 5.8};
const PlotBox kWeed{.center = {0, 9}, .width_m = 0.8, .length_m = 0.8};

std::vector<Eigen::Vector3f> cloud() { return cloud_over({kLeft, kRight, kWeed}); }

std::ptrdiff_t canopy_in(const PlotBox& box, const std::vector<Eigen::Vector3f>& points) {
  return std::ranges::count_if(points, [&](const Eigen::Vector3f& point) {
    return point.z() > kLow_m && box.contains(point.head<2>().cast<double>());
  });
}

TEST(CanopyParts, LieFartherApartThanTheGap) {
  EXPECT_EQ(CanopyParts(cloud(), kLow_m, 1.5).size(), 2u);
  EXPECT_EQ(CanopyParts(cloud(), kLow_m, 3).size(), 1u);
}

TEST(CanopyParts, AreNoneOfBareGround) {
  EXPECT_EQ(CanopyParts(cloud_over({}), kLow_m, 1.5).size(), 0u);
  EXPECT_EQ(CanopyParts({}, kLow_m, 1.5).size(), 0u);
}

TEST(CanopyParts, HaveThePointsThatAreNotOfOthers) {
  const std::vector<Eigen::Vector3f> points = cloud();
  const CanopyParts parts(points, kLow_m, 1.5);
  ASSERT_EQ(parts.size(), 2u);
  for (std::size_t part = 0; part < 2; ++part) {
    const std::vector<Eigen::Vector3f> own = parts.without_others(points, part);
    const bool is_left = canopy_in(kLeft, own) > 0;
    const PlotBox &mine = is_left ? kLeft : kRight, &others = is_left ? kRight : kLeft;
    EXPECT_EQ(canopy_in(mine, own), canopy_in(mine, points));
    EXPECT_EQ(canopy_in(others, own), 0);
    EXPECT_GT(own.size() - static_cast<std::size_t>(canopy_in(mine, own)), 10000u);  // ground
  }
}

}  // namespace
}  // namespace plotscan::plots
