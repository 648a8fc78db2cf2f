// SPDX-License-Identifier: Apache-2.0
#include "cloud/convex_hull.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/random.h"

namespace plotscan::cloud {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;

TEST(ConvexHull, LeavesOutInnerAndEdgePoints) {
  EXPECT_THAT(convex_hull({{0, 0}, {2, 0}, {2, 2}, {0, 2}, {1, 1}, {1, 0}, {2, 1}, {0, 0}}),
              ElementsAre(Eigen::Vector2d(0, 0), Eigen::Vector2d(2, 0), Eigen::Vector2d(2, 2),
                          Eigen::Vector2d(0, 2)));
}

TEST(ConvexHull, OfOneOrTwoPointsIsThese) {
  EXPECT_THAT(convex_hull({{1, 2}, {1, 2}}), ElementsAre(Eigen::Vector2d(1, 2)));
  EXPECT_EQ(convex_hull({{3, 4}, {1, 2}}).size(), 2U);
}

TEST(ConvexHull, HasEveryPointToTheLeftOfItsSides) {
  RandomStream random(1, random_purpose("test/convex_hull"), 0);
  std::vector<Eigen::Vector2d> points;
  for (int i = 0; i < 500; ++i) points.emplace_back(random.normal(), 3 * random.normal());
  const std::vector<Eigen::Vector2d> hull = convex_hull(points);
  ASSERT_GT(hull.size(), 3U);
  for (std::size_t i = 0; i < hull.size(); ++i) {
    EXPECT_THAT(points, Contains(hull[i]));
    for (const Eigen::Vector2d& point : points)
      EXPECT_GE(turn(hull[i], hull[(i + 1) % hull.size()], point), 0);
  }
}

}  // namespace
}  // namespace plotscan::cloud
