// SPDX-License-Identifier: Apache-2.0
#include "cloud/internal/outliers.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "core/contains.h"
#include "core/each_index.h"

namespace plotscan::cloud {
namespace {

constexpr double kSlab_m = 0.5;
constexpr double kLonelyMargin_m = 0.5;
constexpr std::size_t kLonelyPoints = 4;
constexpr double kLonelyShare = 0.002;
constexpr int kSupportReach = 1;  // tiles to each side, and slabs
constexpr int kExtentReach = 7;   // tiles to each side
constexpr double kNowhere = std::numeric_limits<double>::infinity();

int slab_of(double z_m) { return static_cast<int>(std::floor(z_m / kSlab_m)); }

// The points of a field as columns of slabs over its tiles.
class Columns {
 public:
  Columns(const TiledPoints& cloud, int threads)
      : cloud_(cloud), threads_(threads), rows_(cloud.tiles) {
    for (const double level : tile_levels(cloud, rows_, threads))
      first_slab_.push_back(slab_of(level - kFarthest_m));
    count_slabs();
  }

  // The tile's points that are outliers.
  Marked outliers(std::size_t tile) const {
    const std::vector<char> lonely = lonely_slabs(tile);
    const bool any_lonely = contains(lonely, 1);
    if (!any_lonely && within_[tile] == cloud_.size(tile)) return {};
    const Extent extent = any_lonely ? extent_around(tile) : Extent{};
    const double low_m = extent.low_m - kLonelyMargin_m;
    const double high_m = extent.high_m + kLonelyMargin_m;
    Marked result;
    for (std::size_t i = cloud_.begin[tile]; i < cloud_.begin[tile + 1]; ++i) {
      const double z_m = cloud_.points[i].z();
      const std::optional<std::size_t> slab = slab_in(tile, z_m);
      if (!slab || (lonely[*slab] && (z_m < low_m || z_m > high_m))) result.push_back(i);
    }
    return result;
  }

  // Calls work(tile) for all tiles.
  template <class Work>
  void for_each(const Work& work) const {
    for_each_index(cloud_.tiles.size(), threads_, work);
  }

 private:
  struct Extent {
    double low_m = kNowhere;
    double high_m = -kNowhere;
  };

  // The slab of a point; absent where the point lies too far from the tile's level.
  std::optional<std::size_t> slab_in(std::size_t tile, double z_m) const {
    const int slab = slab_of(z_m) - first_slab_[tile];
    if (slab < 0 || slab >= static_cast<int>(slabs_)) return std::nullopt;
    return static_cast<std::size_t>(slab);
  }

  void count_slabs() {
    slabs_ = static_cast<std::size_t>(std::ceil(2 * kFarthest_m / kSlab_m)) + 1;
    counts_.assign(slabs_ * cloud_.tiles.size(), 0);
    within_.assign(cloud_.tiles.size(), 0);
    for_each([&](std::size_t tile) {
      for (const Eigen::Vector3f& point : cloud_.of(tile)) {
        const auto slab = slab_in(tile, point.z());
        if (!slab) continue;
        ++counts_[tile * slabs_ + *slab];
        ++within_[tile];
      }
    });
  }

  // By slab: whether the tile has points there, and all of them are lonely.
  std::vector<char> lonely_slabs(std::size_t tile) const {
    std::vector<char> result(slabs_, 0);
    for (std::size_t slab = 0; slab < slabs_; ++slab)
      result[slab] = counts_[tile * slabs_ + slab] > 0 && is_lonely(tile, slab);
    return result;
  }

  bool is_lonely(std::size_t tile, std::size_t slab) const {
    std::size_t near = 0;
    std::size_t over = 0;
    const int middle = first_slab_[tile] + static_cast<int>(slab);
    rows_.visit_around(tile, kSupportReach, [&](std::size_t other) {
      over += cloud_.size(other);
      for (int at = middle - kSupportReach; at <= middle + kSupportReach; ++at) {
        const int index = at - first_slab_[other];
        if (index >= 0 && index < static_cast<int>(slabs_))
          near += counts_[other * slabs_ + static_cast<std::size_t>(index)];
      }
    });
    return near <= kLonelyPoints &&
           static_cast<double>(near) <= kLonelyShare * static_cast<double>(over);
  }

  // Lowest and highest height, metres, of the slabs around a tile with points that are not lonely.
  Extent extent_around(std::size_t tile) const {
    Extent extent;
    rows_.visit_around(tile, kExtentReach, [&](std::size_t other) {
      const auto reaches_out = [&](std::size_t slab) {
        return counts_[other * slabs_ + slab] > 0 && !is_lonely(other, slab);
      };
      const auto bottom_m = [&](std::size_t slab) {
        return (first_slab_[other] + static_cast<double>(slab)) * kSlab_m;
      };
      for (std::size_t slab = 0; slab < slabs_ && bottom_m(slab) < extent.low_m; ++slab)
        if (reaches_out(slab)) extent.low_m = bottom_m(slab);
      for (std::size_t slab = slabs_; slab-- > 0 && bottom_m(slab) + kSlab_m > extent.high_m;)
        if (reaches_out(slab)) extent.high_m = bottom_m(slab) + kSlab_m;
    });
    return extent;
  }

  const TiledPoints& cloud_;
  int threads_;
  TileRows rows_;
  std::vector<int> first_slab_;  // of each tile's column
  std::size_t slabs_ = 0;        // of a column
  std::vector<std::uint32_t> counts_;
  std::vector<std::size_t> within_;  // of each tile's points: how many lie in a slab
};

}  // namespace

std::size_t drop_outliers(TiledPoints& cloud, int threads) {
  if (cloud.points.empty()) return 0;
  std::vector<Marked> outliers(cloud.tiles.size());
  {
    const Columns columns(cloud, threads);
    columns.for_each([&](std::size_t tile) { outliers[tile] = columns.outliers(tile); });
  }
  return take_out(cloud, outliers);
}

}  // namespace plotscan::cloud
