// SPDX-License-Identifier: Apache-2.0
#include "ground/columns.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Dense>

#include "core/error.h"

namespace plotscan::ground {
namespace {

constexpr std::uint32_t kOutside = std::numeric_limits<std::uint32_t>::max();
constexpr double kMostNodes = 64e6;
// Where fewer returns lie than this share of what is usual, the survey's surroundings begin.
constexpr double kSparse = 0.02;
constexpr int kDenseNeighbours = 3;  // of 8, that a dense square metre has, or it is a stray

// Counts of points in squares of at least a metre.
struct Raster {
  Eigen::Array2d low = Eigen::Array2d::Zero();
  double step_m = 1;
  int columns = 0;
  int rows = 0;
  std::vector<std::uint32_t> counts = {};

  std::uint32_t count(int column, int row) const {
    const bool inside = column >= 0 && row >= 0 && column < columns && row < rows;
    return inside ? counts[static_cast<std::size_t>(row) * columns + column] : 0;
  }
};

Raster raster_of(std::span<const Eigen::Vector3f> points) {
  Eigen::Array2d low = Eigen::Array2d::Constant(std::numeric_limits<double>::max());
  Eigen::Array2d high = -low;
  for (const Eigen::Vector3f& point : points) {
    if (!point.allFinite()) continue;
    low = low.min(point.head<2>().cast<double>().array());
    high = high.max(point.head<2>().cast<double>().array());
  }
  if (!(low <= high).all()) throw InputError("the cloud has no finite point");
  constexpr double kMostSquares = 4096;
  Raster raster{.low = low, .step_m = std::max(1.0, (high - low).maxCoeff() / kMostSquares)};
  raster.columns = static_cast<int>((high - low).x() / raster.step_m) + 1;
  raster.rows = static_cast<int>((high - low).y() / raster.step_m) + 1;
  raster.counts.resize(static_cast<std::size_t>(raster.columns) * raster.rows);
  for (const Eigen::Vector3f& point : points) {
    if (!point.allFinite()) continue;
    const Eigen::Array2d place = (point.head<2>().cast<double>().array() - low) / raster.step_m;
    ++raster.counts[static_cast<std::size_t>(place.y()) * raster.columns +
                    static_cast<std::size_t>(place.x())];
  }
  return raster;
}

// The count of the square in which the middle one of all points lies.
double usual_count(const Raster& raster) {
  std::vector<std::uint32_t> counts = raster.counts;
  std::sort(counts.begin(), counts.end());
  double all = 0;
  for (const std::uint32_t count : counts) all += count;
  double below = 0;
  for (const std::uint32_t count : counts) {
    below += count;
    if (2 * below >= all) return count;
  }
  return 0;
}

std::uint32_t node_of(const Eigen::Vector3f& point, const Grid& grid, Eigen::Vector2d& place) {
  if (!point.allFinite()) return kOutside;
  place = (point.head<2>().cast<double>() - grid.origin) / grid.cell_m;
  if (!(place.x() >= -0.5 && place.y() >= -0.5 && place.x() < grid.columns - 0.5 &&
        place.y() < grid.rows - 0.5)) {
    return kOutside;
  }
  const int column = static_cast<int>(place.x() + 0.5);
  const int row = static_cast<int>(place.y() + 0.5);
  return static_cast<std::uint32_t>(grid.index(column, row));
}

std::int16_t part_of_cell(double offset) {
  return static_cast<std::int16_t>(std::clamp(offset * 65536, -32768.0, 32767.0));
}

// Least squares through a sample of the points: no more than a tilt to take off.
BasePlane base_of(std::span<const Eigen::Vector3f> points, const Grid& grid) {
  constexpr std::size_t kSample = 20000;
  Eigen::Matrix3d normal = 1e-9 * Eigen::Matrix3d::Identity();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  Eigen::Vector2d place;
  for (std::size_t i = 0; i < points.size(); i += 1 + points.size() / kSample) {
    if (node_of(points[i], grid, place) == kOutside) continue;
    const Eigen::Vector3d row(1, grid.cell_m * place.x(), grid.cell_m * place.y());
    normal += row * row.transpose();
    right += row * points[i].z();
  }
  const Eigen::Vector3d plane = normal.ldlt().solve(right);
  return {.z_m = plane[0], .slope = plane.tail<2>()};
}

}  // namespace

Grid grid_of(std::span<const Eigen::Vector3f> points, double cell_m) {
  const Raster raster = raster_of(points);
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
  std::vector<std::uint32_t> next(grid.nodes() + 1, 0);
  Eigen::Vector2d place;
  for (const Eigen::Vector3f& point : points) {
    const std::uint32_t node = node_of(point, grid, place);
    if (node != kOutside) ++next[node + 1];
  }
  for (std::size_t node = 0; node < grid.nodes(); ++node) next[node + 1] += next[node];
  columns.first = next;
  columns.returns.resize(next.back());
  for (const Eigen::Vector3f& point : points) {
    const std::uint32_t node = node_of(point, grid, place);
    if (node == kOutside) continue;
    const double column = node % grid.columns;
    const double row = node / grid.columns;
    const double base = columns.base.z_m + grid.cell_m * columns.base.slope.dot(place);
    columns.returns[next[node]++] = {.z_m = static_cast<float>(point.z() - base),
                                     .dx = part_of_cell(place.x() - column),
                                     .dy = part_of_cell(place.y() - row)};
  }
  return columns;
}

}  // namespace plotscan::ground
