// SPDX-License-Identifier: Apache-2.0
#include "cloud/points_in_boxes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/extent.h"

namespace plotscan::cloud {
namespace {

// Which boxes may hold a point: a raster over the boxes' extent that lists, for each of its cells,
// the boxes whose bounding rectangles meet it.
class BoxRaster {
 public:
  explicit BoxRaster(const std::vector<PlotBox>& boxes) {
    const Eigen::AlignedBox2d extent = extent_of(boxes);
    low_ = extent.min();
    const Eigen::Array2d size = extent.sizes().array().max(0);
    cell_m_ = std::max(kCell_m, std::sqrt(size.prod() / kMostCells));
    columns_ = static_cast<long>(size.x() / cell_m_) + 1;
    rows_ = static_cast<long>(size.y() / cell_m_) + 1;
    boxes_by_cell_.resize(columns_ * rows_);
    for (std::size_t i = 0; i < boxes.size(); ++i) list(extent_of(std::span(&boxes[i], 1)), i);
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

  void list(const Eigen::AlignedBox2d& bounds, std::size_t box) {
    const Eigen::Array2d first = ((bounds.min().array() - low_) / cell_m_).floor();
    const Eigen::Array2d last = ((bounds.max().array() - low_) / cell_m_).floor();
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

}  // namespace

std::vector<std::vector<Eigen::Vector3f>> points_in_boxes(std::span<const Eigen::Vector3f> points,
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

}  // namespace plotscan::cloud
