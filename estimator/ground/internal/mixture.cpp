// SPDX-License-Identifier: Apache-2.0
#include "ground/internal/mixture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "ground/internal/pool.h"

namespace plotscan::ground {
namespace {

constexpr int kPooledAround = 2;  // cells on either side over which shares are pooled

// Uncertainty of the canopy's density near the ground: it moves the ground's peak by this share of
// a sigma at a contrast of one.
constexpr float kDoubt = 0.3f;

// Counts of returns by height above the surface, in sigmas.
struct Counts {
  Field below;  // under -3
  Field about;  // -2 to 2
  Field low;    // 2.5 to 5
  Field mid;    // 5 to 10
  Field all;
};

// Standard normal density and distribution, by table.
class Normal {
 public:
  Normal() {
    for (int i = 0; i < kSize; ++i) {
      const double x = (i - kMiddle) / kPerSigma;
      density_[i] = static_cast<float>(0.3989422804 * std::exp(-0.5 * x * x));
      share_[i] = static_cast<float>(0.5 * std::erfc(-x * 0.7071067812));
    }
  }
  float density(float x) const { return density_[index(x)]; }
  float share_below(float x) const { return share_[index(x)]; }

 private:
  static constexpr double kPerSigma = 64;
  static constexpr int kSize = 1024;
  static constexpr int kMiddle = kSize / 2;
  static int index(float x) {
    const float nearest = x * static_cast<float>(kPerSigma) + kMiddle + 0.5f;  // truncated
    return std::clamp(static_cast<int>(nearest), 0, kSize - 1);
  }
  std::array<float, kSize> density_{};
  std::array<float, kSize> share_{};
};

const Normal kNormal;

// The bilinear surface within a column.
struct Patch {
  Patch(const Grid& grid, const Field& s, int column, int row) {
    const int west = std::max(0, column - 1);
    const int east = std::min(grid.columns - 1, column + 1);
    const int south = std::max(0, row - 1);
    const int north = std::min(grid.rows - 1, row + 1);
    z = s[grid.index(column, row)];
    rise_west = z - s[grid.index(west, row)];
    rise_east = s[grid.index(east, row)] - z;
    rise_south = z - s[grid.index(column, south)];
    rise_north = s[grid.index(column, north)] - z;
  }
  // Heights of returns above it, in sigmas.
  void above(std::span<const Return> returns, float noise, std::vector<float>& heights) const {
    heights.resize(returns.size());
    for (std::size_t k = 0; k < returns.size(); ++k) {
      const float e = returns[k].east();
      const float n = returns[k].north();
      heights[k] = (returns[k].z_m - z - e * (e > 0 ? rise_east : rise_west) -
                    n * (n > 0 ? rise_north : rise_south)) /
                   noise;
    }
  }
  float z, rise_west, rise_east, rise_south, rise_north;
};

Counts count(const Columns& columns, const Field& surface, float noise) {
  const Grid& grid = columns.grid;
  Counts counts{.below = Field(grid.nodes()),
                .about = Field(grid.nodes()),
                .low = Field(grid.nodes()),
                .mid = Field(grid.nodes()),
                .all = Field(grid.nodes())};
  for_rows(grid, [&](int row) {
    std::vector<float> heights;
    for (int column = 0; column < grid.columns; ++column) {
      const std::size_t i = grid.index(column, row);
      Patch(grid, surface, column, row).above(columns.at(i), noise, heights);
      int below = 0, about = 0, low = 0, mid = 0;
      for (const float x : heights) {  // vector instructions: no branch
        below += static_cast<int>(x < -3) & static_cast<int>(x > -20);
        about += static_cast<int>(std::abs(x) <= 2);
        low += static_cast<int>(x > 2.5f) & static_cast<int>(x <= 5);
        mid += static_cast<int>(x > 5) & static_cast<int>(x <= 10);
      }
      counts.below[i] = static_cast<float>(below);
      counts.about[i] = static_cast<float>(about);
      counts.low[i] = static_cast<float>(low);
      counts.mid[i] = static_cast<float>(mid);
      counts.all[i] = static_cast<float>(columns.at(i).size());
    }
  });
  for (Field* field : {&counts.below, &counts.about, &counts.low, &counts.mid, &counts.all}) {
    pool(grid, kPooledAround, *field);
  }
  return counts;
}

// Ground and canopy around a node, returns a sigma of height.
struct Shares {
  float ground = 0;         // returns in all
  float canopy = 0;         // density at the surface
  float canopy_growth = 0;  // of the density, a sigma
  float contrast = 0;       // of the ground's peak to the canopy right above
  float support = 0;
};

Shares shares_at(const Counts& counts, std::size_t i) {
  Shares shares;
  const float low = std::max(0.0f, counts.low[i] - 0.0062f * counts.about[i]) / 2.5f;
  const float mid = counts.mid[i] / 5;
  shares.canopy = std::clamp(low - (mid - low), 0.0f, 1.5f * low);
  shares.canopy_growth = (low - shares.canopy) / 3.75f;
  shares.ground = std::max(0.0f, (counts.about[i] - 2 * shares.canopy) / 0.954f);
  const float peak = 0.4f * shares.ground;
  shares.contrast = peak / (low + 0.5f);
  const float balance = counts.about[i] / (counts.about[i] + 4 * counts.below[i] + 1);
  shares.support = std::clamp((shares.contrast - 0.8f) / 0.8f, 0.0f, 1.0f) * balance;
  return shares;
}

// How well a column's ground returns agree with what the columns around it predict: a surface that
// cuts off a ridge misses those of its own column, though the columns around support it.
float agreement(float found, float expected) {
  constexpr float kFew = 5;
  if (expected < kFew) return 1;
  return std::clamp((found / expected - 0.1f) / 0.3f, 0.0f, 1.0f);
}

// Keeps the heights at which ground may be, in their order. Written without a branch, as heights
// come in any order.
void keep_near(std::vector<float>& heights) {
  constexpr float kFarthest = 4;
  std::size_t count = 0;
  for (const float x : heights) {
    heights[count] = x;
    count += static_cast<std::size_t>(std::abs(x) <= kFarthest);
  }
  heights.resize(count);
}

}  // namespace

Evidence weigh(const Columns& columns, const Field& surface, double noise_m) {
  const Grid& grid = columns.grid;
  const auto noise = static_cast<float>(noise_m);
  const Counts counts = count(columns, surface, noise);
  Evidence evidence{.target_m = surface,
                    .data = Field(grid.nodes()),
                    .doubt_m = Field(grid.nodes()),
                    .support = Field(grid.nodes())};
  for_rows(grid, [&](int row) {
    std::vector<float> heights;
    for (int column = 0; column < grid.columns; ++column) {
      const std::size_t i = grid.index(column, row);
      const Shares shares = shares_at(counts, i);
      evidence.support[i] = shares.support;
      evidence.doubt_m[i] = kDoubt * noise / std::max(shares.contrast, 0.5f);
      if (shares.support <= 0) continue;
      const float floor = 0.002f * shares.ground;
      Patch(grid, surface, column, row).above(columns.at(i), noise, heights);
      keep_near(heights);
      float sum = 0, moment = 0, missing = 0;
      for (const float x : heights) {
        const float ground = shares.ground * kNormal.density(x);
        const float canopy =
            std::max(0.0f, shares.canopy + shares.canopy_growth * x) * kNormal.share_below(x);
        const float p = ground / (ground + canopy + floor);
        sum += p;
        moment += p * x;
        missing += p * (1 - p) * x * x;
      }
      evidence.support[i] *=
          agreement(sum, shares.ground * static_cast<float>(columns.at(i).size()) / counts.all[i]);
      const float information = std::max(sum - missing, 0.3f * sum);
      if (information <= 0) continue;
      evidence.target_m[i] += noise * std::clamp(moment / information, -2.0f, 2.0f);
      evidence.data[i] = evidence.support[i] * information / (noise * noise);
    }
  });
  return evidence;
}

}  // namespace plotscan::ground
