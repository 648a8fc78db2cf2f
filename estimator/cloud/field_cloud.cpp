// SPDX-License-Identifier: Apache-2.0
#include "cloud/field_cloud.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "cloud/field_density.h"
#include "cloud/internal/background_sink.h"
#include "cloud/internal/field_hull.h"
#include "cloud/internal/haze.h"
#include "cloud/internal/outliers.h"
#include "core/each_index.h"
#include "core/error.h"
#include "core/stage.h"
#include "core/statistics.h"
#include "record/positions.h"

namespace plotscan::cloud {
namespace {

bool overlap(Tile tile, const Area& area) {
  return tile.x + 1.0 > area[0] && tile.x <= area[2] && tile.y + 1.0 > area[1] && tile.y <= area[3];
}

// The middle of the area at the height of the tiles' first points, whole metres.
Eigen::Vector3d origin_of(const TiledKeys& tiles, const Area& area) {
  std::vector<double> z;
  for (std::size_t i = 0; i < tiles.tiles.size(); ++i)
    z.push_back(point_of(tiles.tiles[i], tiles.of(i).front(), Eigen::Vector3d::Zero()).z());
  const Eigen::Array2d middle = middle_of(area).array().round();
  return {middle.x(), middle.y(), std::floor(quantile(std::move(z), 0.5))};
}

TiledPoints points_of(TiledKeys tiles, const Eigen::Vector3d& origin, int threads) {
  std::vector<Eigen::Vector3f> points(tiles.all().size());
  for_each_index(tiles.tiles.size(), threads, [&](std::size_t tile) {
    for (std::size_t i = tiles.begin[tile]; i < tiles.begin[tile + 1]; ++i)
      points[i] = point_of(tiles.tiles[tile], tiles.keys[i], origin);
  });
  return {std::move(tiles.tiles), std::move(tiles.begin), std::move(points)};
}

// "; they lie in -25,-22,25,26" (the tiles' outer edges); "" without tiles.
std::string extent_text(std::span<const TileCount> tiles) {
  if (tiles.empty()) return "";
  Tile low = tiles.front().tile;
  Tile high = low;
  for (const auto& [tile, points] : tiles) {
    low = {std::min(low.x, tile.x), std::min(low.y, tile.y)};
    high = {std::max(high.x, tile.x), std::max(high.y, tile.y)};
  }
  return "; they lie in " + text_of({static_cast<double>(low.x), static_cast<double>(low.y),
                                     high.x + 1.0, high.y + 1.0});
}

// What to do where the area may be in degrees, and the cloud can't be.
std::string degrees_hint(const Area& area, std::span<const TileCount> tiles) {
  constexpr double kMost = 185;  // degrees, and the metres that are read around boxes
  const bool may_be_degrees =
      std::ranges::all_of(area, [](double value) { return std::abs(value) <= kMost; });
  const bool in_metres = std::ranges::any_of(
      tiles, [](const TileCount& count) { return std::abs(count.tile.x) > kMost; });
  constexpr const char* kHint =
      "; if it is in longitude and latitude: for a map of plots --crs says in which system the "
      "cloud is, and a crop box is in metres of UTM";
  return may_be_degrees && in_metres ? kHint : "";
}

// Points a square metre in the area, or in the whole field; 0 without points.
double density_of(const TileStore& store, const std::optional<Area>& area) {
  std::vector<TileCount> counts = store.tile_counts();
  if (area)
    std::erase_if(counts, [&](const TileCount& count) { return !overlap(count.tile, *area); });
  return counts.empty() ? 0 : field_density(counts).median;
}

// Drops the points outside the area: a tile at its edge reaches beyond it.
void crop(FieldCloud& field) {
  const auto outside = [&](const Eigen::Vector3f& point) {
    return !holds(field.area, field.origin.head<2>() + point.head<2>().cast<double>());
  };
  field.counts.outside += std::erase_if(field.points, outside);
}

// Reports up to `done` of the whole work.
scan::CloudSummary read_into(TileStore& store, const CloudFiles& cloud, int threads, double done,
                             const ProgressReport& progress) {
  const Stage stage("reading");
  const double expected = record::expected_points(cloud);
  BackgroundSink adding([&](std::span<const Eigen::Vector3d> points) { store.add(points); },
                        threads);
  double read = 0;
  const auto add = [&](std::span<const Eigen::Vector3d> points) {
    adding.add(points);
    read += static_cast<double>(points.size());
    if (progress) progress(done * std::min(1.0, read / expected));
  };
  scan::CloudSummary summary = record::read_positions(cloud, add, {.leave_out_marked = true});
  adding.finish();
  return summary;
}

}  // namespace

FieldCloud take_field(TileStore& store, const FieldOptions& options, const std::string& name) {
  Stage stage("field");
  FieldCloud field;
  std::optional<FieldHull> hull;
  const std::vector<TileCount> tile_counts = store.tile_counts();
  std::string seen = extent_text(tile_counts);
  if (options.area) {
    field.area = *options.area;
    require_area(field.area, options.area_name);
    seen += degrees_hint(field.area, tile_counts);
  } else {
    require_places(tile_counts, name);
    hull = find_field(tile_counts);
    field.area = hull->bounds();
    require_scanned_area(field.area, name);
  }
  TiledKeys tiles =
      store.take([&](Tile tile) { return hull ? hull->holds(tile) : overlap(tile, field.area); });
  field.density_m2 = density_of(store, options.area);
  const TileStore::Counts& counts = store.counts();
  field.counts = {.read = counts.added,
                  .outside = counts.unwanted + counts.out_of_range,
                  .repeated = counts.repeated,
                  .thinned = counts.thinned};
  field.origin = origin_of(tiles, field.area);
  TiledPoints points = points_of(std::move(tiles), field.origin, options.threads);
  field.counts.outliers = drop_haze(points, options.threads);
  field.counts.outliers += drop_outliers(points, options.threads);
  field.points = std::move(points.points);
  if (options.area) crop(field);
  field.counts.kept = field.points.size();
  if (field.points.empty()) {
    throw InputError(name, "none of its {} points lies in the {} {} (metres){}", counts.added,
                     options.area_name, text_of(field.area), seen);
  }
  stage.found(std::to_string(field.points.size()) + " points");
  return field;
}

FieldCloud read_field(const CloudFiles& cloud, const FieldOptions& options,
                      const ProgressReport& progress) {
  if (options.area) require_area(*options.area, options.area_name);
  TileStore store({.points_per_cell = options.points_per_cell, .threads = options.threads});
  constexpr double kRead = 0.5;  // of the time
  const scan::CloudSummary summary = read_into(store, cloud, options.threads, kRead, progress);
  const std::string name =
      cloud.only_classes.empty() ? cloud.name() : cloud.name() + ", points of the given classes";
  FieldCloud field = take_field(store, options, name);
  field.counts.read += summary.not_finite + summary.marked + summary.left_out;
  field.counts.not_finite = summary.not_finite;
  field.counts.marked = summary.marked;
  field.counts.left_out = summary.left_out;
  if (progress) progress(1);
  return field;
}

}  // namespace plotscan::cloud
