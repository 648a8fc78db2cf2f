// SPDX-License-Identifier: Apache-2.0
#include "farm/plot_layout.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "core/error.h"
#include "core/text.h"

namespace plotscan::farm {
namespace {

std::string metres(double value) { return formatted("%.2f m", value); }

Eigen::AlignedBox2d bounds_of(const Terrain& terrain) {
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector3d& vertex : terrain.vertices()) {
    box.extend(Eigen::Vector2d(vertex.head<2>()));
  }
  return box;
}

// How far the point lies outside the terrain's bounding rectangle, along the worse axis.
double overhang(const Eigen::AlignedBox2d& box, const Eigen::Vector2d& point) {
  return (box.min() - point).cwiseMax(point - box.max()).maxCoeff();
}

[[noreturn]] void fail_off_terrain(const std::vector<Plot>& plots, const Terrain& terrain,
                                   const std::filesystem::path& source, const Plot& plot,
                                   const Eigen::Vector2d& corner) {
  const Eigen::AlignedBox2d box = bounds_of(terrain);
  double needed_half_side = 0;
  for (const Plot& each : plots) {
    for (const Eigen::Vector2d& point : each.box.corners()) {
      needed_half_side = std::max(needed_half_side, point.cwiseAbs().maxCoeff());
    }
  }
  const double outside = overhang(box, corner);
  throw InputError(
      source, "plots: a corner of plot " + std::to_string(plot.id) + " at (" + metres(corner.x()) +
                  ", " + metres(corner.y()) + ") lies " +
                  (outside > 0 ? metres(outside) + " " : "") + "off the terrain, which spans x " +
                  metres(box.min().x()) + " to " + metres(box.max().x()) + ", y " +
                  metres(box.min().y()) + " to " + metres(box.max().y()) +
                  "; these plots need a square terrain of side " + metres(2 * needed_half_side) +
                  ", or fewer, smaller or differently placed plots");
}

}  // namespace

std::vector<Plot> grid_plots(const PlotGridDescription& grid) {
  std::vector<Plot> plots;
  Eigen::AlignedBox2d bounds;  // in the grid's own frame
  const Eigen::Vector2d size(grid.width_m, grid.length_m);
  const Eigen::Vector2d pitch = size + Eigen::Vector2d(grid.gap_width_m, grid.gap_length_m);
  for (std::size_t row = 0; row < grid.rows.size(); ++row) {
    for (std::uint32_t column = 0; column < grid.rows[row].plots; ++column) {
      const Eigen::Vector2d low(grid.rows[row].offset_m + column * pitch.x(),
                                static_cast<double>(row) * pitch.y());
      bounds.extend(low);
      bounds.extend(low + size);
      plots.push_back(
          {.id = static_cast<std::uint32_t>(plots.size() + 1),
           .row = static_cast<int>(row + 1),
           .column = static_cast<int>(column + 1),
           .box = {.center = low + size / 2,
                   .width_m = grid.width_m,
                   .length_m = grid.length_m,
                   .heading_rad = wrap_heading(grid.heading_rad + std::numbers::pi / 2)},
           .plant_count = 0,
           .heights = {}});
    }
  }
  const Eigen::Rotation2Dd world_from_grid(grid.heading_rad);
  for (Plot& plot : plots) {
    plot.box.center = grid.position_m + world_from_grid * (plot.box.center - bounds.center());
  }
  return plots;
}

void require_on_terrain(const std::vector<Plot>& plots, const Terrain& terrain,
                        const std::filesystem::path& source) {
  for (const Plot& plot : plots) {
    for (const Eigen::Vector2d& corner : plot.box.corners()) {
      if (terrain.height(corner.x(), corner.y())) continue;
      fail_off_terrain(plots, terrain, source, plot, corner);
    }
  }
}

PlotFinder::PlotFinder(const std::vector<Plot>& plots) : plots_(plots) {
  if (plots.empty()) return;
  std::vector<Eigen::Vector3d> corners;
  std::vector<TriangleGrid::Triangle> triangles;
  for (const Plot& plot : plots) {
    const auto first = static_cast<std::uint32_t>(corners.size());
    for (const Eigen::Vector2d& corner : plot.box.corners()) {
      corners.emplace_back(corner.x(), corner.y(), 0);
    }
    triangles.push_back({first, first + 1, first + 2});
    triangles.push_back({first, first + 2, first + 3});
  }
  grid_.emplace(corners, triangles);
}

std::uint32_t PlotFinder::plot_at(const Eigen::Vector2d& point) const {
  if (!grid_) return 0;
  std::size_t first = plots_.size();
  for (const std::uint32_t triangle : grid_->candidates(point.x(), point.y())) {
    if (plots_[triangle / 2].box.contains(point))
      first = std::min<std::size_t>(first, triangle / 2);
  }
  return first < plots_.size() ? plots_[first].id : 0;
}

}  // namespace plotscan::farm
