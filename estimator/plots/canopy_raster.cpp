// SPDX-License-Identifier: Apache-2.0
#include "plots/canopy_raster.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>

#include <Eigen/LU>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace plotscan::plots {
namespace {

constexpr std::uint32_t kFullCover = 200;  // steps of a cell's cover in the table
constexpr std::uint32_t kUnseen = 255;     // in place of the cover of a cell without returns
constexpr std::uint64_t kCanopyReturn = std::uint64_t{1} << 32;
constexpr double kMostCells = 1e8;  // 10 m of oblique rows or an outlier must not eat memory

bool finite(const Eigen::Vector3f& point) { return point.allFinite(); }

struct Bounds {
  Eigen::Vector2d low = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector2d high = -low;
};

Bounds bounds_of(std::span<const Eigen::Vector3f> points, const Eigen::Matrix2d& ab_from_world) {
  Bounds bounds;
  for (const Eigen::Vector3f& point : points) {
    if (!finite(point)) continue;
    const Eigen::Vector2d ab = ab_from_world * point.head<2>().cast<double>();
    bounds.low = bounds.low.cwiseMin(ab);
    bounds.high = bounds.high.cwiseMax(ab);
  }
  return bounds;
}

// Greatest or least value of the square window about each cell, one axis after the other.
std::vector<std::uint32_t> extreme_of_window(const std::vector<std::uint32_t>& values, int a_cells,
                                             int b_cells, int reach, bool greatest) {
  const auto extreme_along = [&](const std::vector<std::uint32_t>& from, bool along_a) {
    std::vector<std::uint32_t> to(from.size());
    for (int a = 0; a < a_cells; ++a) {
      for (int b = 0; b < b_cells; ++b) {
        const int here = along_a ? a : b;
        const int last = std::min(here + reach, (along_a ? a_cells : b_cells) - 1);
        std::uint32_t best = from[static_cast<std::size_t>(a) * b_cells + b];
        for (int at = std::max(0, here - reach); at <= last; ++at) {
          const std::uint32_t value =
              from[static_cast<std::size_t>(along_a ? at : a) * b_cells + (along_a ? b : at)];
          best = greatest ? std::max(best, value) : std::min(best, value);
        }
        to[static_cast<std::size_t>(a) * b_cells + b] = best;
      }
    }
    return to;
  };
  return extreme_along(extreme_along(values, true), false);
}

}  // namespace

Eigen::Matrix2d Frame::ab_from_world() const {
  Eigen::Matrix2d world_from_ab;
  world_from_ab << a_axis, b_axis;
  return world_from_ab.inverse();
}
Eigen::Vector2d Frame::to_ab(const Eigen::Vector2d& place) const {
  return ab_from_world() * (place - origin);
}
Eigen::Vector2d Frame::to_world(const Eigen::Vector2d& ab) const {
  return origin + ab.x() * a_axis + ab.y() * b_axis;
}

CanopyRaster::CanopyRaster(const Frame& frame, double cell_m, int a_cells, int b_cells,
                           std::span<const std::uint64_t> returns)
    : frame_(frame), cell_m_(cell_m), a_cells_(a_cells), b_cells_(b_cells) {
  std::vector<std::uint32_t> cover(returns.size());
  std::ranges::transform(returns, cover.begin(), [](std::uint64_t cell) {
    const std::uint64_t all = cell % kCanopyReturn;
    return all > 0 ? static_cast<std::uint32_t>(cell / kCanopyReturn * kFullCover / all) : kUnseen;
  });
  sum_up(cover);
}

void CanopyRaster::sum_up(std::span<const std::uint32_t> cover) {
  const std::size_t stride = static_cast<std::size_t>(b_cells_) + 1;
  seen_.assign((static_cast<std::size_t>(a_cells_) + 1) * stride, 0);
  covered_.assign(seen_.size(), 0);
  for (std::size_t i = 0; i < static_cast<std::size_t>(a_cells_); ++i) {
    std::uint32_t seen = 0, covered = 0;
    for (std::size_t j = 0; j + 1 < stride; ++j) {
      const std::uint32_t cell = cover[i * (stride - 1) + j];
      seen += cell != kUnseen ? 1 : 0;
      covered += cell != kUnseen ? cell : 0;
      const std::size_t at = (i + 1) * stride + j + 1;
      seen_[at] = seen_[at - stride] + seen;
      covered_[at] = covered_[at - stride] + covered;
    }
  }
}

CanopyRaster CanopyRaster::closed(double width_m) const {
  const int reach = std::max(1, static_cast<int>(std::lround(width_m / cell_m_ / 2)));
  const auto cells = static_cast<std::size_t>(a_cells_) * static_cast<std::size_t>(b_cells_);
  std::vector<std::uint32_t> cover(cells);
  std::vector<bool> unseen(cells);
  for (std::size_t i = 0; i < cells; ++i) {
    const int a = static_cast<int>(i) / b_cells_;
    const int b = static_cast<int>(i) % b_cells_;
    unseen[i] = sum(seen_, a, a + 1, b, b + 1) == 0;
    cover[i] = static_cast<std::uint32_t>(sum(covered_, a, a + 1, b, b + 1));
  }
  for (const bool widest : {true, false}) {
    cover = extreme_of_window(cover, a_cells_, b_cells_, reach, widest);
  }
  for (std::size_t i = 0; i < cells; ++i) {
    if (unseen[i]) cover[i] = kUnseen;
  }
  CanopyRaster closed = *this;
  closed.sum_up(cover);
  return closed;
}

std::uint64_t CanopyRaster::sum(const std::vector<std::uint32_t>& table, int a0, int a1, int b0,
                                int b1) const {
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

double CanopyRaster::seen_cells(int a0, int a1, int b0, int b1) const {
  return static_cast<double>(sum(seen_, a0, a1, b0, b1));
}

double CanopyRaster::cover(int a0, int a1, int b0, int b1) const {
  const double seen = seen_cells(a0, a1, b0, b1);
  if (seen == 0) return 0;
  return static_cast<double>(sum(covered_, a0, a1, b0, b1)) / (seen * kFullCover);
}

CanopyRaster rasterise(std::span<const Eigen::Vector3f> points, const Frame& axes, double cell_m,
                       double threshold_m, int threads) {
  const Eigen::Matrix2d ab_from_world = axes.ab_from_world();
  const Bounds bounds = bounds_of(points, ab_from_world);
  if (!(bounds.low.x() <= bounds.high.x())) return CanopyRaster(axes, cell_m, 0, 0, {});
  const Eigen::Vector2d extent = bounds.high - bounds.low;
  while ((extent / cell_m).prod() > kMostCells) cell_m *= 2;
  const int a_cells = static_cast<int>(extent.x() / cell_m) + 1;
  const int b_cells = static_cast<int>(extent.y() / cell_m) + 1;
  std::vector<std::uint64_t> returns(static_cast<std::size_t>(a_cells) *
                                     static_cast<std::size_t>(b_cells));
  tbb::task_arena arena(threads);
  arena.execute([&] {
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, points.size(), 1 << 16), [&](const auto& r) {
          for (std::size_t i = r.begin(); i != r.end(); ++i) {
            if (!finite(points[i])) continue;
            const Eigen::Vector2d ab =
                (ab_from_world * points[i].head<2>().cast<double>() - bounds.low) / cell_m;
            const auto a =
                static_cast<std::size_t>(std::clamp(static_cast<int>(ab.x()), 0, a_cells - 1));
            const auto b =
                static_cast<std::size_t>(std::clamp(static_cast<int>(ab.y()), 0, b_cells - 1));
            std::atomic_ref<std::uint64_t> cell(returns[a * static_cast<std::size_t>(b_cells) + b]);
            cell.fetch_add(1 + (points[i].z() > threshold_m ? kCanopyReturn : 0),
                           std::memory_order_relaxed);
          }
        });
  });
  Frame frame = axes;
  frame.origin = bounds.low.x() * axes.a_axis + bounds.low.y() * axes.b_axis;
  return CanopyRaster(frame, cell_m, a_cells, b_cells, returns);
}

double canopy_threshold(std::span<const Eigen::Vector3f> points, double noise_m) {
  constexpr double kStep_m = 0.01;
  constexpr std::size_t kSteps = 600;
  std::array<std::size_t, kSteps> counts{};
  const double lowest_m = std::max(0.12, 4 * noise_m);
  std::size_t above = 0;
  for (const Eigen::Vector3f& point : points) {
    if (!finite(point) || point.z() <= lowest_m) continue;
    const auto step = static_cast<std::size_t>(std::min(point.z() / kStep_m, kSteps - 1.0));
    ++counts[step];
    ++above;
  }
  std::size_t left = above / 20;  // the canopy's top: the highest 5 % of its returns lie above
  std::size_t top = kSteps;
  while (top > 0 && left >= counts[top - 1]) left -= counts[--top];
  return std::max(lowest_m, 0.25 * static_cast<double>(top) * kStep_m);
}

}  // namespace plotscan::plots
