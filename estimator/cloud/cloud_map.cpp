// SPDX-License-Identifier: Apache-2.0
#include "cloud/cloud_map.h"

#include <algorithm>
#include <cmath>

#include "cloud/field_density.h"
#include "cloud/internal/field_hull.h"
#include "core/error.h"
#include "core/list_of.h"
#include "core/statistics.h"
#include "record/positions.h"

namespace plotscan::cloud {
namespace {

// Median height of the first points in the area: one stray point must not become the origin.
double median_z(const std::vector<Eigen::Vector3d>& points) {
  std::vector<double> z(points.size());
  std::ranges::transform(points, z.begin(), [](const Eigen::Vector3d& point) { return point.z(); });
  return quantile(std::move(z), 0.5);
}

NamedArea scanned_field(const CloudFiles& cloud) {
  TileCounter tiles;
  record::read_positions(cloud, [&](auto points) { tiles.add(points); });
  return {.area = find_field(tiles.counts()).bounds(), .name = "scanned field"};
}

}  // namespace

CloudMap::CloudMap(const Area& area) : area_(area) {
  origin_.head<2>() = middle_of(area).array().round();
}

void CloudMap::add(std::span<const Eigen::Vector3d> world_points) {
  points_read_ += world_points.size();
  const std::vector<Eigen::Vector3d> inside = those_of(
      world_points, [this](const Eigen::Vector3d& point) { return holds(area_, point.head<2>()); });
  if (points_.empty() && !inside.empty()) origin_.z() = std::round(median_z(inside));
  for (const Eigen::Vector3d& point : inside) {
    if (std::abs(point.z() - origin_.z()) > kLongestSide_m) continue;
    points_.emplace_back((point - origin_).cast<float>());
  }
}

CloudMap read_map(const CloudFiles& cloud, const std::optional<NamedArea>& area,
                  const ProgressReport& progress) {
  const NamedArea field = area ? *area : scanned_field(cloud);
  if (area) {
    require_area(field.area, field.name);
  } else {
    require_scanned_area(field.area, cloud.name());
  }
  if (progress) progress(0.2);
  CloudMap map(field.area);
  const scan::CloudSummary read =
      record::read_positions(cloud, [&](auto points) { map.add(points); });
  map.note({.not_finite = read.not_finite, .left_out = read.left_out});
  if (map.points().empty()) {
    throw InputError(cloud.name() + ": none of its " + std::to_string(map.points_read()) +
                     " points lies in the " + field.name + " " + text_of(field.area));
  }
  if (progress) progress(0.4);
  return map;
}

}  // namespace plotscan::cloud
