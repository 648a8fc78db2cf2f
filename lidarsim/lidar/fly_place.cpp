// SPDX-License-Identifier: Apache-2.0
#include "lidar/fly_place.h"

#include <fmt/core.h>

#include "core/csv.h"
#include "core/error.h"
#include "core/text.h"
#include "farm/farm.h"
#include "farmfolder/read_farm.h"
#include "gazebo/read_world.h"
#include "lidar/internal/drone_flight.h"
#include "sensor/sensor.h"

namespace plotscan::lidar {
namespace fs = std::filesystem;
namespace {

// Throws InputError on a wind that would act on nothing: the scan would be that of still air.
void require_wind_acts(const FlyOptions& options, bool plants_sway) {
  if (!(options.wind.mean_m_s > 0) || wind_moves_drone(options)) return;
  if (plants_sway && wind_moves_plants(options)) return;
  const std::string drone = options.flight ? "a trajectory (--flight) is flown as it is"
                                           : "--wind-acts-on plants leaves the drone in still air";
  throw InputError("--wind " + format_number(options.wind.mean_m_s) +
                   " moves nothing here: " + drone + ", and " +
                   (plants_sway ? "--wind-acts-on drone leaves the plants at rest"
                                : "no plants sway: an SDF world's stand still, as do a farm's "
                                  "with --sway 0"));
}

void require_no_resource_paths(const FlyPlaceOptions& options, const fs::path& farm) {
  if (options.resource_paths.empty()) return;
  throw InputError("--resource-path is for SDF worlds; " + farm.string() +
                   " is a farm folder, which holds its models");
}

// Why no shot met anything, most likely.
std::string empty_note(const FlyOptions& options) {
  const sensor::Sensor sensor = sensor::load_sensor(options.sensor);
  const std::string range = format_number(sensor.min_range_m) + " to " +
                            format_number(sensor.max_range_m) + " m, the range of " + sensor.name;
  const bool planned = !options.flight && !options.waypoints;
  const std::string why = !planned ? "is the flight over the field, and low enough?"
                          : options.altitude_m > sensor.max_range_m
                              ? "--altitude " + format_number(options.altitude_m) + " is too high"
                              : "does the sensor look down (--mount)?";
  return "the scan is empty: nothing lies within " + range + "; " + why;
}

PlaceScan noted(PlaceScan scanned, const FlyOptions& options) {
  if (scanned.summary.points == 0 && scanned.summary.shots > 0)
    scanned.notes.push_back(empty_note(options));
  if (scanned.summary.underground > 0)
    scanned.notes.push_back(fmt::format(
        "{:.1f} % of the flight lies below the ground; its heights are z of the farm's local frame",
        100 * scanned.summary.underground));
  return scanned;
}

PlaceScan fly_world(const fs::path& file, const fs::path& scan_folder, FlyPlaceOptions& options,
                    const ProgressReport& progress) {
  const std::string extension = lower_extension(file);
  if (extension == ".yaml" || extension == ".yml")
    throw InputError(file, "describes a farm; make the farm first (farmgen generate)");
  require_wind_acts(options.flight, false);
  const gazebo::StaticWorld world =
      gazebo::read_world(file, {.resource_paths = options.resource_paths});
  options.flight.inputs = world.files;
  const SceneContent content = scene_content(world);
  return noted(
      {fly(site_of(world.name, content), Scene(content), scan_folder, options.flight, progress),
       world.notes},
      options.flight);
}

}  // namespace

PlaceScan fly_place(const fs::path& place, const fs::path& scan_folder, FlyPlaceOptions options,
                    const ProgressReport& progress) {
  if (!fs::is_directory(place)) return fly_world(place, scan_folder, options, progress);
  require_no_resource_paths(options, place);
  const farm::Farm farm = farmfolder::read_farm(place);
  require_wind_acts(options.flight,
                    !farm.plants.empty() && options.flight.sway.lean_deg_at_5m_s > 0);
  // The farm's manifest holds the hashes of its other files.
  options.flight.inputs = {place / "manifest.json"};
  return noted({fly(farm, scan_folder, options.flight, progress), {}}, options.flight);
}

}  // namespace plotscan::lidar
