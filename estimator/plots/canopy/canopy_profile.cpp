// SPDX-License-Identifier: Apache-2.0
#include "plots/canopy/canopy_profile.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace plotscan::plots {
namespace {

// All values are our choice.
constexpr double kBlock_m = 0.5;   // across the line: as wide as plants, that differ by chance
constexpr double kTrend_m = 0.75;  // on either side: a block's own trend, which is no noise
// Cells, from one place to the next where a free end may break. Coarse: with exact edges it would
// explain plots as well as bands do.
constexpr int kPiece = 8;
constexpr int kBeside = 4;            // cells next to a band that have the level beside it
constexpr double kLeastError = 0.02;  // of the profile's greatest mean: no model is better

// Mean over what the cells within reach hold, each a sum of counts[i] values.
std::vector<double> smoothed(const std::vector<double>& values, const std::vector<double>& counts,
                             int reach) {
  const int cells = static_cast<int>(values.size());
  std::vector<double> sum(values.size() + 1), count(sum), smooth(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    sum[i + 1] = sum[i] + values[i];
    count[i + 1] = count[i] + counts[i];
  }
  for (int i = 0; i < cells; ++i) {
    const auto low = static_cast<std::size_t>(std::max(0, i - reach));
    const auto high = static_cast<std::size_t>(std::min(cells, i + reach + 1));
    smooth[static_cast<std::size_t>(i)] =
        (sum[high] - sum[low]) / std::max(1.0, count[high] - count[low]);
  }
  return smooth;
}

// A block's canopy along the line minus the profile and the block's own trend.
std::vector<double> noise_of(const std::vector<double>& block, const std::vector<double>& seen,
                             const std::vector<double>& mean, int trend) {
  std::vector<double> noise(block.size());
  for (std::size_t i = 0; i < block.size(); ++i) noise[i] = seen[i] > 0 ? block[i] - mean[i] : 0;
  const std::vector<double> own = smoothed(noise, seen, trend);
  for (std::size_t i = 0; i < block.size(); ++i) noise[i] -= seen[i] > 0 ? own[i] : 0;
  return noise;
}

// Variance of sums over neighbouring cells, over the variance if the cells were independent.
double likeness(const std::vector<std::vector<double>>& noises, int near) {
  double single = 0, together = 0;
  for (const std::vector<double>& noise : noises) {
    for (std::size_t i = 0; i + static_cast<std::size_t>(near) <= noise.size();
         i += static_cast<std::size_t>(near)) {
      double sum = 0;
      for (std::size_t k = i; k < i + static_cast<std::size_t>(near); ++k) {
        sum += noise[k];
        single += noise[k] * noise[k];
      }
      together += sum * sum;
    }
  }
  return single > 0 ? std::max(1.0, together / single) : 1;
}

// Canopy along the line in strips as wide as plants.
struct Blocks {
  std::vector<std::vector<double>> canopy, seen;  // by strip, then by cell
  std::vector<double> sum, count;                 // over the strips that see a cell

  explicit Blocks(std::size_t cells) : sum(cells), count(cells) {}

  void add(const RowView& view, const Band& strip) {
    std::vector<double> block(sum.size()), sees(sum.size());
    for (std::size_t i = 0; i < sum.size(); ++i) {
      const int r = static_cast<int>(i);
      if (view.seen_cells(r, r + 1, strip.begin, strip.end) == 0) continue;
      sees[i] = 1;
      block[i] = view.cover(r, r + 1, strip.begin, strip.end);
      sum[i] += block[i];
      count[i] += 1;
    }
    canopy.push_back(std::move(block));
    seen.push_back(std::move(sees));
  }
};

Blocks blocks_of(const RowView& view, std::span<const Band> across, int width) {
  Blocks blocks(static_cast<std::size_t>(view.r_cells()));
  for (const Band& band : across)
    for (const Band& part : equal_parts(band, std::max(1, band.size() / width)))
      blocks.add(view, part);
  return blocks;
}

}  // namespace

CanopyProfile profile_along_r(const RowView& view, std::span<const Band> across) {
  const auto in_cells = [&](double length_m) {
    return std::max(1, static_cast<int>(std::lround(length_m / view.cell_m())));
  };
  Blocks blocks = blocks_of(view, across, in_cells(kBlock_m));
  const std::size_t cells = blocks.sum.size();
  CanopyProfile profile{.mean = blocks.sum, .weight = std::vector<double>(cells)};
  for (std::size_t i = 0; i < cells; ++i) profile.mean[i] /= std::max(1.0, blocks.count[i]);
  std::vector<double> variance(cells);
  for (std::size_t k = 0; k < blocks.canopy.size(); ++k) {
    blocks.canopy[k] = noise_of(blocks.canopy[k], blocks.seen[k], profile.mean, in_cells(kTrend_m));
    for (std::size_t i = 0; i < cells; ++i)
      variance[i] += blocks.canopy[k][i] * blocks.canopy[k][i];
  }
  variance = smoothed(variance, blocks.count, in_cells(kLeaf_m));
  const double alike = likeness(blocks.canopy, in_cells(kLeaf_m));
  const double least = cells > 0 ? kLeastError * *std::ranges::max_element(profile.mean) : 0;
  for (std::size_t i = 0; i < cells; ++i) {
    if (blocks.count[i] == 0) continue;
    profile.weight[i] =
        1 / (alike * (variance[i] / blocks.count[i] + std::max(1e-12, least * least)));
    profile.independent += 1 / alike;
  }
  return profile;
}

ProfileSums::ProfileSums(const CanopyProfile& profile) : up_to_(1) {
  up_to_.reserve(profile.mean.size() + 1);
  Sums sums;
  for (std::size_t i = 0; i < profile.mean.size(); ++i) {
    const double w = profile.weight[i], y = profile.mean[i], x = static_cast<double>(i) + 0.5;
    sums.weight += w;
    sums.y += w * y;
    sums.yy += w * y * y;
    sums.x += w * x;
    sums.xx += w * x * x;
    sums.xy += w * x * y;
    up_to_.push_back(sums);
  }
}

double ProfileSums::highest_mean(int width) const {
  double most = 0;
  for (int i = 0; i + width <= cells(); ++i) most = std::max(most, mean(i, i + width));
  return most;
}

double ProfileSums::centroid(int begin, int end) const {
  const Sums sums = over(begin, end);
  return sums.y > 0 ? sums.xy / sums.y : 0.5 * (begin + end);
}

void ProfileSums::free_ends(double piece_price) {
  until_.assign(up_to_.size(), 0);
  from_ = until_;
  for (int end = 0; end <= cells(); ++end) {
    double least = even(0, end).misfit;
    for (int begin = kPiece; begin < end; begin += kPiece) {
      const double before = until_[static_cast<std::size_t>(begin)] + piece_price;
      least = std::min(least, before + even(begin, end).misfit);
    }
    until_[static_cast<std::size_t>(end)] = least;
  }
  for (int begin = cells(); begin >= 0; --begin) {
    double least = even(begin, cells()).misfit;
    for (int end = kPiece * ((begin / kPiece) + 1); end < cells(); end += kPiece) {
      const double after = from_[static_cast<std::size_t>(end)] + piece_price;
      least = std::min(least, even(begin, end).misfit + after);
    }
    from_[static_cast<std::size_t>(begin)] = least;
  }
}

ProfileSums::Stretch ProfileSums::until(int end) const {
  if (until_.empty()) return even(0, end);
  return {mean(std::max(0, end - kBeside), end), until_[static_cast<std::size_t>(end)]};
}

ProfileSums::Stretch ProfileSums::from(int begin) const {
  if (from_.empty()) return even(begin, cells());
  return {mean(begin, std::min(cells(), begin + kBeside)), from_[static_cast<std::size_t>(begin)]};
}

}  // namespace plotscan::plots
