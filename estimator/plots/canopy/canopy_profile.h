// SPDX-License-Identifier: Apache-2.0
#pragma once

// How high the canopy stands along a line, and how sure that is.

#include <cstddef>
#include <span>
#include <vector>

#include "plots/canopy/row_view.h"

namespace plotscan::plots {

// Mean canopy by cell along a view's r, over the cells across it. Weights are inverse variances of
// the means, estimated from how the blocks across differ, without their own trend. Neighbouring
// cells see the same leaves, which lowers their weights.
struct CanopyProfile {
  std::vector<double> mean, weight;
  double independent = 0;  // how many independent cells the profile is worth
};

// The profile over the given bands of c only.
CanopyProfile profile_along_r(const RowView& view, std::span<const Band> across);

// Sums over a profile's cells in constant time.
class ProfileSums {
 public:
  explicit ProfileSums(const CanopyProfile& profile);

  int cells() const { return static_cast<int>(up_to_.size()) - 1; }
  // Weighted mean over the cells [begin, end); 0 where none was seen.
  double mean(int begin, int end) const {
    const Sums sums = over(begin, end);
    return sums.weight > 0 ? sums.y / sums.weight : 0;
  }
  // The highest mean over so many cells.
  double highest_mean(int width) const;
  // Where the canopy over the cells has its middle.
  double centroid(int begin, int end) const;
  // Weighted squares about a level, and about a line that leads from one level at the beginning of
  // the cells to another at their end.
  double squares(int begin, int end, double level) const {
    return squares(over(begin, end), level);
  }
  double squares(int begin, int end, double from, double to) const {
    if (begin >= end) return 0;
    const Sums sums = over(begin, end);
    const double slope = (to - from) / (end - begin), start = from - slope * begin;
    return squares(sums, start) - 2 * slope * sums.xy + 2 * start * slope * sums.x +
           slope * slope * sums.xx;
  }

  // Cells without a band, the level next to it, and what they cost.
  struct Stretch {
    double level = 0;
    double misfit = 0;
  };
  // Of one level.
  Stretch even(int begin, int end) const {
    const Sums sums = over(begin, end);
    const double level = sums.weight > 0 ? sums.y / sums.weight : 0;
    return {level, sums.yy - level * sums.y};
  }
  // From the line's begin to a cell, and from a cell to the line's end: of one level too, or,
  // once the ends are free, of anything.
  Stretch until(int end) const;
  Stretch from(int begin) const;
  // From now on, the line's ends are made of pieces, each with a level of its own, at a price for
  // each but the outermost (optimal partitioning: Jackson et al., IEEE Signal Processing Letters
  // 12, 2005). Their edges are coarse, every 8 cells.
  void free_ends(double piece_price);

 private:
  // Weighted sums over cells: of x, a cell's middle, and y, the canopy there.
  struct Sums {
    double weight = 0, y = 0, yy = 0, x = 0, xx = 0, xy = 0;
  };
  static double squares(const Sums& sums, double level) {
    return sums.yy - 2 * level * sums.y + level * level * sums.weight;
  }
  Sums over(int begin, int end) const {
    const Sums &low = up_to_[static_cast<std::size_t>(begin)],
               &high = up_to_[static_cast<std::size_t>(end)];
    return {.weight = high.weight - low.weight,
            .y = high.y - low.y,
            .yy = high.yy - low.yy,
            .x = high.x - low.x,
            .xx = high.xx - low.xx,
            .xy = high.xy - low.xy};
  }

  std::vector<Sums> up_to_;           // by cell: over all before it
  std::vector<double> until_, from_;  // by cell: misfit of free ends; empty where they are even
};

}  // namespace plotscan::plots
