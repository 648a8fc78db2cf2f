// SPDX-License-Identifier: Apache-2.0
#include "heights/internal/own_part.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "canopies.h"

namespace plotscan::heights {
namespace {

// A plot 1.5 m wide and 4 m long, beside the one before it across its width.
struct Stand {
  PlotBox box;
  std::vector<Eigen::Vector3f> returns = {};
};

// Returns between 60 and 100 % of the height, scattered over that part of the box: along and across
// from its centre, metres.
void add_canopy(Stand& stand, double height_m, const Eigen::AlignedBox2d& part, int returns,
                std::uint64_t seed) {
  RandomStream random(seed, random_purpose("test/stand"), 0);
  for (int i = 0; i < returns; ++i) {
    const double along = random.uniform(part.min().x(), part.max().x());
    const double across = random.uniform(part.min().y(), part.max().y());
    const Eigen::Vector2d at =
        stand.box.center + along * stand.box.length_axis() + across * stand.box.width_axis();
    stand.returns.emplace_back(at.x(), at.y(), random.uniform(0.6, 1) * height_m);
  }
}

Stand stand_at(double across_m, double height_m, std::uint64_t seed) {
  Stand stand{.box = plot_at(0, 0)};
  stand.box.center = across_m * stand.box.width_axis();
  add_canopy(stand, height_m, {Eigen::Vector2d(-2, -0.75), Eigen::Vector2d(2, 0.75)}, 6000, seed);
  return stand;
}

// Leaves of 1 m reach over the side at +width, this far into the plot.
void reach_over(Stand& stand, double reach_m) {
  add_canopy(stand, 1, {Eigen::Vector2d(-2, 0.75 - reach_m), Eigen::Vector2d(2, 0.75)}, 400, 9);
}

std::vector<OwnPart> parts_of(const std::vector<Stand>& stands) {
  std::vector<PlotPoints> plots;
  for (const Stand& stand : stands) plots.push_back({stand.box, stand.returns});
  return own_parts(plots, 2);
}

TEST(OwnPart, EndsWhereTheTallerNeighboursLeavesReach) {
  std::vector<Stand> stands = {stand_at(0, 0.5, 1), stand_at(1.5, 1, 2), stand_at(-1.5, 0.5, 3)};
  reach_over(stands[0], 0.2);
  const std::vector<OwnPart> parts = parts_of(stands);
  EXPECT_TRUE(parts[0].reached);
  EXPECT_NEAR(parts[0].box.width_m, 1.3, 1e-9);
  EXPECT_NEAR(parts[0].box.length_m, 4, 1e-9);
  EXPECT_NEAR((parts[0].box.center + 0.1 * stands[0].box.width_axis()).norm(), 0, 1e-9);
  EXPECT_FALSE(parts[1].reached) << "of the tall plot itself";
  EXPECT_FALSE(parts[2].reached) << "leaves reach over the side at +width of the first";
  EXPECT_EQ(parts[2].box.width_m, 1.5);
}

TEST(OwnPart, IsTheWholePlotBesidePlotsThatAreNoTallerOrFarAway) {
  std::vector<Stand> alike = {stand_at(0, 0.5, 1), stand_at(1.5, 0.5, 2)};
  reach_over(alike[0], 0.2);
  EXPECT_FALSE(parts_of(alike)[0].reached);
  std::vector<Stand> apart = {stand_at(0, 0.5, 1), stand_at(2.2, 1, 2)};
  reach_over(apart[0], 0.2);
  EXPECT_FALSE(parts_of(apart)[0].reached);
  std::vector<Stand> other_side = {stand_at(0, 0.5, 1), stand_at(-1.5, 1, 2)};
  reach_over(other_side[0], 0.2);
  EXPECT_FALSE(parts_of(other_side)[0].reached);
}

TEST(OwnPart, NothingReachesOverABareSide) {
  EXPECT_FALSE(parts_of({stand_at(0, 0.5, 1), stand_at(1.5, 1, 2)})[0].reached);
}

// However far the leaves reach: the middle third of the width.
TEST(OwnPart, KeepsTheMiddle) {
  std::vector<Stand> stands = {stand_at(0, 0.5, 1), stand_at(1.5, 1, 2)};
  add_canopy(stands[0], 1, {Eigen::Vector2d(-2, 0.25), Eigen::Vector2d(2, 0.75)}, 3000, 9);
  EXPECT_NEAR(parts_of(stands)[0].box.width_m, 1, 1e-9);
}

TEST(OwnPart, PlotsWithoutReturnsAreWhole) {
  std::vector<Stand> stands = {stand_at(0, 0.5, 1), stand_at(1.5, 1, 2)};
  stands[0].returns.clear();
  EXPECT_FALSE(parts_of(stands)[0].reached);
}

}  // namespace
}  // namespace plotscan::heights
