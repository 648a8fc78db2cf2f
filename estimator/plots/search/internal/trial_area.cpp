// SPDX-License-Identifier: Apache-2.0
#include "plots/search/internal/trial_area.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include <Eigen/Geometry>

#include "plots/canopy/field_blocks.h"

namespace plotscan::plots {
namespace {

constexpr double kAreaCell_m = 0.1;

// MarkedCells of a field, some of which are marked.
class MarkedCells {
 public:
  explicit MarkedCells(const Eigen::AlignedBox2d& extent)
      : low_(extent.min()),
        count_((extent.sizes() / kAreaCell_m).array().floor().cast<Eigen::Index>() + 1),
        marked_(static_cast<std::size_t>(count_.prod())) {}

  void mark(const PlotBox& box) {
    Eigen::AlignedBox2d around;
    for (const Eigen::Vector2d& corner : box.corners()) around.extend(corner);
    const Eigen::Array2<Eigen::Index> first = cell_of(around.min()).max(0);
    const Eigen::Array2<Eigen::Index> last = cell_of(around.max()).min(count_ - 1);
    for (Eigen::Index x = first.x(); x <= last.x(); ++x) {
      for (Eigen::Index y = first.y(); y <= last.y(); ++y) {
        const Eigen::Vector2d middle = (Eigen::Array2d(x, y) + 0.5) * kAreaCell_m;
        if (box.contains(low_ + middle)) marked_[number_of({x, y})] = 1;
      }
    }
  }
  bool is_marked(const Eigen::Vector2d& place) const {
    return marked_[number_of(cell_of(place))] != 0;
  }

 private:
  Eigen::Array2<Eigen::Index> cell_of(const Eigen::Vector2d& place) const {
    return ((place - low_) / kAreaCell_m).array().floor().cast<Eigen::Index>();
  }
  std::size_t number_of(const Eigen::Array2<Eigen::Index>& cell) const {
    return static_cast<std::size_t>(cell.x() * count_.y() + cell.y());
  }

  Eigen::Vector2d low_;
  Eigen::Array2<Eigen::Index> count_;
  std::vector<std::uint8_t> marked_;
};

}  // namespace

double gap_of_trial_m(double pitch_m, double size_m) {
  constexpr double kWidest_m = 1.5;  // what lies farther off may be another trial's
  constexpr double kUsual_m = 0.5;   // one row or one column shows none
  return pitch_m > 0 ? std::clamp(pitch_m - size_m, 0.0, kWidest_m) : kUsual_m;
}

std::vector<PlotBox> area_of(const TrialLayout& layout) {
  std::vector<PlotBox> boxes;
  for (const TrialPlace& place : layout.places) {
    boxes.push_back(layout.box(place));
    boxes.back().width_m += gap_of_trial_m(layout.column_pitch_m, layout.width_m);
    boxes.back().length_m += gap_of_trial_m(layout.row_pitch_m, layout.length_m);
  }
  return boxes;
}

PlotBox outline_of(const TrialLayout& layout) {
  PlotBox outline{.heading_rad = layout.heading_rad()};
  Eigen::AlignedBox2d around;  // along the length, along the width
  for (const TrialPlace& place : layout.places)
    for (const Eigen::Vector2d& corner : layout.box(place).corners())
      around.extend(outline.box_from_world(corner));
  outline.center =
      around.center().x() * outline.length_axis() + around.center().y() * outline.width_axis();
  outline.length_m = around.sizes().x();
  outline.width_m = around.sizes().y();
  return outline;
}

std::vector<Eigen::Vector3f> points_outside(std::span<const Eigen::Vector3f> points,
                                            std::span<const PlotBox> boxes) {
  const Eigen::AlignedBox2f extent = extent_of_finite(points);
  std::vector<Eigen::Vector3f> outside;
  if (extent.isEmpty()) return outside;
  MarkedCells cells(extent.cast<double>());
  for (const PlotBox& box : boxes) cells.mark(box);
  std::ranges::copy_if(points, std::back_inserter(outside), [&](const Eigen::Vector3f& point) {
    return point.allFinite() && !cells.is_marked(point.head<2>().cast<double>());
  });
  return outside;
}

}  // namespace plotscan::plots
