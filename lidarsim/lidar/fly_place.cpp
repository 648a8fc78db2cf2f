// SPDX-License-Identifier: Apache-2.0
#include "lidar/fly_place.h"

#include "farmfolder/read_farm.h"

#include "farm/farm.h"
#include "gazebo/read_world.h"

namespace plotscan::lidar {
namespace fs = std::filesystem;
namespace {

PlaceScan fly_world(const fs::path& file, const fs::path& scan_folder, FlyPlaceOptions& options,
                    const ProgressReport& progress) {
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
  const farm::Farm farm = farmfolder::read_farm(place);
  // The farm's manifest holds the hashes of its other files.
  options.flight.inputs = {place / "manifest.json"};
  return {fly(farm, scan_folder, options.flight, options.replace, progress), {}};
}

}  // namespace plotscan::lidar
