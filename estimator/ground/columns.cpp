// SPDX-License-Identifier: Apache-2.0
#include "ground/columns.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/Dense>
#include <tbb/task_arena.h>

#include "core/error.h"
#include "core/statistics.h"

namespace plotscan::ground {
namespace {

constexpr std::uint32_t kOutside = std::numeric_limits<std::uint32_t>::max();
constexpr double kMostNodes = 64e6;
// Where fewer returns lie than this share of what is usual, the survey's surroundings begin.
constexpr double kSparse = 0.02;
constexpr std::size_t kEnoughBare = 64;  // returns that settle a column of bare ground
constexpr int kDenseNeighbours = 3;      // of 8, that a dense square metre has, or it is a stray

// Counts of points in squares of at least a metre.
struct Raster {
  Eigen::Array2d low = Eigen::Array2d::Zero();
  double step_m = 1;
  double points_per_count = 1;
  int columns = 0;
  int rows = 0;
  std::vector<std::uint32_t> counts = {};

  std::uint32_t count(int column, int row) const {
    const bool inside = column >= 0 && row >= 0 && column < columns && row < rows;
    return inside ? counts[static_cast<std::size_t>(row) * columns + column] : 0;
  }
};

// Counts a regular sample of at most about a million points, enough to see the field's outline.
Raster raster_of(std::span<const Eigen::Vector3f> all_points) {
  constexpr std::size_t kSample = 1000000;
  const std::size_t every = 1 + all_points.size() / kSample;
  std::vector<Eigen::Vector3f> points;
  for (std::size_t i = 0; i < all_points.size(); i += every) {
    if (all_points[i].allFinite()) points.push_back(all_points[i]);
  }
  Eigen::Array2d low = Eigen::Array2d::Constant(std::numeric_limits<double>::max());
  Eigen::Array2d high = -low;
  for (const Eigen::Vector3f& point : points) {
    low = low.min(point.head<2>().cast<double>().array());
    high = high.max(point.head<2>().cast<double>().array());
  }
  if (!(low <= high).all()) throw InputError("the cloud has no finite point");
  constexpr double kMostSquares = 4096;
  Raster raster{.low = low,
                .step_m = std::max(1.0, (high - low).maxCoeff() / kMostSquares),
                .points_per_count = static_cast<double>(every)};
  raster.columns = static_cast<int>((high - low).x() / raster.step_m) + 1;
  raster.rows = static_cast<int>((high - low).y() / raster.step_m) + 1;
  raster.counts.resize(static_cast<std::size_t>(raster.columns) * raster.rows);
  for (const Eigen::Vector3f& point : points) {
    const Eigen::Array2d place = (point.head<2>().cast<double>().array() - low) / raster.step_m;
    ++raster.counts[static_cast<std::size_t>(place.y()) * raster.columns +
                    static_cast<std::size_t>(place.x())];
  }
  return raster;
}

// The count of the square in which the middle point lies.
double usual_count(const Raster& raster) { return self_weighted_median(raster.counts); }

// Where a point lies on the grid: cells from its first node. Outside, or not finite: below -0.5.
Eigen::Vector2f place_of(const Eigen::Vector3f& point, const Grid& grid) {
  const Eigen::Vector2f place =
      (point.head<2>() - grid.origin.cast<float>()) / static_cast<float>(grid.cell_m);
  const bool inside = place.x() >= -0.5f && place.y() >= -0.5f &&
                      place.x() < static_cast<float>(grid.columns) - 0.5f &&
                      place.y() < static_cast<float>(grid.rows) - 0.5f && std::isfinite(point.z());
  return inside ? place : Eigen::Vector2f::Constant(-1);
}

std::uint32_t node_at(const Eigen::Vector2f& place, const Grid& grid) {
  if (place.x() < -0.5f) return kOutside;
  const Eigen::Vector2f nearest = place.array() + 0.5f;  // truncated
  const int column = std::min(static_cast<int>(nearest.x()), grid.columns - 1);
  const int row = std::min(static_cast<int>(nearest.y()), grid.rows - 1);
  return static_cast<std::uint32_t>(grid.index(column, row));
}

std::int16_t part_of_cell(float offset) {
  return static_cast<std::int16_t>(std::clamp(offset * 65536, -32768.0f, 32767.0f));
}

// Least-squares plane through a sample of the points; it serves only to take off the tilt.
BasePlane base_of(std::span<const Eigen::Vector3f> points, const Grid& grid) {
  constexpr std::size_t kSample = 20000;
  Eigen::Matrix3d normal = 1e-9 * Eigen::Matrix3d::Identity();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < points.size(); i += 1 + points.size() / kSample) {
    const Eigen::Vector2f place = place_of(points[i], grid);
    if (place.x() < -0.5f) continue;
    const Eigen::Vector3d row(1, grid.cell_m * place.x(), grid.cell_m * place.y());
    normal += row * row.transpose();
    right += row * points[i].z();
  }
  const Eigen::Vector3d plane = normal.ldlt().solve(right);
  return {.z_m = plane[0], .slope = plane.tail<2>()};
}

// Squares twice as wide.
Raster coarser(const Raster& raster) {
  Raster coarse{.low = raster.low,
                .step_m = 2 * raster.step_m,
                .points_per_count = raster.points_per_count,
                .columns = (raster.columns + 1) / 2,
                .rows = (raster.rows + 1) / 2};
  coarse.counts.resize(static_cast<std::size_t>(coarse.columns) * coarse.rows);
  for (int row = 0; row < raster.rows; ++row) {
    for (int column = 0; column < raster.columns; ++column)
      coarse.counts[static_cast<std::size_t>(row / 2) * coarse.columns + column / 2] +=
          raster.count(column, row);
  }
  return coarse;
}

// Points a square metre where most points lie, over squares wide enough to hold several.
double usual_density(Raster raster) {
  constexpr double kSeveral = 16;
  while (usual_count(raster) < kSeveral && raster.columns * raster.rows > 1)
    raster = coarser(raster);
  return raster.points_per_count * usual_count(raster) / (raster.step_m * raster.step_m);
}

// The node that each point lies nearest to.
std::vector<std::uint32_t> nodes_of(std::span<const Eigen::Vector3f> points, const Grid& grid) {
  std::vector<std::uint32_t> nodes(points.size());
  constexpr std::size_t kChunk = 1 << 16;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points.size(), kChunk),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      for (std::size_t i = range.begin(); i < range.end(); ++i)
                        nodes[i] = node_at(place_of(points[i], grid), grid);
                    });
  return nodes;
}

// First nodes of bands that hold about equally many returns, one band for each task; one more at
// the end.
std::vector<std::uint32_t> even_bands(const std::vector<std::uint32_t>& first, std::size_t bands) {
  std::vector<std::uint32_t> ends;
  for (std::size_t band = 0; band < bands; ++band) {
    const std::size_t returns = first.back() * band / bands;
    ends.push_back(
        static_cast<std::uint32_t>(std::ranges::lower_bound(first, returns) - first.begin()));
  }
  ends.push_back(static_cast<std::uint32_t>(first.size()) - 1);
  return ends;
}

// Moves the returns of a column that may be ground to its front and returns their number.
std::size_t keep_low(std::span<Return> returns, float reach_m, std::vector<float>& z) {
  if (returns.empty()) return 0;
  z.clear();
  for (const Return& r : returns) z.push_back(r.z_m);
  const float highest = selected_low<float>(z, z.size() / 100) + reach_m;
  const auto high = [&](const Return& r) { return r.z_m > highest; };
  const auto kept = static_cast<std::size_t>(std::remove_if(returns.begin(), returns.end(), high) -
                                             returns.begin());
  const bool bare = kept == returns.size();
  const std::size_t every = bare ? std::max<std::size_t>(1, kept / kEnoughBare) : 1;
  std::size_t count = 0;
  for (std::size_t i = 0; i < kept; i += every) returns[count++] = returns[i];
  return count;
}

// The columns with as many returns of each as keep(node, returns, scratch) leaves at its front.
template <class Keep>
Columns part_of(Columns columns, const Keep& keep) {
  const Grid& grid = columns.grid;
  std::vector<std::uint32_t> kept(grid.nodes());
  for_rows(grid, [&](int row) {
    std::vector<float> scratch;
    for (std::size_t i = grid.index(0, row); i < grid.index(0, row + 1); ++i) {
      const auto returns = std::span(columns.returns)
                               .subspan(columns.first[i], columns.first[i + 1] - columns.first[i]);
      kept[i] = static_cast<std::uint32_t>(keep(i, returns, scratch));
    }
  });
  std::uint32_t end = 0;
  for (std::size_t i = 0; i < grid.nodes(); ++i) {
    const auto from = columns.returns.begin() + columns.first[i];
    if (end < columns.first[i]) std::copy_n(from, kept[i], columns.returns.begin() + end);
    columns.first[i] = end;
    end += kept[i];
  }
  columns.first.back() = end;
  columns.returns.resize(end);
  return columns;
}

}  // namespace

double cell_for(double density_m2) {
  constexpr double kPointsOfCell = 2, kNarrowest_m = 0.2, kWidest_m = 10;
  return std::clamp(std::sqrt(kPointsOfCell / density_m2), kNarrowest_m, kWidest_m);
}

Grid grid_of(std::span<const Eigen::Vector3f> points, std::optional<double> step_m) {
  const Raster raster = raster_of(points);
  const double cell_m = step_m.value_or(cell_for(usual_density(raster)));
  const double least = std::max(1.0, kSparse * usual_count(raster));
  const auto dense = [&](int column, int row) { return raster.count(column, row) >= least; };
  std::array<int, 4> box = {raster.columns, raster.rows, -1, -1};
  for (int row = 0; row < raster.rows; ++row) {
    for (int column = 0; column < raster.columns; ++column) {
      if (!dense(column, row)) continue;
      int neighbours = -1;
      for (int y = row - 1; y <= row + 1; ++y) {
        for (int x = column - 1; x <= column + 1; ++x) neighbours += dense(x, y);
      }
      const bool small = raster.columns < 4 || raster.rows < 4;
      if (neighbours < kDenseNeighbours && !small) continue;
      box = {std::min(box[0], column), std::min(box[1], row), std::max(box[2], column),
             std::max(box[3], row)};
    }
  }
  if (box[2] < 0) box = {0, 0, raster.columns - 1, raster.rows - 1};
  const Eigen::Array2d low = raster.low + raster.step_m * Eigen::Array2d(box[0], box[1]);
  const Eigen::Array2d size =
      raster.step_m * Eigen::Array2d(box[2] - box[0] + 1, box[3] - box[1] + 1);
  const Eigen::Array2d nodes = (size / cell_m).ceil().max(2) + 1;
  if (nodes.prod() > kMostNodes) {
    throw InputError("the cloud covers too large an area for a ground grid of " +
                     std::to_string(cell_m) + " m; cut it to the field");
  }
  return {.origin = low.matrix(),
          .cell_m = cell_m,
          .columns = static_cast<int>(nodes.x()),
          .rows = static_cast<int>(nodes.y())};
}

Columns sort_into_columns(std::span<const Eigen::Vector3f> points, const Grid& grid) {
  Columns columns{.grid = grid, .base = base_of(points, grid)};
  const std::vector<std::uint32_t> nodes = nodes_of(points, grid);
  columns.first.assign(grid.nodes() + 1, 0);
  for (const std::uint32_t node : nodes) {
    if (node != kOutside) ++columns.first[node + 1];
  }
  for (std::size_t i = 0; i < grid.nodes(); ++i) columns.first[i + 1] += columns.first[i];
  columns.returns.resize(columns.first.back());
  // Each task looks through all points, and writes the returns of its own band in their order.
  const auto bands = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
  const std::vector<std::uint32_t> band_ends = even_bands(columns.first, bands);
  std::vector<std::uint32_t> next(columns.first.begin(), columns.first.end() - 1);
  const Eigen::Vector2f slope = (grid.cell_m * columns.base.slope).cast<float>();
  tbb::parallel_for(std::size_t{0}, bands, [&](std::size_t band) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      const std::uint32_t node = nodes[i];
      if (node < band_ends[band] || node >= band_ends[band + 1]) continue;
      const Eigen::Vector2f place = place_of(points[i], grid);
      const std::uint32_t row = node / grid.columns, column = node % grid.columns;
      const float base = static_cast<float>(columns.base.z_m) + slope.dot(place);
      columns.returns[next[node]++] = {.z_m = points[i].z() - base,
                                       .dx = part_of_cell(place.x() - static_cast<float>(column)),
                                       .dy = part_of_cell(place.y() - static_cast<float>(row))};
    }
  });
  return columns;
}

Columns low_part(Columns columns, float reach_m) {
  return part_of(std::move(columns),
                 [&](std::size_t, std::span<Return> returns, std::vector<float>& scratch) {
                   return keep_low(returns, reach_m, scratch);
                 });
}

Columns without(Columns columns, const std::vector<std::uint8_t>& nodes) {
  return part_of(std::move(columns),
                 [&](std::size_t node, std::span<Return> returns, std::vector<float>&) {
                   return nodes[node] ? std::size_t{0} : returns.size();
                 });
}

Columns near_part(Columns columns, const Field& surface, float low_m, float high_m,
                  const std::vector<std::uint8_t>& whole) {
  return part_of(std::move(columns), [&](std::size_t node, std::span<Return> returns,
                                         std::vector<float>&) {
    if (whole[node]) return returns.size();
    const float z = surface[node];
    const auto far = [&](const Return& r) { return !(r.z_m > z + low_m && r.z_m < z + high_m); };
    return static_cast<std::size_t>(std::remove_if(returns.begin(), returns.end(), far) -
                                    returns.begin());
  });
}

}  // namespace plotscan::ground
