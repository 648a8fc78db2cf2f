// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>
#include <cstdint>
#include <optional>

#include <Eigen/Core>

namespace plotscan::cloud {

// A square metre of the horizontal plane by its south-west corner, whole metres.
struct Tile {
  std::int32_t x = 0;
  std::int32_t y = 0;
  bool operator==(const Tile&) const = default;
  // South to north, in a row west to east.
  auto operator<=>(const Tile& other) const { return y != other.y ? y <=> other.y : x <=> other.x; }
};

// A point as its tile and 64 bits for its place there, in steps of 2^-14 m = 0.06 mm. Two points
// have one key if and only if they are the same to a step. From the top, a key holds the point's
// cell (a tile has 8 x 8, row by row), 36 bits mixed from its place within the cell and within a
// metre of height, and the whole metres of its height. Keys in their order are thus sorted by cell,
// and within a cell in a practically random order, which neither the points' order nor a shift of
// the cloud by whole metres changes: the first k of a cell are a bottom-k sample (Cohen and Kaplan,
// "Summarizing data using bottom-k sketches", PODC 2007, 225-234).
struct PlacedKey {
  Tile tile;
  std::uint64_t key = 0;
};

inline constexpr int kStepBits = 14;  // a metre has 2^14 steps
inline constexpr double kStepsAMetre = 1 << kStepBits;
inline constexpr int kCellsAMetre = 8;
inline constexpr int kCellsATile = kCellsAMetre * kCellsAMetre;

// Whether a point has a key: 1,000,000 km is as far as x and y reach, 2,000 km z.
bool is_in_reach(const Eigen::Vector3d& point);

// The key of a point; absent where it is out of reach.
std::optional<PlacedKey> key_of(const Eigen::Vector3d& point);

// The point that a key stands for, relative to `origin`.
Eigen::Vector3f point_of(Tile tile, std::uint64_t key, const Eigen::Vector3d& origin);

// The number of the key's cell within its tile.
inline int cell_of(std::uint64_t key) { return static_cast<int>(key >> 58); }

}  // namespace plotscan::cloud
