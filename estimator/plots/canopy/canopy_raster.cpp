// SPDX-License-Identifier: Apache-2.0
#include "plots/canopy/canopy_raster.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>
#include <tbb/task_arena.h>

namespace plotscan::plots {
namespace {

// A cell's returns are one number: their count, and above these bits the sum of the fourth powers
// of their shares.
constexpr int kCountBits = 24;
constexpr double kWholeShare = 1 << 16;
constexpr std::size_t kAtOnce = 1 << 16;  // points of a task
constexpr int kUnseenAround = 24;         // cells on every side: more than leaves hang over an edge
constexpr double kMostCells = 2.5e7;      // 32 bytes each; on fields over 6 ha cells are coarser

Eigen::AlignedBox2d bounds_of(const FieldCanopy& field, const Eigen::Matrix2d& ab_from_world) {
  const std::span<const Eigen::Vector3f> points = field.points();
  return tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, points.size(), kAtOnce), Eigen::AlignedBox2d(),
      [&](const tbb::blocked_range<std::size_t>& some, Eigen::AlignedBox2d bounds) {
        for (std::size_t i = some.begin(); i != some.end(); ++i)
          bounds.extend(ab_from_world * points[i].head<2>().cast<double>());
        return bounds;
      },
      [](const Eigen::AlignedBox2d& one, const Eigen::AlignedBox2d& other) {
        return one.merged(other);
      });
}

// The cells that the points between bounds lie in, and unseen ones around them.
class RasterGrid {
 public:
  RasterGrid(const Eigen::Matrix2d& ab_from_world, const Eigen::AlignedBox2d& bounds, double cell_m)
      : ab_from_world_(ab_from_world), low_(bounds.min()), cell_m_(cell_m) {
    const Eigen::Vector2d extent = bounds.sizes();
    while ((extent / cell_m_).prod() > kMostCells) cell_m_ *= 2;
    seen_ = (extent / cell_m_).cast<int>().array() + 1;
  }

  double cell_m() const { return cell_m_; }
  int a_cells() const { return seen_.x() + 2 * kUnseenAround; }
  int b_cells() const { return seen_.y() + 2 * kUnseenAround; }
  std::size_t cells() const {
    return static_cast<std::size_t>(a_cells()) * static_cast<std::size_t>(b_cells());
  }
  Eigen::Array2i cell_of(const Eigen::Vector3f& point) const {
    const Eigen::Vector2d ab = (ab_from_world_ * point.head<2>().cast<double>() - low_) / cell_m_;
    return ab.cast<int>().array().max(0).min(seen_ - 1) + kUnseenAround;
  }
  std::size_t index(const Eigen::Array2i& cell) const {
    return static_cast<std::size_t>(cell.x()) * static_cast<std::size_t>(b_cells()) +
           static_cast<std::size_t>(cell.y());
  }
  Frame frame_along(Frame axes) const {
    const Eigen::Vector2d corner = low_.array() - kUnseenAround * cell_m_;
    axes.origin = corner.x() * axes.a_axis + corner.y() * axes.b_axis;
    return axes;
  }

 private:
  Eigen::Matrix2d ab_from_world_;
  Eigen::Vector2d low_;
  double cell_m_;
  Eigen::Array2i seen_;
};

std::uint64_t return_at(double z_m, const CanopyScale& scale) {
  const double share = std::clamp((z_m - scale.low_m) / (scale.high_m - scale.low_m), 0.0, 1.0);
  const double square = share * share;
  // NOLINTNEXTLINE(bugprone-incorrect-roundings): at least 0, and lround is a call for each return.
  return 1 + (static_cast<std::uint64_t>(square * square * kWholeShare + 0.5) << kCountBits);
}

std::uint32_t cover_of(std::uint64_t returns) {
  const std::uint64_t count = returns & ((std::uint64_t{1} << kCountBits) - 1);
  if (count == 0) return kUnseen;
  if (returns >> kCountBits == 0) return 0;  // bare ground: most cells
  const double mean =
      static_cast<double>(returns >> kCountBits) / (kWholeShare * static_cast<double>(count));
  return static_cast<std::uint32_t>(std::lround(std::sqrt(std::sqrt(mean)) * kFullCover));
}

// The returns of each cell by each scale. Each task looks through all points, and adds those that
// lie in its own band of cells.
std::unique_ptr<std::uint64_t[]> returns_by_cell(const FieldCanopy& field, const RasterGrid& grid,
                                                 std::span<const CanopyScale> scales) {
  const std::span<const Eigen::Vector3f> points = field.points();
  auto returns = std::make_unique_for_overwrite<std::uint64_t[]>(grid.cells() * scales.size());
  const int bands = tbb::this_task_arena::max_concurrency();
  tbb::parallel_for(0, bands, [&](int band) {
    const int first = grid.a_cells() * band / bands, end = grid.a_cells() * (band + 1) / bands;
    std::fill(returns.get() + grid.index({first, 0}) * scales.size(),
              returns.get() + grid.index({end, 0}) * scales.size(), 0);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Eigen::Array2i cell = grid.cell_of(points[i]);
      if (cell.x() < first || cell.x() >= end) continue;
      std::uint64_t* sums = returns.get() + grid.index(cell) * scales.size();
      for (std::size_t k = 0; k < scales.size(); ++k)
        if (i < field.crop_points() || scales[k].with_others)
          sums[k] += return_at(points[i].z(), scales[k]);
    }
  });
  return returns;
}

}  // namespace

Eigen::Matrix2d Frame::ab_from_world() const {
  Eigen::Matrix2d world_from_ab;
  world_from_ab << a_axis, b_axis;
  return world_from_ab.inverse();
}
Eigen::Vector2d Frame::to_world(const Eigen::Vector2d& ab) const {
  return origin + ab.x() * a_axis + ab.y() * b_axis;
}

std::vector<std::uint64_t> CanopyRaster::squares() const {
  const std::size_t stride = static_cast<std::size_t>(b_cells_) + 1;
  std::vector<std::uint64_t> squares(covered_.size(), 0);
  for (int a = 0; a < a_cells_; ++a) {
    std::uint64_t along = 0;
    for (int b = 0; b < b_cells_; ++b) {
      const std::uint64_t cell = sum(covered_, a, a + 1, b, b + 1);
      along += cell * cell;
      const std::size_t at =
          (static_cast<std::size_t>(a) + 1) * stride + static_cast<std::size_t>(b) + 1;
      squares[at] = squares[at - stride] + along;
    }
  }
  return squares;
}

double CanopyRaster::seen_cells(int a0, int a1, int b0, int b1) const {
  return static_cast<double>(sum(seen_, a0, a1, b0, b1));
}

double CanopyRaster::cover(int a0, int a1, int b0, int b1) const {
  const double seen = seen_cells(a0, a1, b0, b1);
  if (seen == 0) return 0;
  return static_cast<double>(sum(covered_, a0, a1, b0, b1)) / (seen * kFullCover);
}

std::vector<CanopyRaster> rasterise(const FieldCanopy& field, const Frame& axes, double cell_m,
                                    std::span<const CanopyScale> scales, int threads) {
  const Eigen::Matrix2d ab_from_world = axes.ab_from_world();
  std::vector<CanopyRaster> rasters(
      scales.size(), CanopyRaster(axes, cell_m, 0, 0, std::span<const std::uint32_t>()));
  tbb::task_arena(threads).execute([&] {
    const Eigen::AlignedBox2d bounds = bounds_of(field, ab_from_world);
    if (bounds.isEmpty()) return;
    const RasterGrid grid(ab_from_world, bounds, cell_m);
    const auto returns = returns_by_cell(field, grid, scales);
    tbb::parallel_for(std::size_t{0}, scales.size(), [&](std::size_t k) {
      rasters[k] = CanopyRaster(
          grid.frame_along(axes), grid.cell_m(), grid.a_cells(), grid.b_cells(),
          [&](std::size_t cell) { return cover_of(returns[cell * scales.size() + k]); });
    });
  });
  return rasters;
}

}  // namespace plotscan::plots
