// SPDX-License-Identifier: Apache-2.0
#include "cloud/internal/haze.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "core/each_index.h"
#include "core/statistics.h"

namespace plotscan::cloud {
namespace {

constexpr double kHazeSlab_m = 0.5;
constexpr std::ptrdiff_t kOutwards = 12;  // slabs, that crops of 3 m fill half of
constexpr std::int32_t kBlock = 8;        // tiles to each side
constexpr double kMostVoxelsAMetre = 10;
constexpr std::size_t kMostAlone = 2;  // points in the cube of one that is alone
constexpr double kColumnPoints = 60;   // in a square as wide as the cube

using Profile = std::vector<std::uint32_t>;  // by slab
using Block = std::pair<std::int32_t, std::int32_t>;

// Counts in voxels over a tile and one voxel around it: 9 of them side by side, and 3 high, are a
// point's cube. Counts end at 255. Floats hold a point's place in a tile exactly.
class Voxels {
 public:
  Voxels(const Eigen::Vector3f& corner, double height_m, int a_metre)
      : a_metre_(static_cast<float>(a_metre)),
        corner_(corner),
        low_(corner.head<2>().array() - 1.5f / a_metre_),
        high_(corner.head<2>().array() + 1 + 1.5f / a_metre_),
        across_(a_metre + 2),
        up_(static_cast<int>(std::ceil(height_m * a_metre)) + 2),
        counts_(static_cast<std::size_t>(across_) * across_ * up_, 0) {}

  // A quick test: most points of the neighbouring tiles lie outside the voxels.
  bool may_hold(const Eigen::Vector3f& point) const {
    return point.x() >= low_.x() && point.x() <= high_.x() && point.y() >= low_.y() &&
           point.y() <= high_.y();
  }

  void add(const Eigen::Vector3f& point) {
    const Place at = place_of(point);
    const bool inside =
        at.x >= 0 && at.y >= 0 && at.z >= 0 && at.x < across_ && at.y < across_ && at.z < up_;
    if (!inside) return;
    std::uint8_t& count = counts_[index_of(at)];
    count += count < 255;
  }

  // The middle voxel of the cube around a point of the tile.
  std::uint32_t middle_of(const Eigen::Vector3f& point) const {
    const Place at = place_of(point);
    return static_cast<std::uint32_t>(index_of({.x = std::clamp(at.x, 1, across_ - 2),
                                                .y = std::clamp(at.y, 1, across_ - 2),
                                                .z = std::clamp(at.z, 1, up_ - 2)}));
  }

  // Count of points in the cube around a voxel: exact up to `most`, else any number above it.
  std::size_t around(std::uint32_t middle, std::size_t most) const {
    std::size_t count = counts_[middle];
    for (int dy = -1; dy <= 1 && count <= most; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const std::uint8_t* const voxel =
            &counts_[middle] + std::ptrdiff_t{dy * across_ + dx} * up_;
        count += voxel[-1] + voxel[1] + (dx != 0 || dy != 0 ? voxel[0] : 0);
      }
    }
    return count;
  }

 private:
  struct Place {
    int x, y, z;
  };

  Place place_of(const Eigen::Vector3f& point) const {
    return {.x = voxel_of(point.x() - corner_.x()),
            .y = voxel_of(point.y() - corner_.y()),
            .z = voxel_of(point.z() - corner_.z())};
  }

  // Index of a voxel along an axis, the border's is 0. Rounds down: shifted to be positive, then
  // truncated.
  int voxel_of(float offset_m) const {
    constexpr float kShift = 16, kBeyond = 1e6f;
    const float at = std::clamp(offset_m * a_metre_ + (kShift + 1), 0.0f, kBeyond);
    return static_cast<int>(at) - static_cast<int>(kShift);
  }

  std::size_t index_of(const Place& at) const {
    const std::ptrdiff_t column = std::ptrdiff_t{at.y} * across_ + at.x;
    return static_cast<std::size_t>(column * up_ + at.z);
  }

  float a_metre_;
  Eigen::Vector3f corner_;
  Eigen::Array2f low_, high_;  // beyond the voxels
  int across_;
  int up_;
  std::vector<std::uint8_t> counts_;
};

// A cloud's points, each in a slab over its tile's level.
class Air {
 public:
  Air(const TiledPoints& cloud, int threads)
      : cloud_(cloud),
        rows_(cloud.tiles),
        slabs_(static_cast<std::ptrdiff_t>(std::ceil(2 * kFarthest_m / kHazeSlab_m)) + 1) {
    for (const double level_m : tile_levels(cloud, rows_, threads))
      bottom_m_.push_back(std::floor((level_m - kFarthest_m) / kHazeSlab_m) * kHazeSlab_m);
    for (const Tile tile : cloud.tiles) west_ = std::min(west_, tile.x);
  }

  std::ptrdiff_t slabs() const { return slabs_; }

  // Beyond the profile's ends where a point lies outside the tile's air.
  std::ptrdiff_t slab_of(std::size_t tile, const Eigen::Vector3f& point) const {
    const double slab = std::floor((point.z() - bottom_m_[tile]) / kHazeSlab_m);
    return static_cast<std::ptrdiff_t>(std::clamp(slab, -1.0, static_cast<double>(slabs_)));
  }

  bool holds(std::ptrdiff_t slab) const { return slab >= 0 && slab < slabs_; }

  Block block_of(std::size_t tile) const {
    const Tile at = cloud_.tiles[tile];
    return {(at.x - west_) / kBlock, (at.y - cloud_.tiles.front().y) / kBlock};
  }

  // The tile's points that are alone in their cubes.
  Marked alone(std::size_t tile) const {
    const auto density_m2 = static_cast<double>(cloud_.size(tile));
    const double voxels_m = std::round(3 * std::sqrt(density_m2 / kColumnPoints));
    const int a_metre = static_cast<int>(std::clamp(voxels_m, 1.0, kMostVoxelsAMetre));
    if (9 * density_m2 / (a_metre * a_metre) < kColumnPoints / 2) return {};
    Voxels voxels(corner_of(tile), static_cast<double>(slabs_) * kHazeSlab_m, a_metre);
    rows_.visit_around(tile, 1, [&](std::size_t other) {
      for (const Eigen::Vector3f& point : cloud_.of(other))
        if (voxels.may_hold(point)) voxels.add(point);
    });
    Marked result;
    for (std::size_t i = cloud_.begin[tile]; i < cloud_.begin[tile + 1]; ++i)
      if (voxels.around(voxels.middle_of(cloud_.points[i]), kMostAlone) <= kMostAlone)
        result.push_back(i);
    return result;
  }

 private:
  // In the points' own frame, at the bottom of the tile's air.
  Eigen::Vector3f corner_of(std::size_t tile) const {
    Eigen::Vector3f low = cloud_.points[cloud_.begin[tile]];
    for (const Eigen::Vector3f& point : cloud_.of(tile)) low = low.cwiseMin(point);
    return {std::floor(low.x()), std::floor(low.y()), static_cast<float>(bottom_m_[tile])};
  }

  const TiledPoints& cloud_;
  TileRows rows_;
  std::ptrdiff_t slabs_;
  std::vector<double> bottom_m_;  // of each tile's air
  std::int32_t west_ = std::numeric_limits<std::int32_t>::max();
};

// For each block with points that are alone: how many there are, by slab, in it and the 8 around
// it.
std::map<Block, Profile> profiles_of(const TiledPoints& cloud, const Air& air,
                                     const std::vector<Marked>& alone) {
  std::map<Block, Profile> own;
  for (std::size_t tile = 0; tile < cloud.tiles.size(); ++tile) {
    for (const std::size_t i : alone[tile]) {
      const std::ptrdiff_t slab = air.slab_of(tile, cloud.points[i]);
      if (!air.holds(slab)) continue;
      Profile& profile = own[air.block_of(tile)];
      profile.resize(static_cast<std::size_t>(air.slabs()));
      ++profile[static_cast<std::size_t>(slab)];
    }
  }
  std::map<Block, Profile> around = own;
  for (auto& [block, sum] : around) {
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const auto other = own.find({block.first + dx, block.second + dy});
        if ((dx == 0 && dy == 0) || other == own.end()) continue;
        for (std::size_t slab = 0; slab < sum.size(); ++slab) sum[slab] += other->second[slab];
      }
    }
  }
  return around;
}

// The lower quartile of kOutwards slabs from `first` on.
double quartile(const Profile& alone, std::ptrdiff_t first) {
  std::array<std::uint32_t, kOutwards> outwards{};
  std::copy_n(alone.begin() + first, kOutwards, outwards.begin());
  return selected_low<std::uint32_t>(outwards, kOutwards / 4);
}

// Whether most of the `alone` points may be strays, given the number of `expected` strays.
bool may_be_strays(double alone, double expected) {
  return expected > 0 && alone <= 2 * expected + 3 * std::sqrt(2 * expected);
}

// By slab: whether its points that are alone are taken for strays.
std::vector<char> hazy_slabs(const Profile& alone) {
  const auto slabs = static_cast<std::ptrdiff_t>(alone.size());
  std::vector<char> result(alone.size(), 0);
  double above = 0;
  for (std::ptrdiff_t slab = slabs / 2; slab < slabs && above == 0; ++slab) {
    const double expected = quartile(alone, std::min(slab + 1, slabs - kOutwards));
    if (!may_be_strays(alone[static_cast<std::size_t>(slab)], expected)) continue;
    above = expected;
    std::fill(result.begin() + slab, result.end(), 1);
  }
  for (std::ptrdiff_t slab = 0; slab < slabs / 2; ++slab) {
    const double below = quartile(alone, std::max<std::ptrdiff_t>(slab - kOutwards, 0));
    result[static_cast<std::size_t>(slab)] =
        may_be_strays(alone[static_cast<std::size_t>(slab)], std::max(above, below));
  }
  return result;
}

}  // namespace

std::size_t drop_haze(TiledPoints& cloud, int threads) {
  if (cloud.points.empty()) return 0;
  const Air air(cloud, threads);
  std::vector<Marked> marked(cloud.tiles.size());
  for_each_index(marked.size(), threads, [&](std::size_t tile) { marked[tile] = air.alone(tile); });
  std::map<Block, std::vector<char>> hazy;
  for (const auto& [block, alone] : profiles_of(cloud, air, marked))
    hazy[block] = hazy_slabs(alone);
  for (std::size_t tile = 0; tile < marked.size(); ++tile) {
    const auto slabs = hazy.find(air.block_of(tile));
    std::erase_if(marked[tile], [&](std::size_t i) {
      const std::ptrdiff_t slab = air.slab_of(tile, cloud.points[i]);
      return !air.holds(slab) || !slabs->second[static_cast<std::size_t>(slab)];
    });
  }
  return take_out(cloud, marked);
}

}  // namespace plotscan::cloud
