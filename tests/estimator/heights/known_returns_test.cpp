// SPDX-License-Identifier: Apache-2.0
#include "heights/known_returns.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "canopies.h"

namespace plotscan::heights {
namespace {

constexpr double kSigma_m = 0.02;
constexpr int kReturns = 18'000;

struct OnePlot {
  PlotBox box = plot_at(0, 0);
  ground::Surface surface = level_ground(kSigma_m);
  std::vector<Eigen::Vector3f> points = dome_returns(box, 1, kSigma_m, kReturns, 7);

  // Along the box from its middle, metres.
  double along(const Eigen::Vector3f& point) const {
    return box.box_from_world(point.head<2>().cast<double>()).x();
  }
  void set_standard_error(double farther_than_m, float standard_error_m) {
    for (int row = 0; row < surface.rows; ++row) {
      for (int column = 0; column < surface.columns; ++column) {
        const Eigen::Vector2d node = surface.origin + surface.cell_m * Eigen::Vector2d(column, row);
        if (box.box_from_world(node).x() > farther_than_m)
          surface.sd_m[static_cast<std::size_t>(row * surface.columns + column)] = standard_error_m;
      }
    }
  }
};

TEST(KnownReturns, AreAllWhereTheGroundIsKnown) {
  const OnePlot plot;
  const KnownReturns known = known_returns(plot.box, plot.points, plot.surface);
  EXPECT_EQ(known.points.size(), plot.points.size());
  EXPECT_NEAR(known.ground.standard_error_m, 0.002, 1e-6);
}

TEST(KnownReturns, LeaveOutUnsureGround) {
  OnePlot plot;
  plot.set_standard_error(0.9, 0.1F);  // of the 4 m from -2 to 2
  const KnownReturns known = known_returns(plot.box, plot.points, plot.surface);
  // Nodes are 0.2 m apart: the standard error is 5 cm within one cell of the place.
  for (const Eigen::Vector3f& point : known.points) EXPECT_LT(plot.along(point), 1.2);
  const auto inside = std::ranges::count_if(
      plot.points, [&](const Eigen::Vector3f& point) { return plot.along(point) < 0.7; });
  EXPECT_GE(static_cast<long>(known.points.size()), inside);
  EXPECT_LT(known.ground.standard_error_m, 0.01);
  EXPECT_LT(known.ground.worst_error_m, 0.05);
}

TEST(KnownReturns, AreMoreThanHalfOfThePlotWhereLittleIsKnown) {
  OnePlot plot;
  plot.set_standard_error(-1.5, 0.1F);
  const KnownReturns known = known_returns(plot.box, plot.points, plot.surface);
  EXPECT_EQ(known.points.size(), plot.points.size());
  EXPECT_GT(known.ground.standard_error_m, 0.07);
}

// As returns lie over a fitted ground that cuts a ridge across the plot off.
TEST(KnownReturns, LeaveOutARidgeThatTheGroundCutsOff) {
  constexpr double kHeight_m = 1.2;
  OnePlot plot;
  const auto raised_m = [&](const Eigen::Vector3f& point) {
    return kHeight_m * std::max(0.0, 1 - std::abs(plot.along(point) - 0.8) / 0.5);
  };
  for (Eigen::Vector3f& point : plot.points) point.z() += static_cast<float>(raised_m(point));
  const KnownReturns known = known_returns(plot.box, plot.points, plot.surface);
  const auto count = [&](const std::vector<Eigen::Vector3f>& points, double low_m, double high_m) {
    return static_cast<double>(std::ranges::count_if(points, [&](const Eigen::Vector3f& point) {
      return raised_m(point) >= low_m && raised_m(point) <= high_m;
    }));
  };
  EXPECT_LT(count(known.points, kHeight_m / 2, kHeight_m),
            0.1 * count(plot.points, kHeight_m / 2, kHeight_m));
  EXPECT_GT(count(known.points, 0, 0), 0.97 * count(plot.points, 0, 0));
}

TEST(KnownReturns, KeepAPlantThatIsTallerThanTheOthers) {
  OnePlot plot;
  std::size_t of_plant = 0;
  for (Eigen::Vector3f& point : plot.points) {
    const Eigen::Vector2d place = plot.box.box_from_world(point.head<2>().cast<double>());
    // A spire on bare ground, as wide as half of a place.
    const double from_stem_m = (place - Eigen::Vector2d(0.9, 0.2)).norm();
    if (from_stem_m > 0.15) continue;
    point.z() = static_cast<float>(1.4 * (1 - from_stem_m / 0.15));
    ++of_plant;
  }
  ASSERT_GT(of_plant, 100);
  const KnownReturns known = known_returns(plot.box, plot.points, plot.surface);
  EXPECT_EQ(known.points.size(), plot.points.size());
}

}  // namespace
}  // namespace plotscan::heights
