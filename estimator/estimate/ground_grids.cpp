// SPDX-License-Identifier: Apache-2.0
#include "estimate/ground_grids.h"

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "core/error.h"
#include "core/stage.h"
#include "core/text_file.h"
#include "estimate/internal/esri_grid.h"
#include "estimate/internal/esri_wkt.h"

namespace plotscan::estimate {
namespace fs = std::filesystem;
namespace {

constexpr const char* kNoData = "-9999";

// Esri's ASCII raster: the corner is the lower left cell's, whose centre is the first node; lines
// go from north to south.
void write_grid(const fs::path& path, const ground::Grid& grid, double unit_m,
                const std::function<std::string(std::size_t)>& text) {
  TextFile out(path);
  out << "ncols " << grid.columns << "\nnrows " << grid.rows << "\nxllcorner "
      << (grid.origin.x() - grid.cell_m / 2) / unit_m << "\nyllcorner "
      << (grid.origin.y() - grid.cell_m / 2) / unit_m << "\ncellsize " << grid.cell_m / unit_m
      << "\nNODATA_value " << kNoData << "\n";
  for (int row = grid.rows - 1; row >= 0; --row) {
    for (int column = 0; column < grid.columns; ++column)
      out << (column == 0 ? "" : " ") << text(grid.index(column, row));
    out << "\n";
  }
  out.close();
}

// Beside the grid of that name.
void write_system(const fs::path& folder, const std::string& grid, const std::string& wkt) {
  if (!wkt.empty()) write_text_file(folder / (grid + ".prj"), wkt + "\n");
}

// Rounded to four decimals: 0.1 mm in metres, finer in feet.
std::string rounded(float metres, double unit_m) {
  return std::isfinite(metres) ? fmt::format("{:.4f}", metres / unit_m) : kNoData;
}

// Reads a grid; its coordinates become metres, its values stay as they are in the file.
EsriGrid read_grid(const fs::path& path, double unit_m) {
  EsriGrid grid = read_esri_grid(path);
  grid.first *= unit_m;
  grid.cell *= unit_m;
  return grid;
}

// A grid on the same nodes as the surface, by their places there.
std::vector<float> values_of(const fs::path& path, const ground::Surface& surface, double unit_m) {
  EsriGrid grid = read_grid(path, unit_m);
  const bool same = grid.columns == surface.columns && grid.rows == surface.rows &&
                    std::abs(grid.cell - surface.cell_m) < 1e-6 * surface.cell_m &&
                    (grid.first - surface.origin).norm() < 0.01 * surface.cell_m;
  if (!same) throw InputError(path, "has other columns, rows, corner or cells than ground.asc");
  return std::move(grid.values);
}

}  // namespace

void write_ground(const fs::path& folder, const ground::Surface& surface,
                  const CoordinateUnits& units, const std::string& crs) {
  const double unit_m = units.horizontal_m;
  const std::string wkt = esri_wkt(crs, unit_m);
  for (const char* grid : {"ground", "ground_se", "ground_seen"}) write_system(folder, grid, wkt);
  write_grid(folder / "ground.asc", surface, unit_m,
             [&](std::size_t node) { return rounded(surface.z_m[node], units.vertical_m); });
  write_grid(folder / "ground_se.asc", surface, unit_m,
             [&](std::size_t node) { return rounded(surface.sd_m[node], units.vertical_m); });
  write_grid(folder / "ground_seen.asc", surface, unit_m, [&](std::size_t node) {
    const char* const seen = surface.seen[node] ? "1" : "0";
    return std::string(std::isfinite(surface.z_m[node]) ? seen : kNoData);
  });
}

ground::Field highest_in_cells(std::span<const Eigen::Vector3f> heights, const ground::Grid& grid) {
  const Stage stage("canopy height model");
  ground::Field highest(grid.nodes(), std::numeric_limits<float>::quiet_NaN());
  for (const Eigen::Vector3f& point : heights) {
    const Eigen::Vector2d at = (point.head<2>().cast<double>() - grid.origin) / grid.cell_m;
    const auto column = static_cast<int>(std::floor(at.x() + 0.5));
    const auto row = static_cast<int>(std::floor(at.y() + 0.5));
    if (column < 0 || column >= grid.columns || row < 0 || row >= grid.rows) continue;
    float& top = highest[grid.index(column, row)];
    if (!(top >= point.z())) top = point.z();
  }
  return highest;
}

void write_canopy(const fs::path& folder, const ground::Grid& grid, const ground::Field& canopy_m,
                  const CoordinateUnits& units, const std::string& crs) {
  write_system(folder, "chm", esri_wkt(crs, units.horizontal_m));
  write_grid(folder / "chm.asc", grid, units.horizontal_m,
             [&](std::size_t node) { return rounded(canopy_m[node], units.vertical_m); });
}

ground::Surface read_ground(const fs::path& folder, const CoordinateUnits& units) {
  const double unit_m = units.horizontal_m;
  EsriGrid heights = read_grid(folder / "ground.asc", unit_m);
  ground::Surface surface{{.origin = heights.first,
                           .cell_m = heights.cell,
                           .columns = heights.columns,
                           .rows = heights.rows}};
  surface.z_m = std::move(heights.values);
  surface.sd_m = values_of(folder / "ground_se.asc", surface, unit_m);
  for (float& z : surface.z_m) z *= static_cast<float>(units.vertical_m);
  for (float& sd : surface.sd_m) sd *= static_cast<float>(units.vertical_m);
  for (const float seen : values_of(folder / "ground_seen.asc", surface, unit_m))
    surface.seen.push_back(seen > 0);
  return surface;
}

}  // namespace plotscan::estimate
