// SPDX-License-Identifier: Apache-2.0
#include "cloud/internal/field_hull.h"

#include <cmath>

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/angle.h"
#include "core/error.h"
#include "core/random.h"

namespace plotscan::cloud {
namespace {

using ::testing::ElementsAre;

// Points over rectangles, counted.
class Survey {
 public:
  // density: points a square metre; the rectangle's centre, sides and heading.
  Survey& over(double density, Eigen::Vector2d centre, double length_m, double width_m,
               double heading_rad = 0) {
    RandomStream random(1, random_purpose("test/hull"), rectangles_++);
    const Eigen::Rotation2Dd turned(heading_rad);
    std::vector<Eigen::Vector3d> points;
    for (double i = 0; i < density * length_m * width_m; ++i) {
      const Eigen::Vector2d place =
          centre + turned * Eigen::Vector2d(random.uniform(-length_m / 2, length_m / 2),
                                            random.uniform(-width_m / 2, width_m / 2));
      points.emplace_back(place.x(), place.y(), 0);
    }
    store_.add(points);
    return *this;
  }
  Survey& at(double x, double y) {
    store_.add(std::vector{Eigen::Vector3d(x, y, 0)});
    return *this;
  }
  FieldHull field() const { return find_field(store_.tile_counts()); }

 private:
  std::uint64_t rectangles_ = 0;
  TileStore store_{{}};
};

void expect_within(const Area& area, const Area& expected, double tolerance_m) {
  for (const int i : {0, 1, 2, 3}) EXPECT_NEAR(area[i], expected[i], tolerance_m) << "side " << i;
}

TEST(FieldHull, IsTheConvexHullOfItsTiles) {
  const FieldHull hull(std::vector<Tile>{{0, 0}, {2, 0}, {1, 1}, {0, 2}});
  EXPECT_THAT(hull.corners(),
              ElementsAre(Eigen::Vector2d(0, 0), Eigen::Vector2d(3, 0), Eigen::Vector2d(3, 1),
                          Eigen::Vector2d(1, 3), Eigen::Vector2d(0, 3)));
  EXPECT_THAT(hull.bounds(), ElementsAre(0, 0, 3, 3));
  EXPECT_TRUE(hull.holds({1, 0}));
  EXPECT_TRUE(hull.holds({1, 1}));
  EXPECT_FALSE(hull.holds({2, 2}));
  EXPECT_FALSE(hull.holds({3, 0}));
}

// Density falls off around the field as it does around a flight.
TEST(FieldHull, HoldsTheDenseCoreOfAScanOfAnyDensity) {
  for (const double density : {5.0, 50.0, 500.0}) {
    const FieldHull field = Survey()
                                .over(density, {-10, 15}, 40, 30)
                                .over(density / 30, {0, 0}, 160, 160)
                                .over(5 * density, {60, 60}, 3, 3)
                                .at(9000, -70000)
                                .field();
    const double step_m = density < 16 ? 2 : 1;
    expect_within(field.bounds(), {-30, 0, 10, 30}, 2 * step_m);
  }
}

TEST(FieldHull, FollowsAFieldThatLiesAskew) {
  const double heading = radians(40);
  const FieldHull field = Survey()
                              .over(100, {500000, 4100000}, 60, 20, heading)
                              .over(5, {500000, 4100000}, 150, 150)
                              .field();
  const Eigen::Rotation2Dd from_world(-heading);
  for (int x = 499950; x < 500050; ++x) {
    for (int y = 4099950; y < 4100050; ++y) {
      const Eigen::Vector2d place =
          from_world * Eigen::Vector2d(x + 0.5 - 500000, y + 0.5 - 4100000);
      const double beyond = std::max(std::abs(place.x()) - 30, std::abs(place.y()) - 10);
      if (beyond < 0 || beyond > 4) {
        EXPECT_EQ(field.holds({x, y}), beyond < 0) << x << " " << y;
      }
    }
  }
}

TEST(FieldHull, HoldsStripsWithTheGapsBetweenThem) {
  const FieldHull field = Survey()
                              .over(200, {0, 0}, 50, 4)
                              .over(200, {0, 8}, 50, 4)
                              .over(200, {0, -7.5}, 50, 4)
                              .field();
  expect_within(field.bounds(), {-25, -9.5, 25, 10}, 1.6);
}

// A tripod's scan is a hundred times as dense at its four stations as between them.
TEST(FieldHull, HoldsAScanThatIsDensestAtItsStations) {
  Survey survey;
  survey.over(60, {0, 0}, 40, 30);
  for (const double x : {-20.0, 20.0})
    for (const double y : {-15.0, 15.0}) survey.over(8000, {x, y}, 4, 3);
  expect_within(survey.field().bounds(), {-22, -16.5, 22, 16.5}, 2);
}

// Two fields with nothing between them are no larger field.
TEST(FieldHull, IsOneOfTwoFieldsThatNothingJoins) {
  const FieldHull field = Survey()
                              .over(100, {0, 0}, 30, 20)
                              .over(100, {100, 0}, 29, 20)
                              .over(90, {0, 99}, 29, 20)
                              .field();
  expect_within(field.bounds(), {-15, -10, 15, 10}, 2);
}

// A cloud that was cropped already, or that is one small plot, loses nothing at its edges.
TEST(FieldHull, CutsNothingOffACroppedCloud) {
  for (const double shift_m : {0.0, 0.05, 0.5, 0.93}) {
    TileStore store({});
    RandomStream random(1, random_purpose("test/hull"), 9);
    std::vector<Eigen::Vector3d> points;
    for (int i = 0; i < 5000; ++i)
      points.emplace_back(shift_m + random.uniform(0, 1.5), shift_m + random.uniform(0, 2.2), 0);
    store.add(points);
    const FieldHull field = find_field(store.tile_counts());
    store.take([&](Tile tile) { return field.holds(tile); });
    EXPECT_EQ(store.counts().unwanted, 0u);
  }
}

TEST(FieldHull, NeedsAPoint) { EXPECT_THROW(find_field({}), InputError); }

}  // namespace
}  // namespace plotscan::cloud
