// SPDX-License-Identifier: Apache-2.0
#include "farmbench/farm_scan.h"

#include "description/load_description.h"
#include "farmfolder/write_farm.h"
#include "planting/generate.h"

#include "farmbench/internal/survey.h"
#include "lidar/canopy_height.h"

namespace plotscan::farmbench {
namespace fs = std::filesystem;

farm::Farm make_farm(const FarmPlace& place) {
  const auto& [suite_case, seed, folder, threads] = place;
  const planting::FarmDescription description =
      description::load_description(suite_case.farm, suite_case.overrides);
  farm::Farm made = planting::generate(description, seed);
  lidar::measure_canopies(made, threads);
  farmfolder::write_farm(made, folder / "farm", true,
                         {.command = "farmbench run",
                          .options = {{"set", suite_case.overrides}},
                          .inputs = planting::input_files(description)},
                         {}, threads);
  return made;
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
