// SPDX-License-Identifier: Apache-2.0
#include "lidar/fly_place.h"

#include <string>

#include "farmfolder/read_farm.h"

#include "core/csv.h"
#include "core/error.h"
#include "farm/farm.h"
#include "gazebo/read_world.h"
#include "lidar/internal/drone_flight.h"

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
                                : "only a farm's plants sway, not those of an SDF world"));
}

PlaceScan fly_world(const fs::path& file, const fs::path& scan_folder, FlyPlaceOptions& options,
                    const ProgressReport& progress) {
  require_wind_acts(options.flight, false);
  const gazebo::StaticWorld world =
      gazebo::read_world(file, {.resource_paths = options.resource_paths});
  options.flight.inputs = world.files;
  const SceneContent content = scene_content(world);
  return {fly(site_of(world.name, content), Scene(content), scan_folder, options.flight,
              options.replace, progress),
          world.notes};
}

}  // namespace

PlaceScan fly_place(const fs::path& place, const fs::path& scan_folder, FlyPlaceOptions options,
                    const ProgressReport& progress) {
  if (!fs::is_directory(place)) return fly_world(place, scan_folder, options, progress);
  require_wind_acts(options.flight, true);
  const farm::Farm farm = farmfolder::read_farm(place);
  // The farm's manifest holds the hashes of its other files.
  options.flight.inputs = {place / "manifest.json"};
  return {fly(farm, scan_folder, options.flight, options.replace, progress), {}};
}

}  // namespace plotscan::lidar
