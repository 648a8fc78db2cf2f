// SPDX-License-Identifier: Apache-2.0
#include "ground/internal/bare_noise.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <Eigen/Dense>

#include "core/statistics.h"

namespace plotscan::ground {
namespace {

constexpr double kLeastReturns = 16;  // of a block: the spread of fewer is mostly chance

// The returns of some columns, east and north of the first one's node, in cells.
class Block {
 public:
  void add(const Return& r, int columns_east, int rows_north) {
    if (count_ == 0) z0_ = r.z_m;
    const Eigen::Vector3d row(1, columns_east + r.east(), rows_north + r.north());
    const double z = r.z_m - z0_;
    normal_ += row * row.transpose();
    right_ += row * z;
    squares_ += z * z;
    ++count_;
  }
  std::size_t count() const { return count_; }

  // Sigma about the least-squares plane by which its 20th percentile over blocks is unbiased;
  // negative where that is not defined.
  double spread() const {
    const Eigen::LDLT<Eigen::Matrix3d> factors(normal_);
    if (factors.vectorD().minCoeff() < 1e-3) return -1;
    const double rest = squares_ - right_.dot(factors.solve(right_));
    const double freedom = static_cast<double>(count_) - 3;
    // Where a fifth of the blocks with this sigma are expected (normal approximation).
    const double low = 1 - 0.84 / std::sqrt(2 * freedom);
    return std::sqrt(std::max(0.0, rest / freedom)) / low;
  }

 private:
  Eigen::Matrix3d normal_ = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right_ = Eigen::Vector3d::Zero();
  double squares_ = 0;
  double z0_ = 0;
  std::size_t count_ = 0;
};

// Returns in the column where the middle one of all returns lies.
double usual_count(const Columns& columns) {
  std::vector<std::uint32_t> counts;
  for (std::size_t i = 0; i < columns.grid.nodes(); ++i) {
    counts.push_back(columns.first[i + 1] - columns.first[i]);
  }
  return self_weighted_median(std::move(counts));
}

// How many columns a block is wide, so that usual ones have enough returns.
int block_width(double usual_returns, double cell_m) {
  constexpr double kWidest_m = 0.8;  // bare alleys are about as wide
  const int most = std::max(1, static_cast<int>(kWidest_m / cell_m));
  int width = 1;
  while (width < most && usual_returns * width * width < kLeastReturns) ++width;
  return width;
}

Block block_at(const Columns& columns, int column, int row, int width) {
  const Grid& grid = columns.grid;
  Block block;
  for (int r = row; r < std::min(grid.rows, row + width); ++r)
    for (int c = column; c < std::min(grid.columns, column + width); ++c)
      for (const Return& here : columns.at(grid.index(c, r))) block.add(here, c - column, r - row);
  return block;
}

}  // namespace

double bare_noise_m(const Columns& columns) {
  constexpr double kPercentile = 0.2;
  // In a large sparse field only chance fills some blocks, with canopy as likely as with ground.
  constexpr std::size_t kLeastBlocks = 30;
  constexpr double kUsual_m = 0.03;
  constexpr std::size_t kEveryBlock = 3;  // is looked at
  const double usual = usual_count(columns);
  const int width = block_width(usual, columns.grid.cell_m);
  // As dense as where most returns lie: far away the beams come in flat, and see the ground with
  // less noise in height.
  const double enough = std::max(kLeastReturns, 0.5 * usual * width * width);
  std::vector<double> spreads;
  std::size_t number = 0;
  for (int row = 0; row < columns.grid.rows; row += width) {
    for (int column = 0; column < columns.grid.columns; column += width) {
      if (number++ % kEveryBlock != 0) continue;
      const Block block = block_at(columns, column, row, width);
      if (static_cast<double>(block.count()) < enough) continue;
      const double spread = block.spread();
      if (spread >= 0) spreads.push_back(spread);
    }
  }
  if (spreads.size() < kLeastBlocks) return kUsual_m;
  const auto place = static_cast<std::size_t>(kPercentile * spreads.size());
  return std::max(kLeastNoise_m, selected<double>(spreads, place));
}

}  // namespace plotscan::ground
