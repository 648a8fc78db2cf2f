// SPDX-License-Identifier: Apache-2.0
#include "scanpage/read_cloud.h"

#include <algorithm>
#include <cmath>

#include "core/contains.h"

namespace plotscan::scanpage {
namespace {

report::ShownPoint shown(const scan::LabelledPoint& point, double time_origin_s) {
  return {.place = {point.x, point.y, point.z},
          .intensity = point.intensity,
          .time_s = static_cast<float>(point.time - time_origin_s),
          .plot = point.plot,
          .label = static_cast<std::uint8_t>(point.label)};
}

std::vector<Eigen::Vector3d> path_of(const record::Source& source) {
  std::vector<Eigen::Vector3d> path;
  const auto append = [&](const scan::Trajectory& trajectory, const Eigen::Vector3d& move_m) {
    for (const scan::StampedPose& pose : trajectory.poses())
      path.push_back(pose.position_m + move_m);
  };
  if (source.flight) {
    append(source.flight->reported, source.info.origin_m);
  } else if (source.trajectory) {
    append(*source.trajectory, Eigen::Vector3d::Zero());
  }
  return path;
}

}  // namespace

ShownScan read_shown_scan(const std::filesystem::path& scan, const ReadOptions& options,
                          const ProgressReport& progress) {
  const record::Source source = record::open_source(scan, options.source);
  const Eigen::Vector2d origin = source.info.origin_m.head<2>();
  report::CloudSample sample(options.most);
  const auto promised = static_cast<double>(std::max<std::uint64_t>(source.info.points, 1));
  double done = 0;
  double time_origin_s = 0;
  source.stream([&](std::span<const scan::LabelledPoint> points) {
    if (done == 0 && !points.empty()) time_origin_s = std::floor(points.front().time);
    for (const scan::LabelledPoint& point : points)
      if (!options.area || options.area->contains(origin + Eigen::Vector2d(point.x, point.y)))
        sample.add(shown(point, time_origin_s));
    done += static_cast<double>(points.size());
    if (progress) progress(std::min(1.0, done / promised));
  });
  const auto has = [&](const char* field) { return contains(source.info.fields, field); };
  ShownScan result{.cloud = {.origin = source.info.origin_m,
                             .time_origin_s = time_origin_s,
                             .read = sample.read()},
                   .path = path_of(source)};
  result.cloud.points = sample.take();
  result.cloud.has_class = has("class");
  result.cloud.has_plot = has("plot");
  result.cloud.has_intensity = has("intensity");
  result.cloud.has_time = has("time");
  return result;
}

}  // namespace plotscan::scanpage
