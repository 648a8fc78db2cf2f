// SPDX-License-Identifier: Apache-2.0
#include "planting/plot_layout.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>

#include <fmt/core.h>

#include "core/angle.h"
#include "core/error.h"
#include "core/random.h"
#include "terrain/extent.h"

namespace plotscan::planting {
namespace {

std::string metres(double value) { return fmt::format("{:.2f} m", value); }

// How far the point lies outside the terrain's bounding rectangle, along the worse axis.
double overhang(const Eigen::AlignedBox2d& box, const Eigen::Vector2d& point) {
  return (box.min() - point).cwiseMax(point - box.max()).maxCoeff();
}

[[noreturn]] void fail_off_terrain(const std::vector<farm::Plot>& plots,
                                   const terrain::Terrain& terrain,
                                   const std::filesystem::path& source, const farm::Plot& plot,
                                   const Eigen::Vector2d& corner) {
  const Eigen::AlignedBox2d box = terrain::outline_of(terrain);
  const double outside = overhang(box, corner);
  const std::string where = fmt::format("plots: a corner of plot {} at ({}, {})", plot.id,
                                        metres(corner.x()), metres(corner.y()));
  if (outside <= 0)
    throw InputError(source, "{} lies over a hole in the terrain, or beyond its edge", where);
  double needed_half_side = 0;
  for (const farm::Plot& each : plots)
    for (const Eigen::Vector2d& point : each.box.corners())
      needed_half_side = std::max(needed_half_side, point.cwiseAbs().maxCoeff());
  throw InputError(source,
                   "{} lies {} off the terrain, which spans x {} to {}, y {} to {}; these "
                   "plots need a square terrain of side {}, or fewer, smaller or "
                   "differently placed plots",
                   where, metres(outside), metres(box.min().x()), metres(box.max().x()),
                   metres(box.min().y()), metres(box.max().y()),
                   metres(std::ceil(200 * needed_half_side) / 100));
}

// Between the centres of neighbours, along the grid's own axes.
Eigen::Vector2d pitch_of(const PlotGridDescription& grid) {
  if (grid.pitch) return {grid.pitch->column_m.norm(), grid.pitch->row_m.norm()};
  return {grid.width_m + grid.gap_width_m, grid.length_m + grid.gap_length_m};
}

// The directions along a row and from row to row, as columns.
Eigen::Matrix2d axes_of(const PlotGridDescription& grid) {
  Eigen::Matrix2d axes = Eigen::Rotation2Dd(grid.heading_rad).toRotationMatrix();
  if (grid.pitch)
    axes << grid.pitch->column_m.normalized(), grid.pitch->row_m.normalized();
  else if (grid.skew_rad != 0)
    axes.col(1) = Eigen::Rotation2Dd(grid.skew_rad) * axes.col(1).eval();
  return axes;
}

// By how much the alleys before each row or column (from 0) are wider than the gaps they replace.
std::vector<double> widened(const std::map<std::uint32_t, double>& alleys_m, std::size_t count,
                            double gap_m) {
  std::vector<double> wider_m(count, 0);
  double sum_m = 0;
  auto alley = alleys_m.begin();
  for (std::size_t i = 0; i < count; ++i) {
    for (; alley != alleys_m.end() && alley->first <= i; ++alley) sum_m += alley->second - gap_m;
    wider_m[i] = sum_m;
  }
  return wider_m;
}

}  // namespace

TrialLayout layout_of(const PlotGridDescription& grid) {
  const Eigen::Vector2d pitch = pitch_of(grid);
  const Eigen::Matrix2d axes = axes_of(grid);
  TrialLayout layout{.origin = grid.position_m,
                     .row_axis = axes.col(0),
                     .column_axis = axes.col(1),
                     .width_m = grid.width_m,
                     .length_m = grid.length_m,
                     .column_pitch_m = pitch.x(),
                     .row_pitch_m = pitch.y()};
  const std::vector<double> row_wider_m =
      widened(grid.row_alleys_m, grid.rows.size(), pitch.y() - grid.length_m);
  const std::vector<double> column_wider_m =
      widened(grid.column_alleys_m, columns_of(grid), pitch.x() - grid.width_m);
  const Eigen::Vector2d size(grid.width_m, grid.length_m);
  Eigen::AlignedBox2d bounds;  // along the layout's axes
  for (std::size_t row = 0; row < grid.rows.size(); ++row) {
    for (std::uint32_t place = 0; place < grid.rows[row].plots; ++place) {
      const std::uint32_t column = column_at(grid.numbering, row, place, grid.rows[row].plots);
      const Eigen::Vector2d low(
          grid.rows[row].offset_m + column * pitch.x() + column_wider_m[column],
          static_cast<double>(row) * pitch.y() + row_wider_m[row]);
      bounds.extend(low);
      bounds.extend(low + size);
      layout.places.push_back({.row = static_cast<int>(row + 1),
                               .column = static_cast<int>(column + 1),
                               .position_m = low + size / 2});
    }
  }
  for (TrialPlace& place : layout.places) place.position_m -= bounds.center();
  return layout;
}

int trial_number(std::size_t place, std::size_t trials) {
  return trials > 1 ? static_cast<int>(place) + 1 : 0;
}

std::vector<farm::Plot> grid_plots(const PlotGridDescription& grid, int trial) {
  const TrialLayout layout = layout_of(grid);
  std::vector<farm::Plot> plots;
  for (const TrialPlace& place : layout.places) {
    plots.push_back({.id = grid.first_number + static_cast<std::uint32_t>(plots.size()),
                     .trial = trial,
                     .row = place.row,
                     .column = place.column,
                     .box = layout.box(place),
                     .plant_count = 0,
                     .heights = {}});
  }
  return plots;
}

PlotGridDescription turned(PlotGridDescription grid, std::uint64_t seed, std::size_t place) {
  if (!grid.random_heading) return grid;
  grid.heading_rad = RandomStream(seed, random_purpose("plots/heading"), place).uniform(0, 2 * kPi);
  return grid;
}

std::optional<std::pair<std::uint32_t, std::uint32_t>> overlapping_plots(
    const std::vector<farm::Plot>& plots, double share) {
  if (plots.empty()) return {};
  Eigen::AlignedBox2d centers;
  for (const farm::Plot& plot : plots) centers.extend(plot.box.center);
  // Swept along the longer side of the field, so that few plots are near each other on the way.
  const Eigen::Index way = centers.sizes().x() < centers.sizes().y() ? 1 : 0;
  std::vector<const farm::Plot*> sorted;
  double reach_m = 0;  // farther apart than this, no two can touch
  for (const farm::Plot& plot : plots) {
    sorted.push_back(&plot);
    reach_m = std::max(reach_m, std::hypot(plot.box.width_m, plot.box.length_m));
  }
  std::stable_sort(sorted.begin(), sorted.end(), [&](const farm::Plot* a, const farm::Plot* b) {
    return a->box.center[way] < b->box.center[way];
  });
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    for (std::size_t j = i + 1; j < sorted.size(); ++j) {
      const Eigen::Vector2d apart = sorted[j]->box.center - sorted[i]->box.center;
      if (apart[way] > reach_m) break;
      if (apart.norm() > reach_m) continue;
      const auto& [a, b] = std::tie(sorted[i]->box, sorted[j]->box);
      if (intersection_area(a, b) <= share * std::min(a.area_m2(), b.area_m2())) continue;
      return std::minmax({sorted[i]->id, sorted[j]->id});
    }
  }
  return {};
}

bool is_missing(const PlotGridDescription& grid, std::uint32_t number, std::uint64_t seed) {
  if (std::binary_search(grid.missing.begin(), grid.missing.end(), number)) return true;
  return RandomStream(seed, random_purpose("plot/missing"), number).uniform() < grid.missing_rate;
}

void require_on_terrain(const std::vector<farm::Plot>& plots, const terrain::Terrain& terrain,
                        const std::filesystem::path& source) {
  for (const farm::Plot& plot : plots) {
    for (const Eigen::Vector2d& corner : plot.box.corners()) {
      if (terrain.height(corner.x(), corner.y())) continue;
      fail_off_terrain(plots, terrain, source, plot, corner);
    }
  }
}

PlotFinder::PlotFinder(const std::vector<farm::Plot>& plots) : plots_(plots) {
  if (plots.empty()) return;
  std::vector<Eigen::Vector3d> corners;
  std::vector<terrain::TriangleGrid::Triangle> triangles;
  for (const farm::Plot& plot : plots) {
    const auto first = static_cast<std::uint32_t>(corners.size());
    for (const Eigen::Vector2d& corner : plot.box.corners())
      corners.emplace_back(corner.x(), corner.y(), 0);
    triangles.push_back({first, first + 1, first + 2});
    triangles.push_back({first, first + 2, first + 3});
  }
  grid_.emplace(corners, triangles);
}

std::uint32_t PlotFinder::plot_at(const Eigen::Vector2d& point) const {
  if (!grid_) return 0;
  std::size_t first = plots_.size();
  for (const std::uint32_t triangle : grid_->candidates(point.x(), point.y()))
    if (plots_[triangle / 2].box.contains(point))
      first = std::min<std::size_t>(first, triangle / 2);
  return first < plots_.size() ? plots_[first].id : 0;
}

}  // namespace plotscan::planting
