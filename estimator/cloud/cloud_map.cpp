// SPDX-License-Identifier: Apache-2.0
#include "cloud/cloud_map.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>

#include "cloud/field_density.h"
#include "cloud/internal/field_hull.h"

#include "core/csv.h"
#include "core/error.h"
#include "core/statistics.h"
#include "core/text.h"
#include "record/positions.h"

namespace plotscan::cloud {
namespace {

// float32 relative to the area's centre resolves 0.5 mm at 5 km.
constexpr double kLongestSide_m = 10000;
constexpr const char* kTooLong = " is longer than 10 km on a side";

bool is_too_long(const Area& area) {
  return std::max(area[2] - area[0], area[3] - area[1]) > kLongestSide_m;
}

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

std::string text_of(const Area& area) {
  std::vector<std::string> millimetres;
  for (const double at : area) millimetres.push_back(format_number(std::round(1000 * at) / 1000));
  return joined(millimetres, ",");
}

void require_area(const Area& area, const std::string& option) {
  const bool finite = std::ranges::all_of(area, [](double value) { return std::isfinite(value); });
  if (!finite || area[0] >= area[2] || area[1] >= area[3]) {
    throw InputError(option + " " + text_of(area) +
                     " is no rectangle; it is x0,y0,x1,y1 with x0 < x1 and y0 < y1");
  }
  if (is_too_long(area)) throw InputError(option + " " + text_of(area) + kTooLong);
}

void require_scanned_area(const Area& area, const std::string& cloud) {
  const std::string field = cloud + ": the scanned field";
  if (is_too_long(area))
    throw InputError(
        field + " " + text_of(area) + kTooLong +
        "; give a part of it (--crop-box), or --units where coordinates are not metres");
  require_area(area, field);
}

CloudMap::CloudMap(const Area& area) : area_(area) {
  origin_.head<2>() << std::round((area[0] + area[2]) / 2), std::round((area[1] + area[3]) / 2);
}

void CloudMap::add(std::span<const Eigen::Vector3d> world_points) {
  points_read_ += world_points.size();
  std::vector<Eigen::Vector3d> inside;
  std::ranges::copy_if(world_points, std::back_inserter(inside),
                       [this](const Eigen::Vector3d& point) {
                         return point.x() >= area_[0] && point.x() <= area_[2] &&
                                point.y() >= area_[1] && point.y() <= area_[3];
                       });
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
