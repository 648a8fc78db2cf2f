// SPDX-License-Identifier: Apache-2.0
#include "cloud/tile_store.h"

#include <algorithm>
#include <bit>
#include <numeric>

#include "core/each_index.h"
#include "core/list_of.h"
#include "core/packed_pair.h"

namespace plotscan::cloud {
namespace {

constexpr std::uint32_t kNoSlot = 0xffffffff;

std::uint64_t block_key(Tile tile, int bits) { return packed_pair(tile.y >> bits, tile.x >> bits); }

struct Thinned {
  std::size_t kept = 0;
  std::size_t repeated = 0;
};

// Sorts keys into about as many buckets as keys by their upper bits, then each bucket: the keys of
// a cell are practically random, so a bucket holds few. Very many keys are sorted in place, as
// buckets would double the memory.
void sort_keys(std::span<std::uint64_t> keys) {
  constexpr std::size_t kMostInBuckets = 1 << 20;
  if (keys.size() > kMostInBuckets) return std::sort(keys.begin(), keys.end());
  const int bits = std::clamp<int>(std::bit_width(keys.size()), 1, 16);
  const auto bucket_of = [shift = 64 - bits](std::uint64_t key) { return key >> shift; };
  std::vector<std::uint32_t> end((std::size_t{1} << bits) + 1, 0);
  for (const std::uint64_t key : keys) ++end[bucket_of(key) + 1];
  std::partial_sum(end.begin(), end.end(), end.begin());
  const std::vector<std::uint64_t> unsorted(keys.begin(), keys.end());
  for (const std::uint64_t key : unsorted) keys[end[bucket_of(key)]++] = key;
  auto first = keys.begin();
  for (const std::uint32_t last : end) {
    const auto next = keys.begin() + last;
    if (next - first > 1) std::sort(first, next);
    first = next;
  }
}

// Sorts a tile's keys, of which the first `sorted` are in order, and moves those to keep to the
// front.
Thinned thin(std::span<std::uint64_t> keys, std::size_t sorted, std::size_t points_per_cell) {
  sort_keys(keys.subspan(sorted));
  if (sorted > 0)
    std::inplace_merge(keys.begin(), keys.begin() + static_cast<std::ptrdiff_t>(sorted),
                       keys.end());
  Thinned result;
  std::size_t in_cell = 0;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (i == 0 || cell_of(keys[i]) != cell_of(keys[i - 1])) in_cell = 0;
    if (result.kept > 0 && keys[i] == keys[result.kept - 1]) {
      ++result.repeated;
    } else if (in_cell < points_per_cell) {
      keys[result.kept++] = keys[i];
      ++in_cell;
    }
  }
  return result;
}

}  // namespace

TileStore::TileStore(const TileStoreOptions& options) : options_(options) {}

TileStore::Slot TileStore::slot_of(Tile tile) {
  const std::uint64_t key = block_key(tile, kBlockBits);
  if (blocks_.empty() || key != last_block_key_) {
    const auto [found, is_new] =
        block_of_.try_emplace(key, static_cast<std::uint32_t>(blocks_.size()));
    if (is_new) blocks_.emplace_back().fill(kNoSlot);
    last_block_key_ = key;
    last_block_ = found->second;
  }
  constexpr int kMask = (1 << kBlockBits) - 1;
  Slot& slot = blocks_[last_block_]
                      [static_cast<std::size_t>((tile.y & kMask) << kBlockBits | (tile.x & kMask))];
  if (slot == kNoSlot) {
    slot = static_cast<Slot>(tiles_.size());
    tiles_.push_back({.tile = tile});
  }
  return slot;
}

void TileStore::add(std::span<const Eigen::Vector3d> points) {
  counts_.added += points.size();
  new_keys_.reserve(options_.buffered_points);  // takes no memory before it is filled
  new_slots_.reserve(options_.buffered_points);
  for (const Eigen::Vector3d& point : points) {
    const std::optional<PlacedKey> placed = key_of(point);
    if (!placed) {
      ++counts_.out_of_range;
      continue;
    }
    const Slot slot = slot_of(placed->tile);
    ++tiles_[slot].added;
    new_keys_.push_back(placed->key);
    new_slots_.push_back(slot);
  }
  if (new_keys_.size() >= options_.buffered_points) merge(all_slots());
}

std::vector<TileStore::Slot> TileStore::all_slots() const {
  std::vector<Slot> slots(tiles_.size());
  std::iota(slots.begin(), slots.end(), Slot{0});
  return slots;
}

TileStore::Groups TileStore::grouped(const std::vector<Slot>& order) {
  Groups groups{.begin = std::vector<std::size_t>(tiles_.size(), kDropped),
                .size = std::vector<std::size_t>(tiles_.size(), 0)};
  for (const Slot slot : new_slots_) ++groups.size[slot];
  for (std::size_t slot = 0; slot < tiles_.size(); ++slot) groups.size[slot] += tiles_[slot].kept;
  std::size_t all = 0;
  for (const Slot slot : order) {
    groups.begin[slot] = all;
    all += groups.size[slot];
  }
  groups.keys = std::make_unique_for_overwrite<std::uint64_t[]>(all);
  std::vector<std::size_t> end = groups.begin;
  const std::uint64_t* kept = kept_.get();
  for (const Slot slot : kept_order_) {
    const std::size_t count = tiles_[slot].kept;
    if (end[slot] != kDropped) {
      std::copy_n(kept, count, &groups.keys[end[slot]]);
      end[slot] += count;
    }
    kept += count;
  }
  for (std::size_t i = 0; i < new_keys_.size(); ++i)
    if (end[new_slots_[i]] != kDropped) groups.keys[end[new_slots_[i]]++] = new_keys_[i];
  new_keys_.clear();
  new_slots_.clear();
  return groups;
}

void TileStore::merge(const std::vector<Slot>& order) {
  Groups groups = grouped(order);
  for_each_index(order.size(), options_.threads, [&](std::size_t i) {
    TileState& tile = tiles_[order[i]];
    const std::span keys(&groups.keys[groups.begin[order[i]]], groups.size[order[i]]);
    const Thinned thinned = thin(keys, tile.kept, options_.points_per_cell);
    tile.kept = thinned.kept;
    tile.repeated += thinned.repeated;
  });
  kept_size_ = 0;
  for (const Slot slot : order) {
    const std::size_t begin = groups.begin[slot];
    if (begin != kept_size_)
      std::copy_n(&groups.keys[begin], tiles_[slot].kept, &groups.keys[kept_size_]);
    kept_size_ += tiles_[slot].kept;
  }
  kept_ = std::move(groups.keys);
  kept_order_ = order;
}

std::vector<TileCount> TileStore::tile_counts() const {
  std::vector<TileCount> counts = list_of(tiles_, [&](const TileState& state) {
    return TileCount{state.tile, state.added - (taken_ ? state.repeated : 0)};
  });
  std::ranges::sort(counts, {}, &TileCount::tile);
  return counts;
}

TiledKeys TileStore::take(const std::function<bool(Tile)>& wanted) {
  taken_ = true;
  std::vector<Slot> order;
  for (const Slot slot : all_slots()) {
    if (wanted(tiles_[slot].tile)) {
      order.push_back(slot);
    } else {
      counts_.unwanted += tiles_[slot].added;
      tiles_[slot].repeated = 0;
    }
  }
  std::ranges::sort(order, {}, [&](Slot slot) { return tiles_[slot].tile; });
  merge(order);
  TiledKeys taken;
  taken.begin.push_back(0);
  for (const Slot slot : order) {
    const TileState& state = tiles_[slot];
    counts_.repeated += state.repeated;
    counts_.thinned += state.added - state.repeated - state.kept;
    taken.tiles.push_back(state.tile);
    taken.begin.push_back(taken.begin.back() + state.kept);
  }
  taken.keys = std::move(kept_);
  kept_order_.clear();
  kept_size_ = 0;
  return taken;
}

}  // namespace plotscan::cloud
