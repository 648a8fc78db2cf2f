// SPDX-License-Identifier: Apache-2.0
#pragma once

// Where a field is covered by canopy, on a grid along two axes.

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "plots/canopy/field_canopy.h"

namespace plotscan::plots {

// Oblique coordinates (a, b), metres: place = origin + a * a_axis + b * b_axis, with unit axes.
struct Frame {
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();
  Eigen::Vector2d a_axis = Eigen::Vector2d::UnitX();
  Eigen::Vector2d b_axis = Eigen::Vector2d::UnitY();

  Eigen::Matrix2d ab_from_world() const;
  Eigen::Vector2d to_world(const Eigen::Vector2d& ab) const;
};

inline constexpr std::uint32_t kFullCover = 200;  // steps of a cell's cover
inline constexpr std::uint32_t kUnseen = 255;     // in place of the cover of a cell without returns

// The cover of square cells along a frame's axes, as a share of full canopy. Cell (i, j) spans
// [i, i + 1) x [j, j + 1) times cell_m along a and b. Sums over rectangles take constant time
// (summed-area table: Crow, SIGGRAPH 1984).
class CanopyRaster {
 public:
  // `cover` is that of cell (i, j) at i * b_cells + j: 0 to kFullCover, or kUnseen.
  CanopyRaster(const Frame& frame, double cell_m, int a_cells, int b_cells,
               std::span<const std::uint32_t> cover)
      : CanopyRaster(frame, cell_m, a_cells, b_cells,
                     [&](std::size_t cell) { return cover[cell]; }) {}
  // The same of a function of the cell's number.
  template <std::invocable<std::size_t> Cover>
  CanopyRaster(const Frame& frame, double cell_m, int a_cells, int b_cells, const Cover& cover);

  const Frame& frame() const { return frame_; }
  double cell_m() const { return cell_m_; }
  int a_cells() const { return a_cells_; }
  int b_cells() const { return b_cells_; }

  // A summed-area table of the squares of the cells' covers, in units of the squares of kFullCover.
  std::vector<std::uint64_t> squares() const;
  // Sum over the cells of [a0, a1) x [b0, b1), clipped to the grid, from a table of this raster.
  template <typename Number>
  Number sum(const std::vector<Number>& table, int a0, int a1, int b0, int b1) const {
    a0 = std::clamp(a0, 0, a_cells_);
    a1 = std::clamp(a1, a0, a_cells_);
    b0 = std::clamp(b0, 0, b_cells_);
    b1 = std::clamp(b1, b0, b_cells_);
    const auto at = [&](int a, int b) {
      return table[static_cast<std::size_t>(a) * (static_cast<std::size_t>(b_cells_) + 1) +
                   static_cast<std::size_t>(b)];
    };
    // Unsigned arithmetic: right even where the table wrapped around.
    return at(a1, b1) - at(a0, b1) - at(a1, b0) + at(a0, b0);
  }
  // Number of cells with returns in [a0, a1) x [b0, b1), clipped to the grid.
  double seen_cells(int a0, int a1, int b0, int b1) const;
  // Mean cover, 0 to 1, of these cells; 0 where there are none.
  double cover(int a0, int a1, int b0, int b1) const;

 private:
  Frame frame_;
  double cell_m_;
  int a_cells_, b_cells_;
  std::vector<std::uint32_t> seen_, covered_;  // summed-area tables, (a_cells + 1) x (b_cells + 1)
};

template <std::invocable<std::size_t> Cover>
CanopyRaster::CanopyRaster(const Frame& frame, double cell_m, int a_cells, int b_cells,
                           const Cover& cover)
    : frame_(frame), cell_m_(cell_m), a_cells_(a_cells), b_cells_(b_cells) {
  const std::size_t stride = static_cast<std::size_t>(b_cells_) + 1;
  seen_.assign((static_cast<std::size_t>(a_cells_) + 1) * stride, 0);
  covered_.assign(seen_.size(), 0);
  for (std::size_t i = 0; i < static_cast<std::size_t>(a_cells_); ++i) {
    std::uint32_t seen = 0, covered = 0;
    for (std::size_t j = 0; j + 1 < stride; ++j) {
      const std::uint32_t cell = cover(i * (stride - 1) + j);
      seen += cell != kUnseen ? 1 : 0;
      covered += cell != kUnseen ? cell : 0;
      const std::size_t at = (i + 1) * stride + j + 1;
      seen_[at] = seen_[at - stride] + seen;
      covered_[at] = covered_[at - stride] + covered;
    }
  }
}

// The field's canopy along `axes`, with cells without returns all around, so that a plot may end
// where the cloud does. The origin is moved to the lowest a and b; one raster for each scale.
//
// A cell's cover is the generalised mean of order 4 of its returns' shares of full canopy. It is
// near the highest one, as in a canopy height model: ground that is seen between leaves leaves no
// pit (Khosravipour et al., PE&RS 80(9), 2014), and leaves look the same from either side,
// whether or not they hide the ground behind them. Unlike the highest one it does not grow with the
// number of returns, and one of them alone does not make it.
std::vector<CanopyRaster> rasterise(const FieldCanopy& field, const Frame& axes, double cell_m,
                                    std::span<const CanopyScale> scales, int threads);

}  // namespace plotscan::plots
