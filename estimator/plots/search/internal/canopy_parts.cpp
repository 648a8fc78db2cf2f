// SPDX-License-Identifier: Apache-2.0
#include "plots/search/internal/canopy_parts.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "plots/canopy/field_blocks.h"

namespace plotscan::plots {
namespace {

using PartGrid = Eigen::ArrayXXi;
using PartCell = Eigen::Array<Eigen::Index, 2, 1>;

constexpr float kPartCell_m = 0.25F;
constexpr float kMostPartCells = 1.6e7F;  // wider cells on fields of over a square kilometre
constexpr double kLeastCovered = 0.2;     // of a cell's returns: stray ones are less
constexpr float kAroundPart_m = 3;        // of a part, where ground shows
constexpr double kLeastPart_m2 = 4;       // of covered cells: four small plots

// The cells of a rectangle about a cell, as far as the grid has them.
template <typename Use>
void for_each_near(const PartGrid& cells, const PartCell& at, Eigen::Index reach, const Use& use) {
  for (Eigen::Index x = std::max<Eigen::Index>(0, at.x() - reach);
       x <= std::min(cells.rows() - 1, at.x() + reach); ++x)
    for (Eigen::Index y = std::max<Eigen::Index>(0, at.y() - reach);
         y <= std::min(cells.cols() - 1, at.y() + reach); ++y)
      use(PartCell(x, y));
}

// Gives a number to a covered cell and all that follow on from it over less than `reach` cells.
// Returns the cells.
std::vector<PartCell> fill(PartGrid& cells, const PartCell& start, int covered, int number,
                           Eigen::Index reach) {
  std::vector<PartCell> found = {start};
  cells(start.x(), start.y()) = number;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const PartCell at = found[i];
    for_each_near(cells, at, reach, [&](const PartCell& near) {
      int& cell = cells(near.x(), near.y());
      if (cell != covered || (near - at).square().sum() > reach * reach) return;
      cell = number;
      found.push_back(near);
    });
  }
  return found;
}

}  // namespace

CanopyParts::CanopyParts(std::span<const Eigen::Vector3f> points, double low_m, double gap_m)
    : extent_(extent_of_finite(points)) {
  if (extent_.isEmpty()) return;
  cell_m_ = std::max(kPartCell_m, std::sqrt(extent_.volume() / kMostPartCells));
  const PartCell count = (extent_.sizes() / cell_m_).array().floor().cast<Eigen::Index>() + 1;
  part_ = PartGrid::Zero(count.x(), count.y());
  PartGrid returns = part_, high = part_;
  for (const Eigen::Vector3f& point : points) {
    if (!point.allFinite()) continue;
    ++returns(cell_of(point));
    if (point.z() > low_m) ++high(cell_of(point));
  }
  number_parts(returns, high, gap_m);
}

Eigen::Index CanopyParts::cell_of(const Eigen::Vector3f& point) const {
  const PartCell cell =
      ((point.head<2>() - extent_.min()) / cell_m_).array().floor().cast<Eigen::Index>();
  return cell.x() + cell.y() * part_.rows();
}

void CanopyParts::number_parts(const PartGrid& returns, const PartGrid& high, double gap_m) {
  constexpr int kCovered = -1;
  const auto reach = static_cast<Eigen::Index>(gap_m / cell_m_);
  part_ = (high.cast<double>() > kLeastCovered * returns.cast<double>())
              .select(PartGrid::Constant(part_.rows(), part_.cols(), kCovered), 0);
  for (Eigen::Index y = 0; y < part_.cols(); ++y) {
    for (Eigen::Index x = 0; x < part_.rows(); ++x) {
      if (part_(x, y) != kCovered) continue;
      const std::vector<PartCell> cells =
          fill(part_, {x, y}, kCovered, static_cast<int>(size_ + 1), reach);
      if (static_cast<double>(cells.size()) * cell_m_ * cell_m_ >= kLeastPart_m2)
        ++size_;
      else
        for (const PartCell& cell : cells) part_(cell.x(), cell.y()) = 0;
    }
  }
}

std::vector<Eigen::Vector3f> CanopyParts::without_others(std::span<const Eigen::Vector3f> points,
                                                         std::size_t part) const {
  const int own = static_cast<int>(part + 1);
  PartGrid taken = PartGrid::Zero(part_.rows(), part_.cols());
  Eigen::AlignedBox2f around;
  for (Eigen::Index y = 0; y < part_.cols(); ++y) {
    for (Eigen::Index x = 0; x < part_.rows(); ++x) {
      if (part_(x, y) == own) {
        around.extend(extent_.min() + cell_m_ * Eigen::Vector2f(x, y));
      } else if (part_(x, y) != 0) {
        for_each_near(taken, {x, y}, 1,
                      [&](const PartCell& near) { taken(near.x(), near.y()) = 1; });
      }
    }
  }
  around.min().array() -= kAroundPart_m;
  around.max().array() += kAroundPart_m + cell_m_;
  std::vector<Eigen::Vector3f> left;
  std::ranges::copy_if(points, std::back_inserter(left), [&](const Eigen::Vector3f& point) {
    return point.allFinite() && around.contains(point.head<2>()) && taken(cell_of(point)) == 0;
  });
  return left;
}

}  // namespace plotscan::plots
