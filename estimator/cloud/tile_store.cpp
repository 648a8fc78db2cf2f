// SPDX-License-Identifier: Apache-2.0
#include "cloud/tile_store.h"

#include <algorithm>
#include <bit>
#include <numeric>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "core/packed_pair.h"

namespace plotscan::cloud {
namespace {

constexpr std::uint32_t kNoSlot = 0xffffffff;

std::uint64_t block_key(Tile tile, int bits) { return packed_pair(tile.y >> bits, tile.x >> bits); }

struct Thinned {
  std::size_t kept = 0;
  std::size_t repeated = 0;
};

// Sorts keys into about as many buckets by their upper bits, and then each of these: the keys of a
// cell are as good as drawn by lot, so that a bucket has few. Very many are sorted in their place,
// as buckets take as much memory again.
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
  if (new_keys_.size() >= options_.buffered_points) merge({});
}

// Groups the kept and the new keys by slot, then sorts and thins each slot's in their place. Slots
// that are unwanted, where any are named, end up empty.
void TileStore::merge(const std::vector<char>& unwanted) {
  const std::size_t slots = tiles_.size();
  std::vector<std::size_t> begin(slots + 1, 0);
  for (const Slot slot : new_slots_) ++begin[slot + 1];
  for (std::size_t slot = 0; slot < slots; ++slot)
    begin[slot + 1] += begin[slot] + tiles_[slot].kept;

  auto grouped = std::make_unique_for_overwrite<std::uint64_t[]>(begin[slots]);
  std::vector<std::size_t> end(begin.begin(), begin.end() - 1);
  const std::uint64_t* kept = kept_.get();
  for (std::size_t slot = 0; slot < slots; ++slot) {
    std::copy_n(kept, tiles_[slot].kept, &grouped[end[slot]]);
    kept += tiles_[slot].kept;
    end[slot] += tiles_[slot].kept;
  }
  for (std::size_t i = 0; i < new_keys_.size(); ++i) grouped[end[new_slots_[i]]++] = new_keys_[i];
  new_keys_.clear();
  new_slots_.clear();

  tbb::task_arena arena(options_.threads);
  arena.execute([&] {
    tbb::parallel_for(std::size_t{0}, slots, [&](std::size_t slot) {
      const std::span keys(&grouped[begin[slot]], end[slot] - begin[slot]);
      const bool dropped = !unwanted.empty() && unwanted[slot];
      const Thinned thinned =
          dropped ? Thinned{} : thin(keys, tiles_[slot].kept, options_.points_per_cell);
      tiles_[slot].kept = thinned.kept;
      tiles_[slot].repeated += thinned.repeated;
    });
  });

  kept_size_ = 0;
  for (std::size_t slot = 0; slot < slots; ++slot) {
    std::copy_n(&grouped[begin[slot]], tiles_[slot].kept, &grouped[kept_size_]);
    kept_size_ += tiles_[slot].kept;
  }
  kept_ = std::move(grouped);
}

std::vector<TileCount> TileStore::tile_counts() const {
  std::vector<TileCount> counts;
  for (const TileState& state : tiles_) counts.push_back({state.tile, state.added});
  std::ranges::sort(counts, {}, &TileCount::tile);
  return counts;
}

TiledKeys TileStore::take(const std::function<bool(Tile)>& wanted) {
  std::vector<char> unwanted;
  for (const TileState& state : tiles_) unwanted.push_back(!wanted(state.tile));
  merge(unwanted);
  struct Range {
    Tile tile;
    std::size_t begin;
    std::size_t size;
  };
  std::vector<Range> ranges;
  std::size_t begin = 0;
  for (std::size_t slot = 0; slot < tiles_.size(); ++slot) {
    const TileState& state = tiles_[slot];
    if (unwanted[slot]) {
      counts_.unwanted += state.added;
      continue;
    }
    counts_.repeated += state.repeated;
    counts_.thinned += state.added - state.repeated - state.kept;
    ranges.push_back({state.tile, begin, state.kept});
    begin += state.kept;
  }
  std::ranges::sort(ranges, {}, &Range::tile);
  TiledKeys taken;
  taken.keys.reserve(kept_size_);
  for (const Range& range : ranges) {
    taken.tiles.push_back(range.tile);
    taken.begin.push_back(taken.keys.size());
    const std::uint64_t* first = &kept_[range.begin];
    taken.keys.insert(taken.keys.end(), first, first + range.size);
  }
  taken.begin.push_back(taken.keys.size());
  kept_.reset();
  kept_size_ = 0;
  return taken;
}

}  // namespace plotscan::cloud
