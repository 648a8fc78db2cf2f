// SPDX-License-Identifier: Apache-2.0
#include "farmbench/farm_scan.h"

#include "farmbench/internal/survey.h"
#include "farmbench/run.h"
#include "lidar/make_farm.h"

namespace plotscan::farmbench {
namespace fs = std::filesystem;

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
  const fs::path scan = folder / "scan";
  if (!suite_case.survey)
    return {lidar::fly(farm, scan, flight, true, progress), scan / "cloud.pcd"};
  const lidar::FlySummary flown = fly_survey(farm, *suite_case.survey, scan, flight, progress);
  crop_cloud(scan / "cloud.pcd", *suite_case.survey, folder / "survey.pcd");
  return {flown, folder / "survey.pcd"};
}

}  // namespace plotscan::farmbench
