// SPDX-License-Identifier: Apache-2.0
#include "plots/canopy/canopy_raster.h"

#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "core/random.h"

namespace plotscan::plots {
namespace {

// 7 x 9 cells, three quarters of them seen.
struct Cells {
  std::vector<std::uint32_t> steps;
  std::vector<double> cover, seen;

  Cells() {
    for (std::uint64_t i = 0; i < 63; ++i) {
      RandomStream random(1, random_purpose("test/raster"), i);
      const bool is_seen = random.uniform(0, 4) > 1;
      steps.push_back(is_seen ? static_cast<std::uint32_t>(random.uniform(0, 200)) : kUnseen);
      cover.push_back(is_seen ? steps.back() / 200.0 : 0);
      seen.push_back(is_seen ? 1 : 0);
    }
  }
};

TEST(CanopyRaster, SumsAreWhatAddingCellByCellGives) {
  const Cells cells;
  const CanopyRaster raster({}, 0.1, 7, 9, cells.steps);
  for (int a0 = -1; a0 < 7; ++a0) {
    for (int b0 = -1; b0 < 9; ++b0) {
      const int a1 = a0 + 3, b1 = b0 + 4;
      double seen = 0, cover = 0;
      for (int a = std::max(0, a0); a < std::min(7, a1); ++a) {
        for (int b = std::max(0, b0); b < std::min(9, b1); ++b) {
          const auto at = static_cast<std::size_t>(9 * a + b);
          seen += cells.seen[at];
          cover += cells.cover[at];
        }
      }
      EXPECT_EQ(raster.seen_cells(a0, a1, b0, b1), seen);
      EXPECT_NEAR(raster.cover(a0, a1, b0, b1), seen > 0 ? cover / seen : 0, 1e-12);
    }
  }
}

Frame oblique() {
  return {.a_axis = {std::cos(0.3), std::sin(0.3)}, .b_axis = {std::cos(1.7), std::sin(1.7)}};
}

TEST(Frame, LeadsToTheWorldAndBack) {
  Frame frame = oblique();
  frame.origin = {4, -7};
  const Eigen::Vector2d world = frame.to_world({2, 3});
  EXPECT_NEAR(world.x(), 4 + 2 * std::cos(0.3) + 3 * std::cos(1.7), 1e-12);
  EXPECT_NEAR(world.y(), -7 + 2 * std::sin(0.3) + 3 * std::sin(1.7), 1e-12);
  EXPECT_LT((frame.ab_from_world() * (world - frame.origin) - Eigen::Vector2d(2, 3)).norm(), 1e-12);
}

// Every cell holds the mean of order 4 of the shares of the points in its parallelogram.
TEST(Rasterise, PutsEveryPointInItsCell) {
  std::vector<Eigen::Vector3f> points;
  for (std::uint64_t i = 0; i < 4000; ++i) {
    RandomStream random(2, random_purpose("test/raster"), i);
    points.emplace_back(static_cast<float>(random.uniform(10, 14)),
                        static_cast<float>(random.uniform(-3, 1)),
                        static_cast<float>(random.uniform(0, 1)));
  }
  const FieldBlocks blocks(points, 0.02, 2);
  const FieldCanopy field(points, blocks, {.top_m = 1}, 2);
  const CanopyScale scale{0.2, 0.7};
  const CanopyRaster raster = rasterise(field, oblique(), 0.4, {&scale, 1}, 2).front();
  const Frame& frame = raster.frame();
  for (int a = 0; a < raster.a_cells(); ++a) {
    for (int b = 0; b < raster.b_cells(); ++b) {
      double count = 0, powers = 0;
      for (const Eigen::Vector3f& point : points) {
        // By Cramer's rule, not by the frame's inverse.
        const Eigen::Vector2d from = point.head<2>().cast<double>() - frame.origin;
        const double angle = std::sin(1.7 - 0.3);
        const double at_a = (from.x() * std::sin(1.7) - from.y() * std::cos(1.7)) / angle / 0.4;
        const double at_b = (from.y() * std::cos(0.3) - from.x() * std::sin(0.3)) / angle / 0.4;
        if (std::floor(at_a + 1e-9) != a || std::floor(at_b + 1e-9) != b) continue;
        ++count;
        powers += std::pow(std::clamp((point.z() - 0.2) / 0.5, 0.0, 1.0), 4);
      }
      EXPECT_EQ(raster.seen_cells(a, a + 1, b, b + 1), count > 0 ? 1 : 0);
      EXPECT_NEAR(raster.cover(a, a + 1, b, b + 1), std::pow(powers / std::max(1.0, count), 0.25),
                  0.01);
    }
  }
}

// A tree of 3 m on the square metre about (20.5, 0.5), beside a crop of 0.5 m.
TEST(Rasterise, TallThingsCountWhereTheyAreToldTo) {
  std::vector<Eigen::Vector3f> points;
  for (std::uint64_t i = 0; i < 20000; ++i) {
    RandomStream random(4, random_purpose("test/raster"), i);
    const auto x = static_cast<float>(random.uniform(0, 21));
    const double top_m = x > 20 ? 3 : x < 10 ? 0.5 : 0.01;
    points.emplace_back(x, static_cast<float>(random.uniform(0, 1)),
                        static_cast<float>(random.uniform(0, top_m)));
  }
  const FieldBlocks blocks(points, 0.02, 2);
  const FieldCanopy field(points, blocks, {.top_m = 0.45}, 2);
  const std::array scales = {CanopyScale{.low_m = 0.1, .high_m = 0.4},
                             CanopyScale{.low_m = 0.1, .high_m = 0.4, .with_others = true}};
  const std::vector<CanopyRaster> rasters = rasterise(field, {}, 0.25, scales, 2);
  const auto cell_at = [&](const Eigen::Vector2d& place) -> Eigen::Vector2i {
    return ((place - rasters[0].frame().origin) / 0.25).array().round().cast<int>();
  };
  const Eigen::Vector2i low = cell_at({0, 0}), tall = cell_at({20, 0});
  const int b0 = low.y(), b1 = b0 + 4;
  EXPECT_EQ(rasters[0].seen_cells(tall.x(), tall.x() + 4, b0, b1), 0);
  EXPECT_EQ(rasters[1].seen_cells(tall.x(), tall.x() + 4, b0, b1), 16);
  EXPECT_GT(rasters[1].cover(tall.x(), tall.x() + 4, b0, b1), 0.85);
  EXPECT_GT(rasters[0].cover(low.x(), low.x() + 40, b0, b1), 0.1);
  EXPECT_EQ(rasters[0].cover(low.x(), low.x() + 40, b0, b1),
            rasters[1].cover(low.x(), low.x() + 40, b0, b1));
}

// A return in each cell of 0.25 m of 10 x 6 m. A band of the raster may end where they do.
TEST(Rasterise, HasUnseenCellsAllAround) {
  constexpr int kAround = 20, kAlong = 40, kAcross = 24;
  std::vector<Eigen::Vector3f> points;
  for (int a = 0; a < kAlong; ++a)
    for (int b = 0; b < kAcross; ++b)
      points.emplace_back(0.25F * static_cast<float>(a), 0.25F * static_cast<float>(b), 0.0F);
  const FieldBlocks blocks(points, 0.02, 2);
  const CanopyScale scale{.low_m = 0.1, .high_m = 0.4, .with_others = true};
  const FieldCanopy field(points, blocks, {.top_m = 0.45}, 2);
  const CanopyRaster raster = rasterise(field, {}, 0.25, {&scale, 1}, 2).front();
  ASSERT_GE(raster.a_cells(), kAlong + 2 * kAround);
  ASSERT_GE(raster.b_cells(), kAcross + 2 * kAround);
  const double all = raster.seen_cells(0, raster.a_cells(), 0, raster.b_cells());
  EXPECT_EQ(all, static_cast<double>(field.points().size()));
  EXPECT_EQ(
      raster.seen_cells(kAround, raster.a_cells() - kAround, kAround, raster.b_cells() - kAround),
      all);
}

TEST(Rasterise, OfNoPointsHasNoCells) {
  const CanopyScale scale{0.2, 0.7};
  const FieldBlocks none({}, 0.02, 1);
  EXPECT_EQ(rasterise(FieldCanopy({}, none, {}, 1), {}, 0.1, {&scale, 1}, 1).front().a_cells(), 0);
}

}  // namespace
}  // namespace plotscan::plots
