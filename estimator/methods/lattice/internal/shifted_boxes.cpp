// SPDX-License-Identifier: Apache-2.0
#include "methods/lattice/internal/shifted_boxes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "cloud/points_in_boxes.h"
#include "core/list_of.h"
#include "core/statistics.h"

namespace plotscan::methods::lattice {
namespace {

constexpr double kFarthest_m = 1.5;  // less than half of most trials' steps from plot to plot
constexpr double kCell_m = 0.1;
constexpr int kSteps = 15;               // to the farthest, cells
constexpr std::size_t kMostBoxes = 200;  // looked at, spread over the field
constexpr double kParallel_rad = 0.035;  // 2 degrees

// A box and what is about it, in cells along its length and across; seen from where all lengths
// point the same way.
struct Surroundings {
  int along = 0, across = 0;  // cells of the box
  // Sums over all cells before one: with returns, and under canopy.
  Eigen::ArrayXXi seen = {}, covered = {};
};

struct Cover {
  int seen = 0;
  int covered = 0;
  double share() const { return seen == 0 ? 0 : static_cast<double>(covered) / seen; }
};

std::vector<PlotBox> looked_at(const std::vector<PlotBox>& boxes) {
  const std::size_t step = 1 + (boxes.size() - 1) / kMostBoxes;
  std::vector<PlotBox> chosen;
  for (std::size_t i = 0; i < boxes.size(); i += step) {
    PlotBox box = boxes[i];
    if (heading_difference(box.heading_rad, boxes.front().heading_rad) > kParallel_rad) continue;
    box.heading_rad = boxes.front().heading_rad;
    chosen.push_back(box);
  }
  return 2 * step * chosen.size() < boxes.size() ? std::vector<PlotBox>() : chosen;
}

PlotBox with_surroundings(PlotBox box) {
  box.width_m += 2 * kFarthest_m;
  box.length_m += 2 * kFarthest_m;
  return box;
}

// What counts as canopy: half as high as the crop, whose height is that of a plot in the middle.
double least_canopy_m(const std::vector<std::vector<Eigen::Vector3f>>& around) {
  constexpr double kTop = 0.95;
  std::vector<double> tops_m;
  for (const std::vector<Eigen::Vector3f>& points : around) {
    if (!points.empty())
      tops_m.push_back(quantile(
          list_of<double>(points, [](const Eigen::Vector3f& point) { return point.z(); }), kTop));
  }
  return tops_m.empty() ? 0 : quantile(std::move(tops_m), 0.5) / 2;
}

// Sums over the cells of lower rows and columns; one row and one column more than cells.
Eigen::ArrayXXi summed(const Eigen::ArrayXXi& cells) {
  Eigen::ArrayXXi sums = Eigen::ArrayXXi::Zero(cells.rows() + 1, cells.cols() + 1);
  for (Eigen::Index row = 0; row < cells.rows(); ++row)
    for (Eigen::Index column = 0; column < cells.cols(); ++column)
      sums(row + 1, column + 1) =
          sums(row, column + 1) + sums(row + 1, column) - sums(row, column) + cells(row, column);
  return sums;
}

Surroundings surroundings_of(const PlotBox& box, const std::vector<Eigen::Vector3f>& points,
                             double least_m) {
  const auto cells = [](double side_m) {
    return std::max(1, static_cast<int>(std::lround(side_m / kCell_m)));
  };
  Surroundings about{.along = cells(box.length_m), .across = cells(box.width_m)};
  const int rows = about.along + 2 * kSteps;
  const int columns = about.across + 2 * kSteps;
  Eigen::ArrayXXi seen = Eigen::ArrayXXi::Zero(rows, columns);
  Eigen::ArrayXXi covered = seen;
  for (const Eigen::Vector3f& point : points) {
    const Eigen::Vector2d place = box.box_from_world(point.head<2>().cast<double>());
    const int row = static_cast<int>(std::floor(place.x() / kCell_m + rows / 2.0));
    const int column = static_cast<int>(std::floor(place.y() / kCell_m + columns / 2.0));
    if (row < 0 || row >= rows || column < 0 || column >= columns) continue;
    seen(row, column) = 1;
    if (point.z() > least_m) covered(row, column) = 1;
  }
  about.seen = summed(seen);
  about.covered = summed(covered);
  return about;
}

int within(const Surroundings& about, const Eigen::ArrayXXi& sums, int row, int column) {
  const int end_row = row + about.along;
  const int end_column = column + about.across;
  return sums(end_row, end_column) - sums(row, end_column) - sums(end_row, column) +
         sums(row, column);
}

// Of all boxes, moved by so many cells along and across.
Cover cover_at(const std::vector<Surroundings>& all, int along, int across) {
  Cover cover;
  for (const Surroundings& about : all) {
    cover.seen += within(about, about.seen, kSteps + along, kSteps + across);
    cover.covered += within(about, about.covered, kSteps + along, kSteps + across);
  }
  return cover;
}

}  // namespace

std::optional<ShiftedBoxes> shifted_boxes(std::span<const Eigen::Vector3f> heights,
                                          const std::vector<PlotBox>& boxes, double noise_m) {
  constexpr double kLeastGain = 0.1;     // of the boxes' area
  constexpr double kLeastShift_m = 0.3;  // less is within what maps and plots differ by
  constexpr double kLeastSigmas = 4;
  if (boxes.empty()) return std::nullopt;
  const std::vector<PlotBox> chosen = looked_at(boxes);
  if (chosen.empty()) return std::nullopt;
  const auto around = cloud::points_in_boxes(heights, list_of(chosen, with_surroundings));
  const double least_m = least_canopy_m(around);
  if (least_m < kLeastSigmas * noise_m) return std::nullopt;
  std::vector<Surroundings> all;
  for (std::size_t i = 0; i < chosen.size(); ++i)
    all.push_back(surroundings_of(chosen[i], around[i], least_m));
  const double here = cover_at(all, 0, 0).share();
  double best = here, nearest_m = 0;
  Eigen::Vector2d by_m = Eigen::Vector2d::Zero();
  for (int along = -kSteps; along <= kSteps; ++along) {
    for (int across = -kSteps; across <= kSteps; ++across) {
      const double there = cover_at(all, along, across).share();
      const Eigen::Vector2d move_m = kCell_m * Eigen::Vector2d(along, across);
      if (there < best || (there == best && move_m.norm() >= nearest_m)) continue;
      best = there;
      by_m = move_m;
      nearest_m = move_m.norm();
    }
  }
  if (best < here + kLeastGain || nearest_m < kLeastShift_m) return std::nullopt;
  const PlotBox& first = chosen.front();
  return ShiftedBoxes{.by_m = by_m.x() * first.length_axis() + by_m.y() * first.width_axis(),
                      .covered = here,
                      .covered_there = best};
}

}  // namespace plotscan::methods::lattice
