// SPDX-License-Identifier: Apache-2.0
// What an estimate may not depend on, and what it must: on random fields, moved, turned, mirrored,
// in another order, with outliers, with half of the points.
#include <algorithm>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "cloud/tile_store.h"
#include "core/random.h"
#include "core/statistics.h"
#include "methods/lattice/lattice.h"

namespace plotscan::estimate {
namespace {

using Points = std::vector<Eigen::Vector3d>;

constexpr double kSide_m = 22;  // of the field, whose middle is 0, 0
constexpr double kReturns_m2 = 350;

// 3 rows of 6 plots of 1.5 x 4 m, as high as the seed says, on a gentle slope.
struct RandomField {
  explicit RandomField(std::uint64_t of_seed) : seed(of_seed) {
    RandomStream random(seed, random_purpose("test/properties/field"), 0);
    slope = {random.uniform(-0.03, 0.03), random.uniform(-0.03, 0.03)};
    for (double& height : heights_m) height = random.uniform(0.5, 0.9);
  }

  // The canopy above a place; 0 between the plots.
  double canopy_m(double x, double y) const {
    const double column = (x + 7.5) / 2.5, row = (y + 8.25) / 5.5;
    if (column < 0 || column >= 6 || row < 0 || row >= 3) return 0;
    const bool inside = std::abs(column - std::floor(column) - 0.5) * 2.5 < 0.75 &&
                        std::abs(row - std::floor(row) - 0.5) * 5.5 < 2;
    return inside ? heights_m[static_cast<std::size_t>(row) * 6 + static_cast<std::size_t>(column)]
                  : 0;
  }

  // Leaves in tufts of 0.25 m, one in five returns from the ground below, noise of 2 cm.
  Points points() const {
    Points all;
    const auto count = static_cast<std::uint64_t>(kReturns_m2 * kSide_m * kSide_m);
    for (std::uint64_t i = 0; i < count; ++i) {
      RandomStream random(seed, random_purpose("test/properties/return"), i);
      const double x = random.uniform(-0.5, 0.5) * kSide_m;
      const double y = random.uniform(-0.5, 0.5) * kSide_m;
      const double canopy = random.uniform() < 0.2 ? 0 : canopy_m(x, y);
      const auto tuft = static_cast<std::uint64_t>(std::floor(4 * x) + 1000) * 4096 +
                        static_cast<std::uint64_t>(std::floor(4 * y) + 1000);
      RandomStream leaf(seed, random_purpose("test/properties/tuft"), tuft);
      const double top = canopy * leaf.uniform(0.75, 1);
      all.emplace_back(
          x, y,
          slope.dot(Eigen::Vector2d(x, y)) + top * random.uniform(0.3, 1) + 0.02 * random.normal());
    }
    return all;
  }

  std::uint64_t seed;
  Eigen::Vector2d slope;
  std::array<double, 18> heights_m{};
};

// Of the canopy itself: the calibration knows no such plants.
Estimate estimate_of(const Points& points) {
  cloud::TileStore store({});
  store.add(points);
  methods::lattice::Options options;
  options.calibrated = false;
  return methods::lattice::estimate_plots(cloud::take_field(store, {}, "points"), options);
}

// The plot of the estimate nearest to a place.
const PlotEstimate& plot_at(const Estimate& estimate, const Eigen::Vector2d& place) {
  return *std::ranges::min_element(estimate.plots, {}, [&](const PlotEstimate& plot) {
    return (plot.box.center - place).squaredNorm();
  });
}

// The same plots at `moved` places, as high.
void expect_follows(const Estimate& estimate, const Estimate& of_moved,
                    const Eigen::Isometry3d& moved, double off_m, double height_m) {
  ASSERT_EQ(estimate.plots.size(), 18u);
  ASSERT_EQ(of_moved.plots.size(), 18u);
  for (const PlotEstimate& plot : estimate.plots) {
    const Eigen::Vector3d at(plot.box.center.x(), plot.box.center.y(), 0);
    const Eigen::Vector2d place = (moved * at).head<2>();
    const PlotEstimate& other = plot_at(of_moved, place);
    EXPECT_LT((other.box.center - place).norm(), off_m);
    EXPECT_NEAR(other.box.length_m, plot.box.length_m, 2 * off_m);
    for (const char* name : {"mean", "p90", "max"})
      EXPECT_NEAR(other.heights_m.at(name), plot.heights_m.at(name), height_m) << name;
  }
}

Points with(const Points& points, const Eigen::Isometry3d& moved) {
  Points all;
  for (const Eigen::Vector3d& point : points) all.push_back(moved * point);
  return all;
}

TEST(Properties, TheEstimateFollowsAFieldThatIsMovedAndTurned) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const Points points = RandomField(seed).points();
    const Estimate estimate = estimate_of(points);
    RandomStream random(seed, random_purpose("test/properties/motion"), 0);
    Eigen::Isometry3d moved = Eigen::Isometry3d::Identity();
    moved.translation() << std::round(random.uniform(1e5, 9e5)), std::round(random.uniform(0, 9e6)),
        std::round(random.uniform(-100, 3000));
    expect_follows(estimate, estimate_of(with(points, moved)), moved, 1e-3, 1e-3);
    moved.translation() += Eigen::Vector3d(random.uniform(), random.uniform(), random.uniform());
    moved.rotate(
        Eigen::AngleAxisd(random.uniform(0, 2 * std::numbers::pi), Eigen::Vector3d::UnitZ()));
    expect_follows(estimate, estimate_of(with(points, moved)), moved, 0.06, 0.02);
  }
}

TEST(Properties, TheEstimateFollowsAFieldInAMirror) {
  for (const std::uint64_t seed : {4, 5}) {
    const Points points = RandomField(seed).points();
    Eigen::Isometry3d mirror = Eigen::Isometry3d::Identity();
    mirror.linear().diagonal() << -1, 1, 1;
    expect_follows(estimate_of(points), estimate_of(with(points, mirror)), mirror, 0.06, 0.02);
  }
}

TEST(Properties, TheOrderOfThePointsIsNothing) {
  Points points = RandomField(6).points();
  const Estimate estimate = estimate_of(points);
  RandomStream random(6, random_purpose("test/properties/order"), 0);
  for (std::size_t i = points.size(); i > 1; --i) std::swap(points[i - 1], points[random.below(i)]);
  const Estimate shuffled = estimate_of(points);
  ASSERT_EQ(shuffled.plots.size(), estimate.plots.size());
  for (std::size_t i = 0; i < estimate.plots.size(); ++i) {
    EXPECT_EQ(shuffled.plots[i].box.center, estimate.plots[i].box.center);
    EXPECT_EQ(shuffled.plots[i].heights_m, estimate.plots[i].heights_m);
  }
}

// One return in a hundred from far above or below: birds, clouds, mirror images.
TEST(Properties, OutliersMoveHeightsByMillimetres) {
  for (const std::uint64_t seed : {7, 8}) {
    Points points = RandomField(seed).points();
    const Estimate estimate = estimate_of(points);
    RandomStream random(seed, random_purpose("test/properties/outliers"), 0);
    for (std::size_t i = points.size() / 100; i > 0; --i) {
      const double up = random.uniform() < 0.5 ? -1 : 1;
      points.emplace_back(random.uniform(-0.5, 0.5) * kSide_m, random.uniform(-0.5, 0.5) * kSide_m,
                          up * random.uniform(12, 60));
    }
    expect_follows(estimate, estimate_of(points), Eigen::Isometry3d::Identity(), 0.005, 0.005);
  }
}

// One return in a hundred stray in the air within 10 m. Those at the canopy's own spacing from it
// stay, and move the tallest plant of two plots in 36 by 0.06 and 0.13 m.
TEST(Properties, AHazeMovesHeightsByMillimetresInMostPlots) {
  std::map<std::string, std::vector<double>> moved_m;
  for (const std::uint64_t seed : {7, 8}) {
    Points points = RandomField(seed).points();
    const Estimate estimate = estimate_of(points);
    RandomStream random(seed, random_purpose("test/properties/haze"), 0);
    for (std::size_t i = points.size() / 100; i > 0; --i) {
      points.emplace_back(random.uniform(-0.5, 0.5) * kSide_m, random.uniform(-0.5, 0.5) * kSide_m,
                          random.uniform(-5, 10));
    }
    const Estimate of_hazy = estimate_of(points);
    ASSERT_EQ(of_hazy.plots.size(), estimate.plots.size());
    for (const char* name : {"mean", "p90", "max"})
      for (const PlotEstimate& plot : estimate.plots)
        moved_m[name].push_back(std::abs(plot_at(of_hazy, plot.box.center).heights_m.at(name) -
                                         plot.heights_m.at(name)));
  }
  for (const auto& [name, of_plots_m] : moved_m) {
    EXPECT_LT(quantile(of_plots_m, 0.5), 0.005) << name;
    EXPECT_LT(quantile(of_plots_m, 0.9), 0.02) << name;
  }
}

// Most of an interval is what points do not tell; that of p90 widens a little with fewer of them.
TEST(Properties, IntervalsOfHalfOfThePointsHold) {
  for (const std::uint64_t seed : {9, 10}) {
    const Points points = RandomField(seed).points();
    Points half;
    for (std::size_t i = 0; i < points.size(); ++i) {
      RandomStream lot(seed, random_purpose("test/properties/lot"), i);
      if (lot.uniform() < 0.5) half.push_back(points[i]);
    }
    const Estimate all = estimate_of(points);
    const Estimate fewer = estimate_of(half);
    ASSERT_EQ(fewer.plots.size(), all.plots.size());
    double before_m = 0, after_m = 0, inside = 0;
    for (const PlotEstimate& plot : all.plots) {
      const HeightError& error = plot_at(fewer, plot.box.center).errors.at("p90");
      before_m += plot.errors.at("p90").standard_error_m;
      after_m += error.standard_error_m;
      const double height_m = plot.heights_m.at("p90");
      inside += error.low95_m <= height_m && height_m <= error.high95_m;
    }
    EXPECT_GT(after_m, before_m);
    EXPECT_GE(inside, 0.95 * static_cast<double>(all.plots.size()));
  }
}

}  // namespace
}  // namespace plotscan::estimate
