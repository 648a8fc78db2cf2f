// SPDX-License-Identifier: Apache-2.0
#include "cloud/tile_store.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "core/random.h"

namespace plotscan::cloud {
namespace {

using WorldPoints = std::vector<Eigen::Vector3d>;

WorldPoints random_points(std::size_t count, double side_m, std::uint64_t seed = 1) {
  RandomStream random(seed, random_purpose("test/tile_store"), 0);
  WorldPoints points;
  for (std::size_t i = 0; i < count; ++i)
    points.emplace_back(random.uniform(-side_m, side_m), random.uniform(-side_m, side_m),
                        random.uniform(-3, 3));
  return points;
}

TiledKeys taken(const WorldPoints& points, const TileStoreOptions& options,
                TileStore::Counts* counts = nullptr) {
  TileStore store(options);
  constexpr std::size_t kPiece = 1000;
  for (std::size_t i = 0; i < points.size(); i += kPiece)
    store.add(std::span(points).subspan(i, std::min(kPiece, points.size() - i)));
  TiledKeys keys = store.take([](Tile) { return true; });
  if (counts != nullptr) *counts = store.counts();
  return keys;
}

void expect_same(const TiledKeys& a, const TiledKeys& b) {
  EXPECT_EQ(a.tiles, b.tiles);
  EXPECT_EQ(a.begin, b.begin);
  EXPECT_TRUE(std::ranges::equal(a.all(), b.all()));
}

TEST(PointKey, HoldsAPointToHalfAStep) {
  const Eigen::Vector3d utm(500000, 4100000, 300);
  for (const Eigen::Vector3d& origin : {Eigen::Vector3d(0, 0, 0), utm, Eigen::Vector3d(-utm)}) {
    for (const Eigen::Vector3d& offset : random_points(1000, 100)) {
      const Eigen::Vector3d point = origin + offset;
      const auto placed = key_of(point);
      ASSERT_TRUE(placed);
      EXPECT_EQ(placed->tile.x, std::floor(std::round(point.x() * kStepsAMetre) / kStepsAMetre));
      const Eigen::Vector3f back = point_of(placed->tile, placed->key, origin);
      // Half a step, and the rounding of 100 m to a float.
      ASSERT_LT((back.cast<double>() - offset).cwiseAbs().maxCoeff(), 0.5 / kStepsAMetre + 4e-6);
    }
  }
}

TEST(PointKey, IsTheSameForACloudMovedByWholeMetres) {
  for (Eigen::Vector3d point : random_points(1000, 10)) {
    point = (point * 0x1p20).array().round() * 0x1p-20;  // is not rounded by the move
    const auto here = key_of(point);
    const auto there = key_of(point + Eigen::Vector3d(500000, 4100000, 0));
    EXPECT_EQ(here->key, there->key);
    EXPECT_EQ(there->tile.x - here->tile.x, 500000);
    EXPECT_EQ(there->tile.y - here->tile.y, 4100000);
  }
}

TEST(PointKey, HasNoneBeyondReason) {
  EXPECT_FALSE(key_of({1e30, 0, 0}));
  EXPECT_FALSE(key_of({0, -1e10, 0}));
  EXPECT_FALSE(key_of({0, 0, 3e6}));
  EXPECT_FALSE(key_of({0, 0, std::nan("")}));
  EXPECT_TRUE(key_of({-9e8, 9e8, -2e6}));
}

// By sorting all points of each cell.
TEST(TileStore, KeepsTheFirstOfEachCellAsBruteForceDoes) {
  const WorldPoints points = random_points(40000, 2);
  constexpr std::size_t kMost = 7;
  std::map<std::tuple<int, int, int>, std::set<std::uint64_t>> by_cell;
  for (const Eigen::Vector3d& point : points) {
    const Eigen::Array2d steps = (point.head<2>().array() * kStepsAMetre + 0.5).floor();
    const Eigen::Array2i cell = (steps / (kStepsAMetre / kCellsAMetre)).floor().cast<int>();
    by_cell[{cell.y() >> 3, cell.x() >> 3, (cell.y() & 7) * 8 + (cell.x() & 7)}].insert(
        key_of(point)->key);
  }
  std::vector<std::uint64_t> expected;
  for (const auto& [cell, keys] : by_cell) {
    std::size_t taken = 0;
    for (auto key = keys.begin(); key != keys.end() && taken < kMost; ++key, ++taken)
      expected.push_back(*key);
  }
  EXPECT_TRUE(std::ranges::equal(taken(points, {.points_per_cell = kMost}).all(), expected));
}

// Whatever the order, the pieces, the merges in between and the threads.
TEST(TileStore, TheOrderOfThePointsChangesNothing) {
  WorldPoints points = random_points(60000, 3);
  const TiledKeys once = taken(points, {.points_per_cell = 20});
  EXPECT_LT(once.all().size(), 0.9 * static_cast<double>(points.size()));
  for (const std::size_t buffered_points : {1000u, 7000u, 100000u}) {
    std::shuffle(points.begin(), points.end(), std::mt19937(buffered_points));
    expect_same(
        taken(points, {.points_per_cell = 20, .buffered_points = buffered_points, .threads = 2}),
        once);
  }
}

TEST(TileStore, CountsEveryPointOnce) {
  WorldPoints points = random_points(20000, 3);
  points.insert(points.end(), points.begin(), points.begin() + 5000);  // exact repeats
  points.emplace_back(1e12, 0, 0);
  TileStore::Counts counts;
  const TiledKeys all = taken(points, {.points_per_cell = 1000}, &counts);
  EXPECT_EQ(counts.added, 25001u);
  EXPECT_EQ(counts.out_of_range, 1u);
  EXPECT_EQ(counts.repeated, 5000u);
  EXPECT_EQ(counts.thinned, 0u);
  EXPECT_EQ(all.all().size(), 20000u);
  const TiledKeys few = taken(points, {.points_per_cell = 2}, &counts);
  EXPECT_GT(counts.thinned, 10000u);
  EXPECT_EQ(few.all().size() + counts.thinned + counts.repeated + 1, counts.added);
}

TEST(TileStore, HandsOverWhatIsWanted) {
  TileStore store({});
  store.add(WorldPoints{{0.5, 0.5, 0}, {1.5, 0.5, 0}, {-0.5, 7.5, 0}, {0.5, 0.6, 0}});
  const std::vector<TileCount> counts = store.tile_counts();
  ASSERT_EQ(counts.size(), 3u);
  EXPECT_EQ(counts[0].tile, (Tile{0, 0}));
  EXPECT_EQ(counts[0].points, 2u);
  EXPECT_EQ(counts[2].tile, (Tile{-1, 7}));
  const TiledKeys keys = store.take([](Tile tile) { return tile.x <= 0; });
  EXPECT_EQ(keys.tiles, (std::vector<Tile>{{0, 0}, {-1, 7}}));
  EXPECT_EQ(keys.begin, (std::vector<std::size_t>{0, 2, 3}));
  EXPECT_EQ(store.counts().unwanted, 1u);
}

TEST(TileStore, CountsNoPointOfATileTwiceOnceItIsTaken) {
  TileStore store({});
  store.add(WorldPoints{{0.5, 0.5, 0}, {1.5, 0.5, 0}, {0.5, 0.5, 0}, {1.5, 0.5, 0}});
  EXPECT_EQ(store.tile_counts()[0].points, 2u);
  store.take([](Tile tile) { return tile.x <= 0; });
  EXPECT_EQ(store.tile_counts()[0].points, 1u);
  EXPECT_EQ(store.tile_counts()[1].points, 2u);
}

// In a crowded cell, the points kept have the distribution of all: their mean height is that of
// the cell within four of its standard errors.
TEST(TileStore, KeepsAFairSample) {
  WorldPoints points = random_points(400000, 0.5);
  for (Eigen::Vector3d& point : points) {
    point.head<2>() *= 0.9999;  // is not rounded into the next cell
    point.z() = 2 * point.x() + std::abs(point.z());
  }
  const TiledKeys keys = taken(points, {.points_per_cell = 256});
  double z = 0;
  for (std::size_t i = 0; i < keys.tiles.size(); ++i)
    for (const std::uint64_t key : keys.of(i))
      z += point_of(keys.tiles[i], key, Eigen::Vector3d::Zero()).z();
  const auto kept = static_cast<double>(keys.all().size());
  EXPECT_EQ(kept, 64 * 256);
  const double sd = std::sqrt(4.0 / 12 + 9.0 / 12);
  EXPECT_NEAR(z / kept, 1.5, 4 * sd / std::sqrt(kept));
}

// What is kept stops growing with the number of points, and so does the memory.
TEST(TileStore, IsBoundedByTheArea) {
  TileStore store({.points_per_cell = 16, .buffered_points = 1u << 22, .threads = 2});
  constexpr std::size_t kPoints = 50'000'000;
  std::mt19937_64 random(1);
  WorldPoints piece(1u << 16);
  std::size_t added = 0;
  for (; added < kPoints; added += piece.size()) {
    for (Eigen::Vector3d& point : piece) {
      const std::uint64_t bits = random();
      point = {static_cast<double>(bits & 0x3ffff) / kStepsAMetre,
               static_cast<double>(bits >> 20 & 0x3ffff) / kStepsAMetre,
               static_cast<double>(bits >> 40) * 0x2p-24};
    }
    store.add(piece);
    ASSERT_LE(store.points_held(), 16 * 16 * kCellsATile * 16u + (1u << 22) + piece.size());
  }
  const TiledKeys keys = store.take([](Tile) { return true; });
  EXPECT_EQ(keys.all().size(), 16 * 16 * kCellsATile * 16u);
  EXPECT_EQ(store.counts().added, added);
}

}  // namespace
}  // namespace plotscan::cloud
