// SPDX-License-Identifier: Apache-2.0
#include "estimate/dhami2020/plot_heights.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "core/statistics.h"
#include "estimate/dhami2020/ground_plane.h"

namespace plotscan::estimate {
namespace {

using Points = std::span<const Eigen::Vector3f>;

// Which boxes may hold a point: a raster over the boxes' extent that lists, for each of its cells,
// the boxes whose bounding rectangles meet it.
class BoxRaster {
 public:
  explicit BoxRaster(const std::vector<PlotBox>& boxes) {
    Bounds extent;
    for (const PlotBox& box : boxes) extent = extent.joined(bounds_of(box));
    low_ = extent.low;
    const Eigen::Array2d size = (extent.high - extent.low).max(0);
    cell_m_ = std::max(kCell_m, std::sqrt(size.prod() / kMostCells));
    columns_ = static_cast<long>(size.x() / cell_m_) + 1;
    rows_ = static_cast<long>(size.y() / cell_m_) + 1;
    boxes_by_cell_.resize(columns_ * rows_);
    for (std::size_t i = 0; i < boxes.size(); ++i) list(bounds_of(boxes[i]), i);
  }

  // Indices of the boxes near the position.
  std::span<const std::uint32_t> near(const Eigen::Vector2d& position) const {
    const Eigen::Array2d cell = (position.array() - low_) / cell_m_;
    if (!(cell.x() >= 0 && cell.y() >= 0 && cell.x() < columns_ && cell.y() < rows_)) return {};
    return boxes_by_cell_[static_cast<long>(cell.y()) * columns_ + static_cast<long>(cell.x())];
  }

 private:
  static constexpr double kCell_m = 0.5;
  static constexpr double kMostCells = 1e6;
  struct Bounds {
    Eigen::Array2d low = Eigen::Array2d::Constant(std::numeric_limits<double>::max());
    Eigen::Array2d high = Eigen::Array2d::Constant(std::numeric_limits<double>::lowest());
    Bounds joined(const Bounds& other) const { return {low.min(other.low), high.max(other.high)}; }
  };

  static Bounds bounds_of(const PlotBox& box) {
    Bounds bounds;
    for (const Eigen::Vector2d& corner : box.corners()) {
      bounds = bounds.joined({corner.array(), corner.array()});
    }
    return bounds;
  }
  void list(const Bounds& bounds, std::size_t box) {
    const Eigen::Array2d first = ((bounds.low - low_) / cell_m_).floor();
    const Eigen::Array2d last = ((bounds.high - low_) / cell_m_).floor();
    for (long y = static_cast<long>(first.y()); y <= static_cast<long>(last.y()); ++y) {
      for (long x = static_cast<long>(first.x()); x <= static_cast<long>(last.x()); ++x) {
        boxes_by_cell_[y * columns_ + x].push_back(static_cast<std::uint32_t>(box));
      }
    }
  }

  Eigen::Array2d low_;
  double cell_m_ = kCell_m;
  long columns_ = 0;
  long rows_ = 0;
  std::vector<std::vector<std::uint32_t>> boxes_by_cell_;
};

// PlotBox::contains with the heading's sine and cosine taken once.
struct BoxFrame {
  Eigen::Vector2d center, along, across;
  double half_length_m = 0;
  double half_width_m = 0;

  explicit BoxFrame(const PlotBox& box)
      : center(box.center),
        along(box.length_axis()),
        across(box.width_axis()),
        half_length_m(box.length_m / 2),
        half_width_m(box.width_m / 2) {}
  bool contains(const Eigen::Vector2d& position) const {
    const Eigen::Vector2d offset = position - center;
    return std::abs(offset.dot(along)) <= half_length_m &&
           std::abs(offset.dot(across)) <= half_width_m;
  }
};

std::vector<PlotBox> extended_boxes(const std::vector<PlotEstimate>& plots, double extend_m) {
  std::vector<PlotBox> boxes;
  for (const PlotEstimate& plot : plots) {
    boxes.push_back(plot.box);
    boxes.back().length_m += 2 * extend_m;
  }
  return boxes;
}

std::vector<Eigen::Vector3d> in_double(const std::vector<Eigen::Vector3f>& points) {
  std::vector<Eigen::Vector3d> result;
  result.reserve(points.size());
  for (const Eigen::Vector3f& point : points) result.emplace_back(point.cast<double>());
  return result;
}

void append_heights(const std::vector<Eigen::Vector3f>& points, const GroundPlane& ground,
                    double tolerance_m, std::vector<double>& heights_m) {
  for (const Eigen::Vector3f& point : points) {
    const double height_m = ground.height_of(point.cast<double>());
    if (height_m > tolerance_m) heights_m.push_back(height_m);
  }
}

void measure_plot(PlotEstimate& plot, const std::vector<Eigen::Vector3f>& raw,
                  const std::vector<Eigen::Vector3f>& voxels, double tolerance_m) {
  plot.points = raw.size();
  const std::optional<GroundPlane> ground = find_ground_plane(in_double(voxels), tolerance_m);
  if (!ground) return;
  std::vector<double> heights_m;
  append_heights(voxels, *ground, tolerance_m, heights_m);
  if (!heights_m.empty()) plot.heights_m["voxel-max"] = std::ranges::max(heights_m);
  append_heights(raw, *ground, tolerance_m, heights_m);
  if (heights_m.empty()) return;
  plot.heights_m["raw-max"] = std::ranges::max(heights_m);
  plot.heights_m["raw-p99"] = quantile(std::move(heights_m), 0.99);
}

}  // namespace

std::vector<std::vector<Eigen::Vector3f>> points_in_boxes(Points points,
                                                          const std::vector<PlotBox>& boxes) {
  std::vector<std::vector<Eigen::Vector3f>> inside(boxes.size());
  const BoxRaster raster(boxes);
  const std::vector<BoxFrame> frames(boxes.begin(), boxes.end());
  for (const Eigen::Vector3f& point : points) {
    const Eigen::Vector2d position = point.head<2>().cast<double>();
    for (const std::uint32_t box : raster.near(position)) {
      if (frames[box].contains(position)) inside[box].push_back(point);
    }
  }
  return inside;
}

void measure_heights(std::vector<PlotEstimate>& plots, Points raw, Points voxels,
                     const Dhami2020Options& options) {
  const std::vector<PlotBox> boxes = extended_boxes(plots, options.extend_m);
  const auto raw_by_plot = points_in_boxes(raw, boxes);
  const auto voxels_by_plot = points_in_boxes(voxels, boxes);
  tbb::task_arena arena(options.threads);
  arena.execute([&] {
    tbb::parallel_for(std::size_t{0}, plots.size(), [&](std::size_t i) {
      measure_plot(plots[i], raw_by_plot[i], voxels_by_plot[i], options.plane_tolerance_m);
    });
  });
}

}  // namespace plotscan::estimate
