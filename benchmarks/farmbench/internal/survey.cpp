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
  return std::ranges::all_of(box.corners(), [&](const Eigen::Vector2d& corner) {
    return corner.x() >= area[0] && corner.x() <= area[2] && corner.y() >= area[1] &&
           corner.y() <= area[3];
  });
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
  site.areas = {{.center = {(survey[0] + survey[2]) / 2, (survey[1] + survey[3]) / 2},
                 .width_m = survey[3] - survey[1],
                 .length_m = survey[2] - survey[0],
                 .heading_rad = 0}};
  return lidar::fly(site, lidar::scene_content(farm), folder, flight, true, progress);
}

void crop_cloud(const fs::path& cloud, const cloud::Area& area, const fs::path& cropped) {
  const scan::CloudInfo info = scan::read_cloud_info(cloud);
  scan::PcdWriter writer(cropped, {.origin_m = info.origin_m});
  std::vector<scan::LabelledPoint> kept;
  scan::read_points(cloud, info, [&](std::span<const scan::LabelledPoint> points) {
    kept.clear();
    std::ranges::copy_if(points, std::back_inserter(kept), [&](const scan::LabelledPoint& point) {
      const double x = info.origin_m.x() + static_cast<double>(point.x);
      const double y = info.origin_m.y() + static_cast<double>(point.y);
      return x >= area[0] && x <= area[2] && y >= area[1] && y <= area[3];
    });
    writer.write(kept);
  });
  writer.close();
}

}  // namespace plotscan::farmbench
