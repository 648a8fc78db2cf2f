// SPDX-License-Identifier: Apache-2.0
#include "plots/canopy/field_canopy.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "core/statistics.h"

namespace plotscan::plots {
namespace {

constexpr double kTall = 2;  // times the crop's top: no plot of the field grows so tall
constexpr int kCells = 5;    // of a block's side: that of the ground's grid
// Standard error of ground that is too unsure, as a share of the usual canopy's height: heights
// there are known to 12.5 % (95 %). In plots it is 0.05 at most (99 % of the canopy's returns of 44
// farms), on ridges that a ground cuts off 0.04 to 0.3. Where all ground is unsure, as in sparse
// clouds, it must be kUnsureTimes that under the usual canopy.
constexpr double kUnsureShare = 0.0625, kUnsureTimes = 3;

}  // namespace

// Leaves out surfaces and the blocks beside them, which a surface's edge may fill in part.
void FieldCanopy::leave_out_surfaces() {
  for (std::size_t i = 0; i < left_out_.size(); ++i) {
    if (blocks_.facts()[i].surface)
      blocks_.for_each_about(i, [&](std::size_t near) { left_out_[near] = 1; });
  }
}

// What is taller than the crop, and the parts of it in the blocks beside it.
void FieldCanopy::set_tall_blocks_aside() {
  const std::vector<BlockFacts>& facts = blocks_.facts();
  const double tall_m = kTall * scale_.high_m;
  for (std::size_t i = 0; i < aside_.size(); ++i) {
    if (!facts[i].stands_out || facts[i].top_m < tall_m) continue;
    blocks_.for_each_about(i, [&](std::size_t near) {
      if (facts[near].highest_m >= tall_m) aside_[near] = 1;
    });
  }
}

void FieldCanopy::leave_out_unsure_ground(const GroundError& ground_error) {
  std::vector<double> under_canopy;
  for (std::size_t i = 0; i < left_out_.size(); ++i) {
    if (!blocks_.facts()[i].stands_out || blocks_.facts()[i].surface) continue;
    const double error_m = ground_error(blocks_.middle_of(i));
    if (std::isfinite(error_m)) under_canopy.push_back(error_m);
  }
  if (under_canopy.empty()) return;
  const double most_m =
      std::max(kUnsureShare * scale_.high_m, kUnsureTimes * quantile(std::move(under_canopy), 0.5));
  unsure_.resize(left_out_.size() * kCells * kCells);
  tbb::parallel_for(std::size_t{0}, unsure_.size(), [&](std::size_t i) {
    unsure_[i] = ground_error(blocks_.middle_of(i, kCells)) > most_m ? 1 : 0;
  });
}

bool FieldCanopy::leaves_out(const Eigen::Vector3f& point) const {
  return !point.allFinite() || left_out_[blocks_.number_of(point)] != 0 ||
         (!unsure_.empty() && unsure_[blocks_.number_of(point, kCells)] != 0);
}

double FieldCanopy::surface_share(std::span<const Eigen::Vector2d> places, double reach_m) const {
  double all = 0, surfaces = 0;
  for (std::size_t i = 0; i < left_out_.size(); ++i) {
    if (!blocks_.facts()[i].stands_out) continue;
    const Eigen::Vector2d middle = blocks_.middle_of(i);
    const bool near = std::ranges::any_of(places, [&](const Eigen::Vector2d& place) {
      return (place - middle).squaredNorm() < reach_m * reach_m;
    });
    all += near ? 1 : 0;
    surfaces += near && blocks_.facts()[i].surface ? 1 : 0;
  }
  return surfaces / std::max(1.0, all);
}

FieldCanopy::FieldCanopy(std::span<const Eigen::Vector3f> points, const FieldBlocks& blocks,
                         const Crop& crop, int threads, const GroundError& ground_error)
    : blocks_(blocks),
      scale_{.low_m = blocks.low_m(), .high_m = std::max(crop.top_m, 2 * blocks.low_m())},
      aside_(blocks.facts().size()) {
  for (const BlockFacts& block : blocks.facts()) left_out_.push_back(block.seldom_seen);
  leave_out_surfaces();
  std::ranges::copy(crop.others, aside_.begin());
  set_tall_blocks_aside();
  tbb::task_arena arena(threads);
  if (ground_error && crop.top_m > 0) arena.execute([&] { leave_out_unsure_ground(ground_error); });
  kept_.reserve(points.size());
  std::vector<Eigen::Vector3f> aside;
  for (const Eigen::Vector3f& point : points) {
    if (leaves_out(point)) continue;
    (aside_[blocks_.number_of(point)] != 0 ? aside : kept_).push_back(point);
  }
  crop_points_ = kept_.size();
  std::ranges::copy(aside, std::back_inserter(kept_));
}

}  // namespace plotscan::plots
