// SPDX-License-Identifier: Apache-2.0
#include "cloud/internal/field_finder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "core/error.h"

namespace plotscan::cloud {
namespace {

using Cell = std::array<std::int32_t, 2>;

std::uint64_t cell_key(const Cell& cell) {
  return static_cast<std::uint64_t>(static_cast<std::uint32_t>(cell[0])) << 32 |
         static_cast<std::uint32_t>(cell[1]);
}
Cell cell_at(std::uint64_t key) {
  return {static_cast<std::int32_t>(key >> 32), static_cast<std::int32_t>(key)};
}
std::int32_t index_of(double coordinate_m) {
  constexpr double kFarthest = 1e9;  // stays inside the 32 bits of a cell's index
  return static_cast<std::int32_t>(
      std::floor(std::clamp(coordinate_m / FieldFinder::kCell_m, -kFarthest, kFarthest)));
}

using Counts = std::vector<std::pair<std::uint64_t, std::uint32_t>>;

// The count of the cell that holds the median point: unlike the median cell's, it is not drawn down
// by the wide and thinly scanned surroundings.
std::uint32_t typical_count(Counts counts) {
  std::ranges::sort(counts, {}, &Counts::value_type::second);
  std::uint64_t total = 0;
  for (const auto& [key, count] : counts) total += count;
  std::uint64_t below = 0;
  for (const auto& [key, count] : counts) {
    below += count;
    if (2 * below >= total) return count;
  }
  return 0;
}

// Takes the patch of cells around `start` out of those that are `free`.
std::vector<Cell> take_patch(std::unordered_map<std::uint64_t, bool>& free, std::uint64_t start) {
  std::vector<Cell> patch{cell_at(start)};
  free[start] = false;
  for (std::size_t i = 0; i < patch.size(); ++i) {
    const Cell cell = patch[i];
    for (const Cell step : {Cell{1, 0}, Cell{-1, 0}, Cell{0, 1}, Cell{0, -1}}) {
      const Cell neighbour{cell[0] + step[0], cell[1] + step[1]};
      const auto found = free.find(cell_key(neighbour));
      if (found == free.end() || !found->second) continue;
      found->second = false;
      patch.push_back(neighbour);
    }
  }
  return patch;
}

std::vector<Cell> largest_patch(const Counts& counts, double threshold) {
  std::unordered_map<std::uint64_t, bool> free;
  for (const auto& [key, count] : counts) {
    if (count >= threshold) free.emplace(key, true);
  }
  std::vector<Cell> largest;
  for (const auto& [key, count] : counts) {  // sorted: of equal patches the first one wins
    const auto found = free.find(key);
    if (found == free.end() || !found->second) continue;
    std::vector<Cell> patch = take_patch(free, key);
    if (patch.size() > largest.size()) largest = std::move(patch);
  }
  return largest;
}

}  // namespace

void FieldFinder::add(std::span<const Eigen::Vector3d> world_points) {
  for (const Eigen::Vector3d& point : world_points) {
    ++count_by_cell_[cell_key({index_of(point.x()), index_of(point.y())})];
  }
}

Area FieldFinder::field() const {
  if (count_by_cell_.empty()) throw InputError("a cloud without points has no field");
  Counts counts(count_by_cell_.begin(), count_by_cell_.end());
  std::ranges::sort(counts);
  const std::vector<Cell> patch = largest_patch(counts, kDenseShare * typical_count(counts));
  Cell low = patch.front();
  Cell high = patch.front();
  for (const Cell& cell : patch) {
    for (const int axis : {0, 1}) {
      low[axis] = std::min(low[axis], cell[axis]);
      high[axis] = std::max(high[axis], cell[axis]);
    }
  }
  return {low[0] * kCell_m, low[1] * kCell_m, (high[0] + 1.0) * kCell_m, (high[1] + 1.0) * kCell_m};
}

}  // namespace plotscan::cloud
