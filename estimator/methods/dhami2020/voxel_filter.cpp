// SPDX-License-Identifier: Apache-2.0
#include "methods/dhami2020/voxel_filter.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace plotscan::methods::dhami2020 {
namespace {

constexpr int kAxisBits = 21;
constexpr double kHalfAxis = 1 << (kAxisBits - 1);

// A sparse grid of voxels: an open-addressing table from cell to voxel over a dense list.
class VoxelGrid {
 public:
  explicit VoxelGrid(double voxel_m) : voxel_m_(voxel_m), slots_(1 << 16, kFree) {}

  // The table is larger than the caches: what a block's points need is fetched before their turn,
  // their slots first and then their voxels.
  void add(std::span<const Eigen::Vector3f> points) {
    constexpr std::size_t kBlock = 64;
    std::array<Cell, kBlock> cells;
    while (!points.empty()) {
      const auto block = points.first(std::min(kBlock, points.size()));
      for (std::size_t i = 0; i < block.size(); ++i) {
        cells[i] = cell_of(block[i]);
        __builtin_prefetch(&slots_[first_slot(cells[i].key)]);
      }
      for (std::size_t i = 0; i < block.size(); ++i) fetch_voxel(cells[i]);
      for (std::size_t i = 0; i < block.size(); ++i) add(block[i], cells[i]);
      points = points.subspan(block.size());
    }
  }

  std::vector<Eigen::Vector3f> centroids() const {
    std::vector<Eigen::Vector3f> result;
    result.reserve(voxels_.size());
    for (const Voxel& voxel : voxels_) {
      const Eigen::Vector3d offset = voxel.offset_sum.cast<double>() / voxel.count;
      result.emplace_back((corner(voxel.key) + offset).cast<float>());
    }
    return result;
  }

 private:
  struct Voxel {
    std::uint64_t key = 0;
    Eigen::Vector3f offset_sum = Eigen::Vector3f::Zero();
    std::uint32_t count = 0;
  };
  static constexpr std::uint32_t kFree = 0xffffffff;

  struct Cell {
    Eigen::Array3d index;
    std::uint64_t key;
  };

  Cell cell_of(const Eigen::Vector3f& point) const {
    const Eigen::Array3d index =
        (point.cast<double>().array() / voxel_m_).floor().max(-kHalfAxis).min(kHalfAxis - 1);
    return {index, key_of(index)};
  }

  void fetch_voxel(const Cell& cell) const {
    const std::uint32_t voxel = slots_[first_slot(cell.key)];
    if (voxel != kFree) __builtin_prefetch(&voxels_[voxel]);
  }

  void add(const Eigen::Vector3f& point, const Cell& cell) {
    Voxel& voxel = voxel_of(cell.key);
    // Offsets from the cell's corner are small: float32 sums of them stay exact enough.
    voxel.offset_sum +=
        (point.cast<double>().array() - cell.index * voxel_m_).matrix().cast<float>();
    ++voxel.count;
  }

  static std::uint64_t key_of(const Eigen::Array3d& index) {
    const Eigen::Array<std::int32_t, 3, 1> from_end = (index + kHalfAxis).cast<std::int32_t>();
    return static_cast<std::uint64_t>(from_end.x()) << (2 * kAxisBits) |
           static_cast<std::uint64_t>(from_end.y()) << kAxisBits |
           static_cast<std::uint64_t>(from_end.z());
  }
  Eigen::Vector3d corner(std::uint64_t key) const {
    constexpr std::uint64_t kMask = (1u << kAxisBits) - 1;
    const Eigen::Array3d index(static_cast<double>(key >> (2 * kAxisBits)),
                               static_cast<double>(key >> kAxisBits & kMask),
                               static_cast<double>(key & kMask));
    return (index - kHalfAxis) * voxel_m_;
  }
  std::size_t first_slot(std::uint64_t key) const {
    std::uint64_t mixed = key * 0x9e3779b97f4a7c15u;  // Fibonacci hashing
    mixed ^= mixed >> 32;
    return mixed & (slots_.size() - 1);
  }

  Voxel& voxel_of(std::uint64_t key) {
    std::size_t slot = first_slot(key);
    while (slots_[slot] != kFree) {
      if (voxels_[slots_[slot]].key == key) return voxels_[slots_[slot]];
      slot = (slot + 1) & (slots_.size() - 1);
    }
    slots_[slot] = static_cast<std::uint32_t>(voxels_.size());
    voxels_.push_back({.key = key});
    if (2 * voxels_.size() > slots_.size()) grow();
    return voxels_.back();
  }

  void grow() {
    slots_.assign(4 * slots_.size(), kFree);
    for (std::size_t i = 0; i < voxels_.size(); ++i) {
      std::size_t slot = first_slot(voxels_[i].key);
      while (slots_[slot] != kFree) slot = (slot + 1) & (slots_.size() - 1);
      slots_[slot] = static_cast<std::uint32_t>(i);
    }
  }

  double voxel_m_;
  std::vector<std::uint32_t> slots_;
  std::vector<Voxel> voxels_;
};

}  // namespace

std::vector<Eigen::Vector3f> voxel_filter(std::span<const Eigen::Vector3f> points, double voxel_m) {
  VoxelGrid grid(voxel_m);
  grid.add(points);
  return grid.centroids();
}

}  // namespace plotscan::methods::dhami2020
