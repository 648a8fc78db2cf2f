// SPDX-License-Identifier: Apache-2.0
#include "plots/canopy/field_blocks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numeric>
#include <utility>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "core/statistics.h"
#include "plots/canopy/patch.h"

namespace plotscan::plots {
namespace {

constexpr double kLeast_m = 0.05;      // lower is no canopy, however little the noise
constexpr double kLeastDensity = 0.1;  // of the usual block's: less is the survey's margin
constexpr double kLeastCover = 0.1, kLeastOfUsualCover = 0.25, kLeastOfSeedlings = 0.02;
constexpr double kBlockTop = 0.9;  // quantile of a block's canopy returns: its top
constexpr std::size_t kMostBlocks = 1 << 18;
constexpr int kMostPatches = 3;          // of a block's side
constexpr double kPatchReturns = 12;     // of the usual patch, at least: fewer lie near some plane
constexpr float kLeastPatchReturns = 4;  // of a patch that is judged
// Canopy scatters more than this many sigmas of the noise; what scatters less is a surface. Beams
// straight down have 1.25 times the noise of the field; roofs and cars: 1.0 in the median; soybeans
// under 5 cm of range noise: 2.1.
constexpr double kSurfaceSigmas = 1.5;
// Of the area that stands out: so much of it, lower than half of the usual top, may be the crop.
constexpr double kLeastLowShare = 0.25;

constexpr std::size_t kClosed_blocks = 4;  // side of a square that is covered all over: no plot's
constexpr double kClosedMean = 0.9, kClosedLeast = 0.7;  // of the well covered blocks' cover
// Of another crop, that hang together. Fewer are a plot or two whose gaps leaves close: 20.
constexpr std::size_t kLeastClosed_blocks = 64;

constexpr int kScannedCells = 20;  // of a block's side

constexpr auto kNoBlock = std::numeric_limits<std::uint32_t>::max();

// Counts of heights in bins 10 % wide.
class HeightCounts {
 public:
  explicit HeightCounts(double least_m) : least_m_(least_m) {}
  void add(double height_m) {
    const double step = std::log(height_m / least_m_) * kPerLog;
    ++counts_[std::min(counts_.size() - 1, static_cast<std::size_t>(std::max(0.0, step)))];
  }
  double count() const { return std::accumulate(counts_.begin(), counts_.end(), 0.0); }
  double quantile(double share) const {
    const double wanted = share * count();
    double below = 0;
    std::size_t step = 0;
    while (step + 1 < counts_.size() && below + counts_[step] < wanted) below += counts_[step++];
    return least_m_ * std::exp((static_cast<double>(step) + 0.5) / kPerLog);
  }

 private:
  static constexpr double kPerLog = 10.5;  // steps a factor e
  double least_m_;
  std::array<std::uint32_t, 64> counts_{};
};

// Number of patches along a block's side with which the usual patch holds enough returns.
std::size_t patches_for(std::span<const std::uint32_t> block_of_point, std::size_t blocks) {
  std::vector<double> counts(blocks);
  for (const std::uint32_t block : block_of_point)
    if (block != kNoBlock) counts[block] += 1;
  std::erase(counts, 0);
  if (counts.empty()) return 1;
  const double most = std::sqrt(quantile(std::move(counts), 0.5) / kPatchReturns);
  return static_cast<std::size_t>(std::clamp(most, 1.0, 1.0 * kMostPatches));
}

}  // namespace

Eigen::AlignedBox2f extent_of_finite(std::span<const Eigen::Vector3f> points) {
  Eigen::AlignedBox2f extent;
  for (const Eigen::Vector3f& point : points)
    if (point.allFinite()) extent.extend(point.head<2>());
  return extent;
}

double least_cover(const std::vector<double>& covers) {
  const double of_usual = kLeastOfUsualCover * self_weighted_median(covers);
  return std::clamp(of_usual, kLeastOfSeedlings, kLeastCover);
}

struct FieldBlocks::Block {
  explicit Block(double canopy_m) : heights(canopy_m) {}
  std::uint32_t count = 0;
  HeightCounts heights;
  std::array<Patch, static_cast<std::size_t>(kMostPatches) * kMostPatches> patches{};

  double cover() const { return heights.count() / std::max(1.0, 1.0 * count); }
  // Most of the patches that stand above the ground scatter no more than noise does.
  bool is_surface(double canopy_m, double noise_m) const {
    int high = 0, smooth = 0;
    for (const Patch& patch : patches) {
      if (patch.count() < kLeastPatchReturns || patch.mean_height() < canopy_m) continue;
      ++high;
      smooth += patch.sd_about_plane() < kSurfaceSigmas * noise_m ? 1 : 0;
    }
    return 2 * smooth > high;
  }
};

// How many blocks cover the points; 0 where no point is finite.
std::size_t FieldBlocks::lay_out(std::span<const Eigen::Vector3f> points) {
  const Eigen::AlignedBox2d extent = extent_of_finite(points).cast<double>();
  if (extent.isEmpty()) return 0;
  low_ = extent.min();
  const auto blocks = [&](int axis) {
    return static_cast<std::size_t>(extent.sizes()[axis] / block_m_) + 1;
  };
  while (blocks(0) * blocks(1) > kMostBlocks) block_m_ *= 2;
  along_y_ = blocks(1);
  return blocks(0) * along_y_;
}

// Each task fills blocks of its own with all of their points, in the points' order.
std::vector<FieldBlocks::Block> FieldBlocks::filled(std::span<const Eigen::Vector3f> points,
                                                    std::size_t count, double canopy_m) const {
  const auto tasks = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
  std::vector<std::uint32_t> block_of_point(points.size());
  tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t i) {
    block_of_point[i] =
        points[i].allFinite() ? static_cast<std::uint32_t>(number_of(points[i])) : kNoBlock;
  });
  const std::size_t patches = patches_for(block_of_point, count);
  const double patch_m = block_m_ / static_cast<double>(patches);
  std::vector<Block> blocks(count, Block(canopy_m));
  tbb::parallel_for(std::size_t{0}, tasks, [&](std::size_t task) {
    const std::size_t begin = task * count / tasks, end = (task + 1) * count / tasks;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (block_of_point[i] < begin || block_of_point[i] >= end) continue;
      const Eigen::Vector3f& point = points[i];
      Block& block = blocks[block_of_point[i]];
      ++block.count;
      if (point.z() > canopy_m) block.heights.add(point.z());
      const Eigen::Vector2d at = (point.head<2>().cast<double>() - low_) / patch_m;
      const Eigen::Vector2d corner(std::floor(at.x()), std::floor(at.y()));
      const Eigen::Vector2f within = ((at - corner) * patch_m).cast<float>();
      block
          .patches[static_cast<std::size_t>(at.x()) % patches * patches +
                   static_cast<std::size_t>(at.y()) % patches]
          .add({within.x(), within.y(), point.z()});
    }
  });
  return blocks;
}

FieldBlocks::FieldBlocks(std::span<const Eigen::Vector3f> points, double noise_m, int threads)
    : low_m_(std::max(kLeast_m, 2 * noise_m)) {
  const std::size_t count = lay_out(points);
  if (count == 0) return;
  const double canopy_m = 1.5 * low_m_;
  tbb::task_arena arena(threads);
  const std::vector<Block> blocks = arena.execute([&] { return filled(points, count, canopy_m); });
  std::vector<double> scanned;
  for (const Block& block : blocks)
    if (block.count > 0) scanned.push_back(block.count);
  const double least = kLeastDensity * quantile(std::move(scanned), 0.5);
  std::vector<double> covers;
  for (const Block& block : blocks)
    if (block.count >= least) covers.push_back(block.cover());
  const double least_share = least_cover(covers);
  for (const Block& block : blocks) {
    const bool canopy = block.count >= least && block.cover() >= least_share;
    facts_.push_back({.seldom_seen = block.count < least,
                      .stands_out = canopy,
                      .cover = block.cover(),
                      .surface = canopy && block.is_surface(canopy_m, noise_m),
                      .top_m = block.heights.quantile(kBlockTop),
                      .highest_m = block.heights.quantile(1)});
  }
  mark_scanned(points);
}

void FieldBlocks::mark_scanned(std::span<const Eigen::Vector3f> points) {
  scanned_.resize(facts_.size() * kScannedCells * kScannedCells);
  for (const Eigen::Vector3f& point : points)
    if (point.allFinite() && !facts_[number_of(point)].seldom_seen)
      scanned_[number_of(point, kScannedCells)] = true;
}

bool FieldBlocks::is_scanned(const Eigen::Vector2d& place) const {
  const Eigen::Array2d blocks = ((place - low_) / block_m_).array();
  const double along_y = static_cast<double>(along_y_);
  const double along_x = static_cast<double>(facts_.size()) / std::max(1.0, along_y);
  if ((blocks < 0).any() || blocks.x() >= along_x || blocks.y() >= along_y) return false;
  const Eigen::Vector3d point(place.x(), place.y(), 0);
  const std::size_t cell = number_of(point.cast<float>(), kScannedCells);
  return cell < scanned_.size() && scanned_[cell];
}

Eigen::Vector2d FieldBlocks::middle_of(std::size_t number, int per_side) const {
  const std::size_t along_y = along_y_ * static_cast<std::size_t>(per_side);
  const std::size_t x = number / along_y, y = number % along_y;
  const Eigen::Array2d corner(static_cast<double>(x), static_cast<double>(y));
  return low_ + block_m_ / per_side * (corner + 0.5).matrix();
}

std::vector<double> FieldBlocks::crop_tops_m() const {
  std::vector<double> left, tops;
  for (const BlockFacts& block : facts_)
    if (block.stands_out && !block.surface) left.push_back(block.top_m);
  while (!left.empty()) {
    // By volume: blocks of low weeds, or of ground to which strips give different heights, may be
    // many.
    tops.push_back(self_weighted_median(left));
    const auto all = static_cast<double>(left.size());
    std::erase_if(left, [&](double top_m) { return top_m > 0.5 * tops.back(); });
    if (static_cast<double>(left.size()) < kLeastLowShare * all) break;
  }
  return tops;
}

std::vector<std::vector<bool>> FieldBlocks::closed() const {
  std::vector<double> covers;
  for (const BlockFacts& block : facts_)
    if (block.stands_out) covers.push_back(block.cover);
  const double well_covered = quantile(std::move(covers), 0.75);
  const std::vector<std::vector<std::size_t>> patches =
      large_patches(in_closed_squares(well_covered));
  std::vector<std::vector<bool>> closed;
  const auto add = [&](std::span<const std::vector<std::size_t>> of_another_crop) {
    const std::vector<bool> squares = marked_in(of_another_crop);
    closed.push_back(with_beside(squares));
    closed.push_back(with_beside(followed_on(squares, kClosedLeast * well_covered)));
  };
  if (!patches.empty()) add(patches);
  if (patches.size() > 1) add({&patches.front(), 1});
  return closed;
}

// Adds to the blocks found those that may be and lie beside them, beside these, and so on, and
// marks them.
template <typename MayBe>
void FieldBlocks::spread(std::vector<std::size_t>& found, std::vector<bool>& marked,
                         const MayBe& may_be) const {
  for (std::size_t i = 0; i < found.size(); ++i) {
    for_each_about(found[i], [&](std::size_t near) {
      if (marked[near] || !may_be(near)) return;
      marked[near] = true;
      found.push_back(near);
    });
  }
}

std::vector<std::vector<std::size_t>> FieldBlocks::large_patches(
    const std::vector<bool>& closed) const {
  std::vector<bool> marked(closed.size());
  std::vector<std::vector<std::size_t>> large;
  for (std::size_t number = 0; number < closed.size(); ++number) {
    if (!closed[number] || marked[number]) continue;
    std::vector<std::size_t> patch = {number};
    marked[number] = true;
    spread(patch, marked, [&](std::size_t near) { return closed[near]; });
    if (patch.size() >= kLeastClosed_blocks) large.push_back(std::move(patch));
  }
  std::ranges::stable_sort(large, std::greater(), &std::vector<std::size_t>::size);
  return large;
}

std::vector<bool> FieldBlocks::marked_in(std::span<const std::vector<std::size_t>> patches) const {
  std::vector<bool> marked(facts_.size());
  for (const std::vector<std::size_t>& patch : patches)
    for (const std::size_t number : patch) marked[number] = true;
  return marked;
}

std::vector<bool> FieldBlocks::followed_on(std::vector<bool> closed, double least_cover) const {
  std::vector<std::size_t> found;
  for (std::size_t number = 0; number < closed.size(); ++number)
    if (closed[number]) found.push_back(number);
  spread(found, closed, [&](std::size_t near) { return facts_[near].cover >= least_cover; });
  return closed;
}

std::vector<bool> FieldBlocks::with_beside(const std::vector<bool>& closed) const {
  std::vector<bool> with = closed;
  for (std::size_t number = 0; number < closed.size(); ++number)
    if (closed[number]) for_each_about(number, [&](std::size_t near) { with[near] = true; });
  return with;
}

double FieldBlocks::covered_m2(const std::vector<bool>& blocks) const {
  std::size_t covered = 0;
  for (std::size_t number = 0; number < blocks.size(); ++number)
    covered += blocks[number] && facts_[number].stands_out ? 1 : 0;
  return static_cast<double>(covered) * block_m_ * block_m_;
}

// Which blocks lie in squares that are covered all over.
std::vector<bool> FieldBlocks::in_closed_squares(double well_covered) const {
  const std::size_t along_x = facts_.size() / std::max<std::size_t>(1, along_y_);
  std::vector<bool> closed(facts_.size());
  std::array<std::size_t, kClosed_blocks * kClosed_blocks> square{};
  for (std::size_t x = 0; x + kClosed_blocks <= along_x; ++x) {
    for (std::size_t y = 0; y + kClosed_blocks <= along_y_; ++y) {
      double sum = 0, least = 1;
      for (std::size_t i = 0; i < square.size(); ++i) {
        square[i] = (x + i / kClosed_blocks) * along_y_ + y + i % kClosed_blocks;
        sum += facts_[square[i]].cover;
        least = std::min(least, facts_[square[i]].cover);
      }
      const double mean = sum / static_cast<double>(square.size());
      if (mean >= kClosedMean * well_covered && least >= kClosedLeast * well_covered)
        for (const std::size_t number : square) closed[number] = true;
    }
  }
  return closed;
}

}  // namespace plotscan::plots
