// SPDX-License-Identifier: Apache-2.0
#include "methods/dhami2020/voxel_filter.h"

#include <array>
#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include "core/random.h"

namespace plotscan::methods::dhami2020 {
namespace {

std::vector<Eigen::Vector3f> random_cloud(std::size_t count, double side_m) {
  std::vector<Eigen::Vector3f> points;
  RandomStream random(3, random_purpose("test/voxels"), 0);
  for (std::size_t i = 0; i < count; ++i) {
    points.emplace_back(static_cast<float>(random.uniform(-side_m, side_m)),
                        static_cast<float>(random.uniform(-side_m, side_m)),
                        static_cast<float>(random.uniform(-1, 1)));
  }
  return points;
}

// Centroids by a plain ordered map.
std::map<std::array<long, 3>, Eigen::Vector3d> naive(const std::vector<Eigen::Vector3f>& points,
                                                     double voxel_m) {
  std::map<std::array<long, 3>, std::pair<Eigen::Vector3d, int>> sums;
  for (const Eigen::Vector3f& point : points) {
    std::array<long, 3> cell{};
    for (int axis = 0; axis < 3; ++axis)
      cell[axis] = static_cast<long>(std::floor(point[axis] / voxel_m));
    auto& [sum, count] = sums.try_emplace(cell, Eigen::Vector3d::Zero(), 0).first->second;
    sum += point.cast<double>();
    ++count;
  }
  std::map<std::array<long, 3>, Eigen::Vector3d> centroids;
  for (const auto& [cell, sum] : sums) centroids[cell] = sum.first / sum.second;
  return centroids;
}

TEST(VoxelFilter, AgreesWithANaiveMap) {
  constexpr double kVoxel_m = 0.05;
  const auto points = random_cloud(200000, 2);  // about two points a voxel; the table grows
  const auto expected = naive(points, kVoxel_m);
  const auto filtered = voxel_filter(points, kVoxel_m);
  ASSERT_EQ(filtered.size(), expected.size());
  for (const Eigen::Vector3f& centroid : filtered) {
    std::array<long, 3> cell{};
    for (int axis = 0; axis < 3; ++axis)
      cell[axis] = static_cast<long>(std::floor(centroid[axis] / kVoxel_m));
    const auto found = expected.find(cell);
    // A centroid on a cell's face may round into the neighbouring cell.
    if (found == expected.end()) continue;
    EXPECT_LT((found->second - centroid.cast<double>()).norm(), 2e-6);
  }
}

TEST(VoxelFilter, KeepsTheOrderOfFirstPoints) {
  const std::vector<Eigen::Vector3f> points = {
      {5.01f, 0, 0}, {-3.01f, 0, 0}, {5.03f, 0, 0}, {0.01f, 0.01f, 0.01f}};
  const auto filtered = voxel_filter(points, 0.05);
  ASSERT_EQ(filtered.size(), 3u);
  EXPECT_NEAR(filtered[0].x(), 5.02f, 1e-6);
  EXPECT_NEAR(filtered[1].x(), -3.01f, 1e-6);
  EXPECT_NEAR(filtered[2].x(), 0.01f, 1e-6);
}

// PCL's VoxelGrid gives such a cloud back unfiltered.
TEST(VoxelFilter, FiltersAFieldOfKilometres) {
  std::vector<Eigen::Vector3f> points;
  for (const float corner : {-4000.f, 4000.f}) {
    for (int i = 0; i < 10; ++i) points.emplace_back(corner + 0.01f, corner + 0.01f, 0.001f * i);
  }
  EXPECT_EQ(voxel_filter(points, 0.05).size(), 2u);
}

TEST(VoxelFilter, StandsPointsFarBeyondItsAxes) {
  const std::vector<Eigen::Vector3f> points = {{0, 0, 1e30f}, {0, 0, -1e30f}, {0, 0, 0}};
  EXPECT_EQ(voxel_filter(points, 0.05).size(), 3u);
  EXPECT_TRUE(voxel_filter({}, 0.05).empty());
}

}  // namespace
}  // namespace plotscan::methods::dhami2020
