// SPDX-License-Identifier: Apache-2.0
#include "ground/internal/bare_noise.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include <Eigen/Dense>

#include "core/list_of.h"
#include "core/statistics.h"

namespace plotscan::ground {
namespace {

constexpr double kLeastReturns = 16;  // of a block: the spread of fewer is mostly chance
constexpr double kPercentile = 0.2;
// In a cloud that is cut to the plots of a closed crop, less than a fifth may be bare. Bare blocks
// scatter up to kBareTimes as much as the lowest hundredth: on 20 fields the 20th percentile is 1.2
// to 1.5 times that where a fifth is bare, and 3 times or more where less is.
constexpr double kSurelyBare = 0.01, kBareTimes = 2;
constexpr double kWidestBare_m = 0.8;  // of a block: bare alleys are about as wide
// In a large sparse field only chance fills some blocks, with canopy as likely as with ground.
constexpr std::size_t kLeastBlocks = 30;

// The value below which a share of them lies.
double lowest_of(std::span<double> values, double share) {
  return selected(values, static_cast<std::size_t>(share * static_cast<double>(values.size())));
}

// The returns of some columns, east and north of the first one's node, in cells.
class Block {
 public:
  void add(const Return& r, int columns_east, int rows_north) {
    if (count_ == 0) {
      z0_ = r.z_m;
      low_m_ = high_m_ = r.z_m;
    }
    low_m_ = std::min(low_m_, r.z_m);
    high_m_ = std::max(high_m_, r.z_m);
    const Eigen::Vector3d row(1, columns_east + r.east(), rows_north + r.north());
    const double z = r.z_m - z0_;
    normal_ += row * row.transpose();
    right_ += row * z;
    squares_ += z * z;
    ++count_;
  }
  std::size_t count() const { return count_; }
  float range_m() const { return high_m_ - low_m_; }

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
  float low_m_ = 0;
  float high_m_ = 0;
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

// Returns in the middle one of the columns that hold any.
double middle_count(const Columns& columns) {
  std::vector<double> counts;
  for (std::size_t i = 0; i < columns.grid.nodes(); ++i) {
    const std::size_t count = columns.at(i).size();
    if (count > 0) counts.push_back(static_cast<double>(count));
  }
  return counts.empty() ? 0 : selected<double>(counts, counts.size() / 2);
}

// How many columns a block is wide, so that usual ones have enough returns.
int block_width(double usual_returns, double cell_m) {
  const int most = std::max(1, static_cast<int>(kWidestBare_m / cell_m));
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

// The spreads of bare blocks in squares of 2 m.
class Squares {
 public:
  Squares(const Grid& grid, const std::vector<BlockSpread>& blocks, double most_range_m)
      : grid_(grid), nodes_(std::max(1, static_cast<int>(std::lround(kSquare_m / grid.cell_m)))) {
    squares_ = {.columns = grid.columns / nodes_ + 1, .rows = grid.rows / nodes_ + 1};
    spreads_.resize(squares_.nodes());
    for (const BlockSpread& block : blocks)
      if (block.range_m <= most_range_m) spreads_[of(block.node)].push_back(block.sigma_m);
  }

  std::size_t count() const { return spreads_.size(); }
  std::size_t of(std::size_t node) const {
    const std::size_t column = node % grid_.columns / nodes_;
    return node / grid_.columns / nodes_ * squares_.columns + column;
  }
  // The noise in a square and those around it; nothing where too little is bare.
  std::optional<double> noise_m(std::size_t square) const {
    const int column = static_cast<int>(square) % squares_.columns,
              row = static_cast<int>(square) / squares_.columns;
    std::vector<double> around;
    for_around(squares_, column, row, 1, [&](std::size_t near) {
      around.insert(around.end(), spreads_[near].begin(), spreads_[near].end());
    });
    if (around.size() < kLeastBlocks) return std::nullopt;
    return lowest_of(around, kPercentile);
  }

 private:
  static constexpr double kSquare_m = 2;
  const Grid& grid_;
  int nodes_ = 1;  // of a square's side
  Grid squares_;
  std::vector<std::vector<double>> spreads_;
};

std::vector<BlockSpread> spreads_at(const Columns& columns, double usual) {
  constexpr std::size_t kEveryBlock = 3;  // is looked at
  const int width = block_width(usual, columns.grid.cell_m);
  // As dense as where most returns lie: far away the beams come in flat, and see the ground with
  // less noise in height.
  const double enough = std::max(kLeastReturns, 0.5 * usual * width * width);
  std::vector<BlockSpread> spreads;
  std::size_t number = 0;
  for (int row = 0; row < columns.grid.rows; row += width) {
    for (int column = 0; column < columns.grid.columns; column += width) {
      if (number++ % kEveryBlock != 0) continue;
      const Block block = block_at(columns, column, row, width);
      if (static_cast<double>(block.count()) < enough) continue;
      const double spread = block.spread();
      if (spread < 0) continue;
      spreads.push_back({.node = columns.grid.index(column, row),
                         .width_m = width * columns.grid.cell_m,
                         .sigma_m = spread,
                         .range_m = block.range_m()});
    }
  }
  return spreads;
}

}  // namespace

std::vector<BlockSpread> block_spreads(const Columns& columns) {
  constexpr double kNoSensor_m = 0.1;    // scatters so much
  constexpr double kFineCells_m = 0.25;  // ground bends in wider ones
  std::vector<BlockSpread> dense = spreads_at(columns, usual_count(columns));
  if (bare_noise_m(dense) <= kNoSensor_m || columns.grid.cell_m > kFineCells_m) return dense;
  std::vector<BlockSpread> usual = spreads_at(columns, middle_count(columns));
  return bare_noise_m(usual) < bare_noise_m(dense) ? usual : dense;
}

double bare_noise_m(const std::vector<BlockSpread>& blocks) {
  constexpr double kUsual_m = 0.03;
  if (blocks.size() < kLeastBlocks) return kUsual_m;
  std::vector<double> spreads = list_of(blocks, &BlockSpread::sigma_m);
  const double most_m = kBareTimes * lowest_of(spreads, kSurelyBare);
  double noise_m = lowest_of(spreads, kPercentile);
  if (noise_m > most_m && blocks.front().width_m <= kWidestBare_m) {  // fewer are bare
    std::erase_if(spreads, [&](double sigma_m) { return sigma_m > most_m; });
    noise_m = lowest_of(spreads, kPercentile);
  }
  return std::max(kLeastNoise_m, noise_m);
}

Field noise_excess_m(const Grid& grid, const std::vector<BlockSpread>& blocks, double noise_m) {
  constexpr double kWidestBlock_m = 0.5;  // ground bends in wider ones
  constexpr double kMostRange = 12;       // of bare ground, in sigmas: two layers 6 sigma apart
  constexpr double kClear = 1.3;          // other fields' squares reach 1.13
  constexpr double kLeast_m = 0.02;       // clods and furrows do as much
  Field excess_m(grid.nodes(), 0);
  if (blocks.empty() || blocks.front().width_m > kWidestBlock_m) return excess_m;
  const Squares squares(grid, blocks, kMostRange * noise_m);
  std::vector<float> of_square(squares.count(), 0);
  for (std::size_t i = 0; i < squares.count(); ++i) {
    const double here_m = squares.noise_m(i).value_or(0);
    if (here_m < kClear * noise_m) continue;
    const double more_m = std::sqrt(here_m * here_m - noise_m * noise_m);
    if (more_m >= kLeast_m) of_square[i] = static_cast<float>(more_m);
  }
  for (std::size_t i = 0; i < grid.nodes(); ++i) excess_m[i] = of_square[squares.of(i)];
  return excess_m;
}

}  // namespace plotscan::ground
