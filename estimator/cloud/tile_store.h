// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <unordered_map>
#include <vector>

#include <Eigen/Core>

#include "cloud/point_key.h"

namespace plotscan::cloud {

// How many points were added over a tile.
struct TileCount {
  Tile tile;
  std::uint64_t points = 0;
};

// Points by tile, tiles in their order, the points of a tile in their keys' order.
struct TiledKeys {
  std::vector<Tile> tiles = {};
  std::vector<std::size_t> begin = {};  // of each tile's keys; one more than tiles, ends the last
  std::unique_ptr<std::uint64_t[]> keys = {};

  std::span<const std::uint64_t> all() const { return {keys.get(), begin.back()}; }
  std::span<const std::uint64_t> of(std::size_t tile) const {
    return {&keys[begin[tile]], begin[tile + 1] - begin[tile]};
  }
};

struct TileStoreOptions {
  std::size_t points_per_cell = 256;
  // New points are merged with the kept ones once this many are buffered: 2^24 take 340 MB.
  std::size_t buffered_points = std::size_t{1} << 24;
  int threads = 1;
};

// Takes points in any order and keeps, in each cell of 0.125 m, at most points_per_cell of them: a
// practically random sample that depends neither on their order nor on the number of threads. A
// point that repeats another to 0.06 mm counts once. Memory is bounded by the area over which the
// points lie: at most 16 bytes for each point kept, and the buffer of new ones.
class TileStore {
 public:
  struct Counts {
    std::uint64_t added = 0;
    std::uint64_t out_of_range = 0;  // no key holds them (point_key.h)
    std::uint64_t repeated = 0;      // in tiles taken: the same point was there already
    std::uint64_t thinned = 0;       // in tiles taken: points_per_cell others were there
    std::uint64_t unwanted = 0;      // in tiles that take() left
  };

  explicit TileStore(const TileStoreOptions& options);

  void add(std::span<const Eigen::Vector3d> points);  // frame of any kind, z up, metres
  // The number of points added to each tile, in the tiles' order; after take(), without those of
  // tiles taken that repeat others.
  std::vector<TileCount> tile_counts() const;
  // Hands over the tiles that `wanted` accepts. Can be called once; after it nothing can be added.
  TiledKeys take(const std::function<bool(Tile)>& wanted);
  std::size_t points_held() const { return kept_size_ + new_keys_.size(); }
  // Complete only after take().
  const Counts& counts() const { return counts_; }

 private:
  using Slot = std::uint32_t;  // of a tile, in the order in which tiles were met
  // Slots of 16 x 16 tiles.
  static constexpr int kBlockBits = 4;
  using Block = std::array<Slot, 1u << (2 * kBlockBits)>;

  struct TileState {
    Tile tile;
    std::uint64_t added = 0;
    std::uint64_t repeated = 0;
    std::size_t kept = 0;  // of kept_
  };

  // Keys by slot, one slot's after another's.
  struct Groups {
    std::vector<std::size_t> begin, size;  // by slot; kDropped: its keys are not there
    std::unique_ptr<std::uint64_t[]> keys = {};
  };
  static constexpr auto kDropped = std::numeric_limits<std::size_t>::max();

  Slot slot_of(Tile tile);
  // The kept keys and the new ones, slots in `order`, in each slot the kept ones first. Keys of
  // slots that are not in `order` are dropped, and no key is new afterwards.
  Groups grouped(const std::vector<Slot>& order);
  // Groups the keys, and sorts and thins those of each slot: they are the kept ones from then on.
  void merge(const std::vector<Slot>& order);
  std::vector<Slot> all_slots() const;

  TileStoreOptions options_;
  Counts counts_;

  std::unordered_map<std::uint64_t, std::uint32_t> block_of_;
  std::vector<Block> blocks_;
  std::uint64_t last_block_key_ = 0;
  std::uint32_t last_block_ = 0;

  std::vector<TileState> tiles_;  // by slot
  bool taken_ = false;
  std::unique_ptr<std::uint64_t[]>
      kept_;  // slot after slot of kept_order_, each sorted and thinned
  std::vector<Slot> kept_order_;
  std::size_t kept_size_ = 0;
  // Added since the last merge.
  std::vector<std::uint64_t> new_keys_;
  std::vector<Slot> new_slots_;
};

}  // namespace plotscan::cloud
