// SPDX-License-Identifier: Apache-2.0
#include "crop/internal/grass.h"

#include <algorithm>
#include <numbers>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "crop/internal/axis.h"
#include "mesh/measure.h"

namespace plotscan::crop {
namespace {

using Eigen::Vector3d;

GrassBlade straight_blade() {
  GrassBlade blade;
  blade.collar = {0, 0, 1};
  blade.length_m = 0.8;
  blade.width_m = 0.09;
  blade.base_width_share = 0.6;
  blade.points = 40;
  return blade;
}

double area(const GrassBlade& blade, Detail detail) {
  PlantBuilder plant(detail, {{"leaf", Eigen::Vector3f::Ones()}});
  plant.blade(grass_blade(blade), "leaf");
  return mesh::ScaledArea(plant.take()).at();
}

TEST(GrassBlade, HasMontgomerysArea) {
  const GrassBlade blade = straight_blade();
  EXPECT_NEAR(area(blade, Detail::scan) / (blade.length_m * blade.width_m), 0.75, 0.02);
}

TEST(GrassBlade, KeepsItsLengthAndAboutItsAreaWhenItBendsAndTwists) {
  GrassBlade blade = straight_blade();
  const double flat = area(blade, Detail::scan);
  blade.elevation_rad = 1.2;
  blade.bend_rad = 2;
  blade.twist_rad = 1;
  const Blade sheet = grass_blade(blade);
  double length_m = 0;
  for (std::size_t i = 1; i < sheet.midrib.size(); ++i) {
    length_m += (sheet.midrib[i] - sheet.midrib[i - 1]).norm();
  }
  EXPECT_NEAR(length_m, 0.8, 1e-9);
  EXPECT_NEAR(area(blade, Detail::scan) / flat, 1, 0.02);
  EXPECT_NEAR(area(blade, Detail::light) / flat, 1, 0.08);
}

// An arc of constant curvature has its tip at length * sin(bend) / bend along its first direction.
TEST(GrassBlade, BendsInAnArcWhereItsExponentIsOne) {
  GrassBlade blade = straight_blade();
  blade.points = 400;
  blade.bend_rad = std::numbers::pi / 2;
  const Vector3d tip = grass_blade(blade).midrib.back();
  const double radius = 0.8 / blade.bend_rad;
  EXPECT_NEAR(tip.x(), radius, 2e-3);
  EXPECT_NEAR(tip.z(), 1 - radius, 2e-3);
}

TEST(GrassBlade, LiesOnTheGroundInPlaceOfGoingThroughIt) {
  GrassBlade blade = straight_blade();
  blade.collar = {0, 0, 0.1};
  blade.bend_rad = 2;
  const Blade sheet = grass_blade(blade);
  for (const Vector3d& point : sheet.midrib) EXPECT_GE(point.z(), 0);
  EXPECT_GT(sheet.midrib.back().x(), 0.5);
}

TEST(GrassBlade, AVisibleTipHasTheTipsWidths) {
  GrassBlade blade = straight_blade();
  blade.visible = 0.25;
  const Blade tip = grass_blade(blade);
  EXPECT_NEAR((tip.midrib.back() - tip.midrib.front()).norm(), 0.2, 1e-9);
  EXPECT_NEAR(tip.half_width_m.front(), 0.045 * grass_width_share(0.75, 0.6, 0.4), 1e-12);
  EXPECT_EQ(tip.half_width_m.back(), 0);
}

TEST(RankProfile, PeaksAtItsRankAndHasItsEnds) {
  const RankProfile profile{
      .first_rank = 1, .peak_rank = 12, .last_rank = 19, .first = 0.1, .last = 0.4};
  EXPECT_DOUBLE_EQ(profile.at(1), 0.1);
  EXPECT_DOUBLE_EQ(profile.at(12), 1);
  EXPECT_DOUBLE_EQ(profile.at(19), 0.4);
  for (int rank = 1; rank < 12; ++rank) EXPECT_LT(profile.at(rank), profile.at(rank + 1));
  for (int rank = 12; rank < 19; ++rank) EXPECT_GT(profile.at(rank), profile.at(rank + 1));
}

TEST(Axis, IsFoundByItsLength) {
  Axis axis(Vector3d::Zero());
  axis.add({0, 0, 2});
  axis.add({1, 0, 0});
  EXPECT_EQ(axis.length_m(), 3);
  EXPECT_EQ(axis.at(0.5), Vector3d(0, 0, 0.5));
  EXPECT_EQ(axis.at(2.25), Vector3d(0.25, 0, 2));
  EXPECT_EQ(axis.at(4), Vector3d(2, 0, 2));
  EXPECT_EQ(axis.heading(2.5), Vector3d(1, 0, 0));
  EXPECT_EQ(axis.part(1, 3, 3)[1], Vector3d(0, 0, 2));
}

}  // namespace
}  // namespace plotscan::crop
