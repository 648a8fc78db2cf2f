// SPDX-License-Identifier: Apache-2.0
#pragma once

// What stands on each square metre of a field.

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace plotscan::plots {

// The rectangle about all finite points; empty where there are none.
Eigen::AlignedBox2f extent_of_finite(std::span<const Eigen::Vector3f> points);

// The share of a place's returns from which something may stand there: a tenth, or of seedlings a
// quarter of the share where half of all canopy has less, but a fiftieth. `covers` are shares of
// places alike.
double least_cover(const std::vector<double>& covers);

// What the returns of a block say of it.
struct BlockFacts {
  bool seldom_seen = false;  // less than a tenth of the usual density: the survey's margin
  bool stands_out = false;   // something stands on the ground:
  double cover = 0;          // share of the returns that are of it,
  bool surface = false;      // smooth, as walls and roofs are; else it may be canopy,
  double top_m = 0;          // nine tenths of whose returns are lower than this,
  double highest_m = 0;      // and all lower than this
};

// A field's points (x, y, height above the ground), metres, in blocks 1 m wide; wider on fields of
// over 26 ha.
class FieldBlocks {
 public:
  // noise_m is the sigma of the points' heights.
  FieldBlocks(std::span<const Eigen::Vector3f> points, double noise_m, int threads);

  const std::vector<BlockFacts>& facts() const { return facts_; }
  // The number of a finite point's block, or of its cell, of which per_side lie along a block's
  // side; those that follow each other along y have consecutive numbers.
  std::size_t number_of(const Eigen::Vector3f& point, int per_side = 1) const {
    const Eigen::Vector2d at = (point.head<2>().cast<double>() - low_) * per_side / block_m_;
    return static_cast<std::size_t>(at.x()) * along_y_ * static_cast<std::size_t>(per_side) +
           static_cast<std::size_t>(at.y());
  }
  Eigen::Vector2d middle_of(std::size_t number, int per_side = 1) const;
  // Whether the cell at a place, 5 cm wide in blocks of 1 m, has returns; those of a survey's
  // margin do not count.
  bool is_scanned(const Eigen::Vector2d& place) const;
  // The height of the lowest returns that count as no ground.
  double low_m() const { return low_m_; }
  // The heights that the crop may have, most likely first: that below which half of the volume has
  // its top. Where much of the area stands lower than half of it, trees or buildings may stand
  // there, and the same is taken of what is lower. Empty where nothing stands out.
  std::vector<double> crop_tops_m() const;
  // Which blocks are covered all over, or lie beside such: a crop that is sown without gaps, as
  // around many trials, or plots whose gaps leaves close. Squares of 4 m first, 64 m2 of them
  // together, then these and what follows on from them. Where several such patches lie apart, the
  // same of the largest one alone: the others may be such plots. Empty where there are no such
  // squares.
  std::vector<std::vector<bool>> closed() const;
  // On how many square metres of these blocks, something stands.
  double covered_m2(const std::vector<bool>& blocks) const;
  // Calls use(number) for a block and those beside it.
  template <typename Use>
  void for_each_about(std::size_t number, const Use& use) const {
    const std::size_t along_x = facts_.size() / along_y_;
    const std::size_t x = number / along_y_, y = number % along_y_;
    for (std::size_t near_x = x > 0 ? x - 1 : 0; near_x < std::min(x + 2, along_x); ++near_x)
      for (std::size_t near_y = y > 0 ? y - 1 : 0; near_y < std::min(y + 2, along_y_); ++near_y)
        use(near_x * along_y_ + near_y);
  }

 private:
  struct Block;

  std::size_t lay_out(std::span<const Eigen::Vector3f> points);
  std::vector<Block> filled(std::span<const Eigen::Vector3f> points, std::size_t count,
                            double canopy_m) const;
  std::vector<bool> in_closed_squares(double well_covered) const;
  template <typename MayBe>
  void spread(std::vector<std::size_t>& found, std::vector<bool>& marked,
              const MayBe& may_be) const;
  std::vector<std::vector<std::size_t>> large_patches(const std::vector<bool>& closed) const;
  std::vector<bool> marked_in(std::span<const std::vector<std::size_t>> patches) const;
  std::vector<bool> followed_on(std::vector<bool> closed, double least_cover) const;
  std::vector<bool> with_beside(const std::vector<bool>& closed) const;

  void mark_scanned(std::span<const Eigen::Vector3f> points);

  Eigen::Vector2d low_ = Eigen::Vector2d::Zero();
  double block_m_ = 1, low_m_ = 0;
  std::size_t along_y_ = 0;
  std::vector<BlockFacts> facts_;
  std::vector<bool> scanned_;  // by cell
};

}  // namespace plotscan::plots
