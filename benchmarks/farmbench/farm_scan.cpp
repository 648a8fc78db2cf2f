// SPDX-License-Identifier: Apache-2.0
#include "farmbench/farm_scan.h"

#include <algorithm>
#include <iterator>
#include <span>

#include "core/error.h"
#include "farmbench/run.h"
#include "lidar/make_farm.h"
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

// Only plots that lie wholly in the survey stay scored.
void leave_to_survey(std::vector<score::TruePlot>& plots, const cloud::Area& survey) {
  for (score::TruePlot& plot : plots) plot.scored = lies_in(survey, plot.box);
  if (std::ranges::none_of(plots, &score::TruePlot::scored))
    throw InputError("no plot lies wholly in survey_m");
}

// Flies strips over the rectangle in place of the farm's plots.
lidar::FlySummary fly_survey(const farm::Farm& farm, const cloud::Area& survey,
                             const fs::path& folder, const lidar::FlyOptions& flight,
                             const ProgressReport& progress) {
  lidar::Site site = lidar::site_of(farm);
  const Eigen::Vector2d sides_m = cloud::sides_of(survey);
  site.areas = {{.center = cloud::middle_of(survey),
                 .width_m = sides_m.y(),
                 .length_m = sides_m.x(),
                 .heading_rad = 0}};
  return lidar::fly(site, lidar::scene_content(farm), folder, flight, progress);
}

// Writes those points of a cloud, with all that is known of them, that lie in the area.
void crop_cloud(const fs::path& cloud, const cloud::Area& area, const fs::path& cropped) {
  const scan::CloudInfo info = scan::read_cloud_info(cloud);
  scan::PcdWriter writer(cropped, {.origin_m = info.origin_m});
  scan::read_points(cloud, info,
                    only_inside(area, info.origin_m, [&](auto points) { writer.write(points); }));
  writer.close();
}

}  // namespace

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

farm::Farm make_farm(const FarmPlace& place) {
  return lidar::make_farm(place.suite_case.farm, place.folder / "farm",
                          {.overrides = place.suite_case.overrides,
                           .seed = place.seed,
                           .threads = place.threads,
                           .replace = true,
                           .command = kRunCommand});
}

std::vector<score::TruePlot> standing_plots(const FarmPlace& place) {
  std::vector<score::TruePlot> plots = score::read_truth(place.folder / "farm");
  if (place.suite_case.survey) leave_to_survey(plots, *place.suite_case.survey);
  return plots;
}

ScannedFarm scan_farm(const FarmPlace& place, const farm::Farm& farm,
                      const ProgressReport& progress) {
  const auto& [suite_case, seed, folder, threads] = place;
  lidar::FlyOptions flight = suite_case.flight;
  flight.seed = seed;
  flight.threads = threads;
  flight.replace = true;
  const fs::path scan = folder / "scan";
  if (!suite_case.survey) return {lidar::fly(farm, scan, flight, progress), scan / "cloud.pcd"};
  const lidar::FlySummary flown = fly_survey(farm, *suite_case.survey, scan, flight, progress);
  crop_cloud(scan / "cloud.pcd", *suite_case.survey, folder / "survey.pcd");
  return {flown, folder / "survey.pcd"};
}

}  // namespace plotscan::farmbench
