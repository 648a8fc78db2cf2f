// SPDX-License-Identifier: Apache-2.0
#include "farmbench/internal/survey.h"

#include <algorithm>
#include <iterator>
#include <span>

#include "core/error.h"
#include "lidar/scene_content.h"
#include "lidar/site.h"
#include "scan/cloud_writer.h"
#include "scan/point_reader.h"

namespace plotscan::farmbench {
namespace fs = std::filesystem;
namespace {

bool lies_in(const cloud::Area& area, const PlotBox& box) {
  return std::ranges::all_of(
      box.corners(), [&](const Eigen::Vector2d& corner) { return cloud::holds(area, corner); });
}

}  // namespace

void leave_to_survey(std::vector<score::TruePlot>& plots, const cloud::Area& survey) {
  for (score::TruePlot& plot : plots) plot.scored = lies_in(survey, plot.box);
  if (std::ranges::none_of(plots, &score::TruePlot::scored))
    throw InputError("no plot lies wholly in survey_m");
}

lidar::FlySummary fly_survey(const farm::Farm& farm, const cloud::Area& survey,
                             const fs::path& folder, const lidar::FlyOptions& flight,
                             const ProgressReport& progress) {
  lidar::Site site = lidar::site_of(farm);
  const Eigen::Vector2d sides_m = cloud::sides_of(survey);
  site.areas = {{.center = cloud::middle_of(survey),
                 .width_m = sides_m.y(),
                 .length_m = sides_m.x(),
                 .heading_rad = 0}};
  return lidar::fly(site, lidar::scene_content(farm), folder, flight, true, progress);
}

scan::PointSink only_inside(const cloud::Area& area, const Eigen::Vector3d& origin_m,
                            const scan::PointSink& sink) {
  return [=, kept = std::vector<scan::LabelledPoint>()](
             std::span<const scan::LabelledPoint> points) mutable {
    kept.clear();
    std::ranges::copy_if(points, std::back_inserter(kept), [&](const scan::LabelledPoint& point) {
      return cloud::holds(area,
                          origin_m.head<2>() + Eigen::Vector2f(point.x, point.y).cast<double>());
    });
    sink(kept);
  };
}

void crop_cloud(const fs::path& cloud, const cloud::Area& area, const fs::path& cropped) {
  const scan::CloudInfo info = scan::read_cloud_info(cloud);
  scan::PcdWriter writer(cropped, {.origin_m = info.origin_m});
  scan::read_points(cloud, info,
                    only_inside(area, info.origin_m, [&](auto points) { writer.write(points); }));
  writer.close();
}

}  // namespace plotscan::farmbench
